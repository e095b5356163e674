// SPDX-License-Identifier: MIT
#include "verify/host/in_turns.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/shapes.h"
#include "verify/subject/lent_mesh.h"

namespace limitcheck::verify {
namespace {

constexpr double kMany = 16384;  // triangles of requests whose answers are thrown away

// The functions of a subject are not told whose they are. Of each thread, because several subjects may be asked at a time.
thread_local const lc_subject* inner = nullptr;

// Memory for answers that are thrown away, as the plug-in interface promises it.
struct Scratch {
  std::vector<std::unique_ptr<void, decltype(&std::free)>> blocks;

  static void* allocate(void* host, std::size_t bytes) {
    const std::size_t whole = (bytes / 64 + 1) * 64;
    void* block = std::aligned_alloc(64, whole);
    if (block == nullptr) return nullptr;
    std::memset(block, 0xFF, whole);
    static_cast<Scratch*>(host)->blocks.emplace_back(block, &std::free);
    return block;
  }
};

// One mesh in the hands of the inner subject.
class Instance {
 public:
  Instance(LentMesh mesh, std::string options) : mesh_(std::move(mesh)), options_(std::move(options)) {}
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() {
    try {
      destroy();
    } catch (...) {  // there is another failure to tell
    }
  }

  lc_status create(const char** message) {
    const lc_status status =
        inner->create(&mesh_.lend(), options_.empty() ? nullptr : options_.c_str(), &made_, message);
    alive_ = status == LC_OK;
    return status;
  }
  void destroy() {
    if (!alive_) return;
    alive_ = false;
    inner->destroy(made_);
  }
  lc_status tessellate(const lc_request& request, lc_tessellation* out, const char** message) {
    return inner->tessellate(made_, &request, out, message);
  }
  void release(lc_tessellation* out) { inner->release(made_, out); }

  /// Tessellates, and looks away.
  lc_status disturb(std::int32_t depth, const char** message) {
    return disturb(std::vector<std::int32_t>(faces(), depth), message);
  }
  lc_status disturb(const std::vector<std::int32_t>& depths, const char** message) {
    Scratch scratch;
    const lc_request request{depths.data(), 1, &scratch, &Scratch::allocate, sizeof(lc_request)};
    lc_tessellation out{};
    out.size = sizeof out;
    const lc_status status = tessellate(request, &out, message);
    if (status == LC_OK) release(&out);
    return status;
  }

  std::int64_t faces() const { return mesh_.faces(); }

