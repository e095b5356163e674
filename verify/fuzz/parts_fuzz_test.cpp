// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the bytes of a part or of a journal, they are refused or mean what they say; and of a
// part that is right no change is accepted that changes anything. The first byte chooses.
#include <fuzzer/FuzzedDataProvider.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/shard/shard.h"

using namespace limitcheck;
using namespace limitcheck::verify;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

PartReport good_part() {
  PartReport part;
  part.plan = {"limitcheck audit", {{"subjects", {"naive"}}, {"seed", 1}}, 3, 1, {}};
  for (std::size_t unit = 0; unit < 3; ++unit)
    part.results[unit] = {{"check", "positions"}, {"status", "held"}, {"worst", 1e-9}, {"bound", 1e-8}};
  part.seconds = 1.5;
  return part;
}

// What is accepted is written as it is read, and is joined or refused.
void look_at_part(const std::string& text) try {
  const PartReport part = read_part(text);
  require(to_json(read_part(to_json(part))) == to_json(part));
  const PartReport whole = joined({part});
  require(whole.results == part.results && part.is_complete());
} catch (const data::ArgumentError&) {
}

void look_at_journal(const std::string& text) {
  static const std::filesystem::path file = "/dev/shm/limitcheck-fuzz-" + std::to_string(getpid()) + ".jsonl";
  std::ofstream(file) << text;
  try {
    const Journal journal(good_part().plan, file, /*resume=*/true);
    for (const auto& [unit, result] : journal.results()) require(unit < 3);
  } catch (const data::ArgumentError&) {
  }
  std::filesystem::remove(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  const int kind = bytes.ConsumeIntegralInRange(0, 4);
  static const std::string good = to_json(good_part());
  if (kind == 0) {
    std::string changed = good;
    while (bytes.remaining_bytes() > 0)
      changed[bytes.ConsumeIntegralInRange<std::size_t>(0, good.size() - 1)] = bytes.ConsumeIntegral<char>();
    try {
      require(to_json(read_part(changed)) == good);
    } catch (const data::ArgumentError&) {
    }
    return 0;
  }
  const std::string text = bytes.ConsumeRemainingBytesAsString();
  if (kind == 1) look_at_part(text);
  if (kind == 2) look_at_journal(text);
  if (kind < 3) return 0;
  // Behind the digest, which nobody guesses: the same with the right one.
  std::string whole;
  try {
    const auto object = data::parse_untrusted(text);
    if (!object.is_object()) return 0;
    whole = sealed(object);
  } catch (const data::ArgumentError&) {
    return 0;
  }
  kind == 3 ? look_at_part(whole) : look_at_journal(whole);
  return 0;
}
