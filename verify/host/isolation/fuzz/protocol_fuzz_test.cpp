// SPDX-License-Identifier: MIT
// libFuzzer target: whatever a process answers is refused by an Error or a SubjectError, or gives arrays as
// large as announced. The first byte chooses the answer and the form of its payload.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "verify/host/host_memory.h"
#include "verify/host/isolation/test_subjects/memory_source.h"
#include "verify/subject/subject_error.h"

using namespace limitcheck::verify;
using namespace limitcheck::verify::protocol;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void read_any(unsigned choice, Source& source) {
  constexpr std::uint64_t kMost = 1 << 16;
  std::array<double, 3> positions{};
  std::array<std::int32_t, 3> triangle{};
  const lc_mesh mesh{positions.data(), 1, triangle.data(), 1};
  detail::Memory memory;
  const lc_request request{nullptr, 1, &memory, &detail::Memory::allocate};
  lc_tessellation out{};
  if (choice % 4 == 0) {
    require(read_capabilities(source).values.max_depth >= 0);
  } else if (choice % 4 == 1) {
    (void)read_replay(source, kMost, mesh, request, out);
  } else {
    Capabilities capabilities;
    capabilities.payload = choice % 4 == 2 ? Payload::kBinary : Payload::kText;
    capabilities.values.precision = (choice & 4U) != 0 ? LC_FLOAT32 : LC_FLOAT64;
    capabilities.values.normals = (choice & 8U) != 0 ? 1 : 0;
    read_tessellation(source, capabilities, kMost, mesh, request, out);
    std::uint64_t total = 0;
    for (const auto& block : memory.blocks()) {
      total += block.size;
      require(memory.written_before(block) == 0 && memory.written_behind(block) == 0);
    }
    require(total <= kMost);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  MemorySource source({reinterpret_cast<const char*>(bytes) + 1, size - 1});
  try {
    read_any(bytes[0], source);
  } catch (const Error&) {
  } catch (const SubjectError&) {
  }
  return 0;
}