 private:
  LentMesh mesh_;
  std::string options_;
  void* made_ = nullptr;
  bool alive_ = false;
};

// The same mesh with other channels: other values, other seams, another rule.
std::vector<LentMesh> other_channels(const LentMesh& mesh, std::int32_t rules) {
  std::vector<LentMesh> all;
  if (mesh.channels.empty()) return all;
  const auto change = [&](auto&& each) {
    LentMesh other = mesh;
    for (auto& channel : other.channels) each(channel);
    all.push_back(std::move(other));
  };
  change([](auto& channel) {
    for (double& x : channel.values) x *= 2;
  });
  change([&](auto& channel) {
    std::map<std::int32_t, std::int32_t> first;
    for (std::size_t c = 0; c < channel.corners.size(); ++c)
      channel.corners[c] = first.emplace(mesh.corners[c], channel.corners[c]).first->second;
  });
  if (std::has_single_bit(static_cast<std::uint32_t>(rules))) return all;
  change([&](auto& channel) {
    int rule = channel.rule;
    do rule = (rule + 1) % (LC_CHANNEL_ALL + 1);
    while ((rules >> rule & 1) == 0);
    channel.rule = static_cast<lc_channel_rule>(rule);
  });
  return all;
}

// Each has as many vertices and faces, and differs in one thing that caches are known to leave out.
std::vector<LentMesh> look_alikes(LentMesh mesh, const lc_capabilities& capabilities) {
  std::vector<LentMesh> all = other_channels(mesh, capabilities.channel_rules);
  mesh.channels.clear();
  const auto declared = [sharp = capabilities.sharp](std::int32_t kinds) { return (sharp & kinds) == kinds; };
  // Other vertices under each number, at other places.
  LentMesh& renumbered = all.emplace_back(mesh);
  const auto last = static_cast<std::size_t>(mesh.vertices()) - 1;
  for (std::size_t v = 0; v <= last; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      renumbered.positions[3 * (last - v) + k] = 2 * mesh.positions[3 * v + k];
  const auto renumber = [last](std::int32_t& v) { v = static_cast<std::int32_t>(last) - v; };
  for (std::int32_t& v : renumbered.corners) renumber(v);
  for (lc_sharp_edge& e : renumbered.sharp_edges) renumber(e.a), renumber(e.b);
  for (lc_sharp_vertex& v : renumbered.sharp_vertices) renumber(v.vertex);
  // Other positions, and other normals with them; both precisions have the numbers.
  LentMesh& stretched = all.emplace_back(mesh);
  for (std::size_t k = 0; k < stretched.positions.size(); k += 3) stretched.positions[k] *= 2;
  // The same numbers at other places: sums over all of them are alike, too.
  LentMesh& turned = all.emplace_back(mesh);
  for (std::size_t k = 0; k < turned.positions.size(); k += 3)
    std::rotate(turned.positions.begin() + static_cast<std::ptrdiff_t>(k),
                turned.positions.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                turned.positions.begin() + static_cast<std::ptrdiff_t>(k) + 3);
  // Tags. Fewer of them might leave darts.
  if (!mesh.sharp_edges.empty() || !mesh.sharp_vertices.empty()) {
    LentMesh& plain = all.emplace_back(mesh);
    plain.sharp_edges.clear();
    plain.sharp_vertices.clear();
    LentMesh fewer = mesh;
    const auto change = [&](auto& tags) {
      if (!declared(LC_SHARP_SEMI)) return tags.resize(tags.size() / 2);
      for (auto& tag : tags) tag.sharpness = tag.sharpness < 10 ? tag.sharpness / 2 : 1.5F;
    };
    change(fewer.sharp_edges);
    change(fewer.sharp_vertices);
    if (declared(LC_SHARP_SEMI) || !declared(LC_SHARP_NO_DARTS)) all.push_back(std::move(fewer));
  } else if (declared(LC_SHARP_CREASES)) {
    LentMesh& creased = all.emplace_back(mesh);  // round the first face
    for (std::int32_t k = 0, n = mesh.face_sizes[0]; k < n; ++k)
      creased.sharp_edges.push_back({mesh.corners[k], mesh.corners[(k + 1) % n], 10});
  }
  // Choices.
  const auto semi_sharp = [](const lc_sharp_edge& e) { return e.sharpness < 10; };
  if (declared(LC_SHARP_CHAIKIN) && std::any_of(mesh.sharp_edges.begin(), mesh.sharp_edges.end(), semi_sharp))
    all.emplace_back(mesh).creasing =
        mesh.creasing == LC_CREASING_UNIFORM ? LC_CREASING_CHAIKIN : LC_CREASING_UNIFORM;
  std::vector<int> faces_at(last + 1);
  for (const std::int32_t v : mesh.corners) ++faces_at[v];
  if (declared(LC_SHARP_CORNERS) && std::count(faces_at.begin(), faces_at.end(), 1) > 0)
    all.emplace_back(mesh).corners_held = !mesh.corners_held;
  if (declared(LC_SHARP_SMOOTH_TRIANGLES) && mesh.scheme == data::Scheme::kCatmullClark &&
      std::count(mesh.face_sizes.begin(), mesh.face_sizes.end(), 3) > 0)
    all.emplace_back(mesh).smooth_triangles = !mesh.smooth_triangles;
  return all;
}

// The mesh that is asked for, and those in between.
struct Turns {
  std::unique_ptr<Instance> mine, other;
  std::vector<std::unique_ptr<Instance>> alike;
  lc_capabilities capabilities{};
  bool other_is_first = false;  // and there is one turn
  std::size_t turn = 0;

  std::int32_t at_most(std::int32_t depth) const { return std::min(depth, capabilities.max_depth); }

  lc_status make(Instance& before, std::int32_t depth, const char** message) const {
    const lc_status status = before.create(message);
    return status == LC_OK ? before.disturb(at_most(depth), message) : status;
  }

  lc_status create(const char** message) {
    if (other_is_first) {
      (void)make(*other, 2, message);
      return mine->create(message);
    }
    // A look-alike is the last one before: what remembers one mesh remembers it.
    lc_status status = make(*other, 1, message);
    for (std::size_t k = 0; status == LC_OK && k < alike.size(); ++k) status = make(*alike[k], 1, message);
    return status == LC_OK ? mine->create(message) : status;
  }

  // As the mesh itself is asked to come, where that is not many triangles.
  lc_status disturb_alike(const std::vector<std::int32_t>& depths, bool made_again, const char** message) {
    double triangles = 0;
    for (const std::int32_t d : depths) triangles += d < 0 ? 0 : std::ldexp(1.0, 2 * d);
    for (const auto& each : alike) {
      lc_status status = LC_OK;
      if (made_again) {
        each->destroy();
        status = each->create(message);
      }
      if (status == LC_OK)
        status = triangles > kMany ? each->disturb(at_most(1), message) : each->disturb(depths, message);
      if (status != LC_OK) return status;
    }
    return LC_OK;
  }

  // With every other face culled, and no others, as far as the subject culls.
  lc_status disturb_culled(std::vector<std::int32_t> depths, const char** message) {
    if (capabilities.per_face_depth == 0) return LC_OK;
    for (std::size_t f = 0; f < depths.size(); ++f) depths[f] = f % 2 == 0 ? -1 : std::max(depths[f], 0);
    return mine->disturb(depths, message);
  }

  // With depths that differ and have the same sum, as far as the subject takes them.
  lc_status disturb_exchanged(std::vector<std::int32_t> depths, const char** message) {
    if (capabilities.per_face_depth == 0) return LC_OK;
    const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
    if (*least < *most)
      std::rotate(depths.begin(), depths.begin() + 1, depths.end());
    else if (depths.size() > 1 && *most > 0 && *most < capabilities.max_depth)
      --depths.front(), ++depths.back();
    return mine->disturb(depths, message);
  }

  // What comes before the next request (kTurns).
  lc_status disturb(const lc_request& request, const char** message) {
    if (other_is_first) return LC_OK;
    const std::vector<std::int32_t> depths(request.face_depth, request.face_depth + mine->faces());
    const std::int32_t deepest = std::max(0, *std::max_element(depths.begin(), depths.end()));
    const std::int32_t another = deepest == 1 || capabilities.max_depth == 0 ? 0 : 1;
    lc_status status = LC_OK;
    switch (turn++) {
      case 0:
        return disturb_alike(depths, false, message);
      case 1:
        return mine->disturb(another, message);
      case 2:
        return other->disturb(at_most(2), message);
      case 3:
        return disturb_alike(depths, true, message);
      case 4:
        other->destroy();
        return LC_OK;
      case 5:
        if (deepest >= capabilities.max_depth ||
            std::ldexp(static_cast<double>(mine->faces()), 2 * deepest + 2) > kMany)
          return LC_OK;
        return mine->disturb(deepest + 1, message);
      case 6:
        status = other->create(message);
        return status == LC_OK ? disturb_culled(depths, message) : status;
      case 7:
        mine->destroy();
        status = other->disturb(0, message);
        alike.front()->destroy();
        if (status == LC_OK) status = make(*alike.front(), 1, message);
        if (status == LC_OK) status = mine->create(message);
        if (status == LC_OK) status = disturb_exchanged(depths, message);
        if (status == LC_OK) status = mine->disturb(another, message);
        return status == LC_OK ? disturb_culled(depths, message) : status;
      default:
        return LC_OK;
    }
  }

  void destroy() const {
    mine->destroy();
    for (const auto& each : alike) each->destroy();
    other->destroy();
  }
};

// Which of kFirst the options begin with, which then begin behind it; or its size.
std::size_t take_first(const char*& options) {
  for (std::size_t k = 0; k < kFirst.size(); ++k)
    if (const std::size_t size = std::strlen(kFirst[k].option);
        options != nullptr && std::strncmp(options, kFirst[k].option, size) == 0) {
      options = options[size] == '\0' ? nullptr : options + size;
      return k;
    }
  return kFirst.size();
}

}  // namespace

InTurns::InTurns(const lc_subject& of) : subject_(of) {
  inner = &of;
  subject_.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
    (void)take_first(options);
    return inner->capabilities(options, out, message);
  };
  subject_.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    const std::size_t first = take_first(options);
    auto turns = std::make_unique<Turns>();
    turns->capabilities.size = sizeof turns->capabilities;
    turns->capabilities.scheme = mesh->scheme;
    lc_status status = inner->capabilities(options, &turns->capabilities, message);
    if (status != LC_OK) return status;
    const std::string given = options != nullptr ? options : "";
    const LentMesh mine(*mesh);
    turns->mine = std::make_unique<Instance>(mine, given);
    turns->other_is_first = first < kFirst.size();
    if (!turns->other_is_first)
      for (LentMesh& alike : look_alikes(mine, turns->capabilities))
        turns->alike.push_back(std::make_unique<Instance>(std::move(alike), given));
    const data::ControlMesh other = first == 0                ? data::tetrahedron()
                                    : first == 1              ? data::bipyramid(60)
                                    : mesh->vertex_count == 6 ? data::icosahedron()
                                                              : data::octahedron();
    turns->other = std::make_unique<Instance>(LentMesh(other, mine.scheme), given);
    status = turns->create(message);
    if (status == LC_OK) *instance = turns.release();
    return status;
  };
  subject_.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                           const char** message) {
    auto& turns = *static_cast<Turns*>(instance);
    const lc_status status = turns.disturb(*request, message);
    return status == LC_OK ? turns.mine->tessellate(*request, out, message) : status;
  };
  subject_.release = [](void* instance, lc_tessellation* out) {
    static_cast<Turns*>(instance)->mine->release(out);
  };
  subject_.destroy = [](void* instance) {
    const std::unique_ptr<Turns> turns(static_cast<Turns*>(instance));
    turns->destroy();
  };
}

InTurns::~InTurns() {
  inner = nullptr;
}

}  // namespace limitcheck::verify
