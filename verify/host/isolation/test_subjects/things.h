// SPDX-License-Identifier: MIT
// What libraries and programs of the tests do that is wrong, by its name.
#pragma once

#include <map>
#include <string>

const std::map<std::string, void (*)()>& things();
[[noreturn]] void sleep_for_ever();
