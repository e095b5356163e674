// SPDX-License-Identifier: MIT
// What subjects compute on besides the processor: a report names it, because another device or driver rounds otherwise.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace limitcheck::verify {

/// Of this process: what subjects said of themselves, by their name without options.
class Devices {
 public:
  static void note(const std::string& subject, const std::string& device) {
    const std::scoped_lock lock(all().mutex);
    all().devices[subject] = device;
  }
  static std::map<std::string, std::string> noted() {
    const std::scoped_lock lock(all().mutex);
    return all().devices;
  }

 private:
  struct All {
    std::mutex mutex;
    std::map<std::string, std::string> devices;
  };
  static All& all() {
    static All the;
    return the;
  }
};

}  // namespace limitcheck::verify
