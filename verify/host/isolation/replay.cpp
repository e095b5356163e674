// SPDX-License-Identifier: MIT
// What the worker sees happen to its memory, repeated in the host's. The header counts the blocks; each is
// described by three integers (size, bytes written in front of it, bytes written behind it), then come the
// contents of all. An array is [block, offset], null, or [-1, 0] for memory that was never handed out.

#include <new>
#include <vector>

#include "verify/host/host_memory.h"
#include "verify/host/isolation/header.h"

namespace limitcheck::verify::protocol {
namespace {

using detail::Memory;

struct Block {
  std::int64_t size, before, behind;
};

std::vector<Block> read_blocks(Source& source, const Header& header, std::uint64_t most_bytes) {
  std::vector<Block> blocks(header.integer("blocks", 0, std::int64_t{Memory::kMostBlocks}));
  source.read(std::as_writable_bytes(std::span(blocks)));
  std::uint64_t total = 0;
  for (const Block& b : blocks) {
    const bool bearable = b.size >= 0 && static_cast<std::uint64_t>(b.size) <= most_bytes - total;
    const Memory::Block zones = Memory::block_of(bearable ? static_cast<std::size_t>(b.size) : 0);
    if (!bearable || b.before < 0 || b.before > static_cast<std::int64_t>(zones.before) || b.behind < 0 ||
        b.behind > static_cast<std::int64_t>(zones.behind))
      throw Error("a block of memory it describes is impossible");
    total += static_cast<std::uint64_t>(b.size);
  }
  return blocks;
}

void* pointer(const nlohmann::json& place, const std::vector<std::byte*>& memory,
              const std::vector<Block>& blocks) {
  alignas(64) static std::byte elsewhere[64];
  if (place.is_null()) return nullptr;
  if (!place.is_array() || place.size() != 2 || !place[0].is_number_integer() ||
      !place[1].is_number_integer())
    throw Error("an array it describes has no place");
  const auto block = place[0].get<std::int64_t>(), offset = place[1].get<std::int64_t>();
  if (block == -1) return elsewhere;
  if (block < 0 || block >= static_cast<std::int64_t>(blocks.size()) || offset < 0 ||
      offset > blocks[block].size)
    throw Error("an array it describes lies nowhere");
  return memory[block] + offset;
}

}  // namespace

bool read_replay(Source& source, std::uint64_t most_bytes, const lc_mesh& mesh, const lc_request& request,
                 lc_tessellation& out) {
  const Header header = read_header(source);
  header.refuse_unless_ok();
  out.vertex_count = header.integer("vertices", INT64_MIN, INT64_MAX);
  out.triangle_count = header.integer("triangles", INT64_MIN, INT64_MAX);

  const std::vector<Block> blocks = read_blocks(source, header, most_bytes);
  std::vector<std::byte*> memory;
  for (const Block& b : blocks) {
    auto* data = static_cast<std::byte*>(request.allocate(request.host, static_cast<std::size_t>(b.size)));
    if (data == nullptr) throw std::bad_alloc();
    source.read({data, static_cast<std::size_t>(b.size)});
    // Any byte other than the present one.
    if (b.before > 0) *(data - b.before) ^= std::byte{1};
    if (b.behind > 0) *(data + b.size + b.behind - 1) ^= std::byte{1};
    memory.push_back(data);
  }
  const auto place = [&](const char* key) { return pointer(header.at(key), memory, blocks); };
  out.positions = place("positions");
  out.normals = place("normals");
  out.provenance = static_cast<lc_provenance*>(place("provenance"));
  out.triangles = static_cast<std::uint32_t*>(place("triangle_corners"));
  out.triangle_face = static_cast<std::int32_t*>(place("triangle_face"));
  out.corner = static_cast<std::int32_t*>(place("corner"));
  out.channel_values = place("channel_values");
  out.channel_derivatives = place("channel_derivatives");

  // The copy that the session lent to the subject: to be written to, as the subject did.
  if (header.flag("mesh_changed"))
    for (const auto& array : arrays_of(mesh)) source.read(array);
  return header.flag("release_threw");
}

}  // namespace limitcheck::verify::protocol
