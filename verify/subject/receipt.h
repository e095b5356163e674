// SPDX-License-Identifier: MIT
// What a subject that runs in processes of its own took.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace limitcheck::verify {

struct Receipt {
  std::string subject;              // without its options
  std::int64_t processes = 0;       // that this program started for it
  std::int64_t most_at_once = 0;    // of one of these and all that it had started
  std::int64_t peak_bytes = 0;      // the most that one of these and all that it had started held
  std::int64_t peak_shared = 0;     // bytes of shared memory without a name among those
  std::int64_t crashes = 0;         // how many were ended for it, or ended by themselves: out of order ..
  std::int64_t over_time = 0;       // .. without an answer in time
  std::int64_t over_memory = 0;     // .. with more memory, or more processes, than allowed
  std::int64_t broke_protocol = 0;  // .. with an answer that is none
};

/// Adds what was started and ended; of the rest the larger counts.
inline void add(Receipt& to, const Receipt& r) {
  for (const auto count : {&Receipt::processes, &Receipt::crashes, &Receipt::over_time, &Receipt::over_memory,
                           &Receipt::broke_protocol})
    to.*count += r.*count;
  for (const auto peak : {&Receipt::most_at_once, &Receipt::peak_bytes, &Receipt::peak_shared})
    to.*peak = std::max(to.*peak, r.*peak);
}

/// The same into a list that has one for each subject.
inline void add(std::vector<Receipt>& to, const Receipt& r) {
  const auto same =
      std::find_if(to.begin(), to.end(), [&](const Receipt& other) { return other.subject == r.subject; });
  if (same == to.end())
    to.push_back(r);
  else
    add(*same, r);
}

}  // namespace limitcheck::verify
