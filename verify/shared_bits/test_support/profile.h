// SPDX-License-Identifier: MIT
// Which functions of this program run while something is done: found by sampling, so that no function needs
// to report itself.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace limitcheck::verify {

/// Samples by function, demangled name -> count, of this process' processor time every half millisecond while
/// `work` is repeated, until `least` samples fell into functions whose name contains `part` or `most` seconds
/// of processor time have passed. Samples outside this program's own code count as "". Linux on x86-64; names
/// are read with nm.
std::map<std::string, int> profile(const std::function<void()>& work, const std::string& part, int least,
                                   double most);

/// The demangled name of the function at this address of the program itself, "" if there is none.
std::string function_at(std::uintptr_t address);

}  // namespace limitcheck::verify
