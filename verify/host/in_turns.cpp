// SPDX-License-Identifier: MIT
#include "verify/host/in_turns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "data/shapes.h"
#include "verify/subject/lent_mesh.h"

namespace limitcheck::verify {
namespace {

constexpr double kMany = 16384;  // triangles of requests whose answers are thrown away

const lc_subject* inner = nullptr;  // the functions of a subject are not told whose they are

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
    const lc_mesh mesh = mesh_.view();
    const lc_status status =
        inner->create(&mesh, options_.empty() ? nullptr : options_.c_str(), &made_, message);
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
    Scratch scratch;
    const std::vector<std::int32_t> depths(faces(), depth);
    const lc_request request{depths.data(), 1, &scratch, &Scratch::allocate, sizeof(lc_request)};
    lc_tessellation out{};
    out.size = sizeof out;
    const lc_status status = tessellate(request, &out, message);
    if (status == LC_OK) release(&out);
    return status;
  }

  std::int64_t faces() const { return mesh_.faces(); }
  const std::string& options() const { return options_; }

  /// As many vertices and faces, each vertex with another number and, times two, at another place.
  std::unique_ptr<Instance> look_alike() const {
    LentMesh other = mesh_;
    const auto last = static_cast<std::size_t>(mesh_.vertices()) - 1;
    for (std::size_t v = 0; v <= last; ++v)
      for (std::size_t k = 0; k < 3; ++k)
        other.positions[3 * (last - v) + k] = 2 * mesh_.positions[3 * v + k];
    const auto renumber = [last](std::int32_t& v) { v = static_cast<std::int32_t>(last) - v; };
    for (std::int32_t& v : other.corners) renumber(v);
    for (lc_sharp_edge& e : other.sharp_edges) renumber(e.a), renumber(e.b);
    for (lc_sharp_vertex& v : other.sharp_vertices) renumber(v.vertex);
    return std::make_unique<Instance>(std::move(other), options_);
  }

 private:
  LentMesh mesh_;
  std::string options_;
  void* made_ = nullptr;
  bool alive_ = false;
};

// The mesh that is asked for, and those in between.
struct Turns {
  std::unique_ptr<Instance> mine, other, alike;
  std::int32_t max_depth = 0;
  std::size_t turn = 0;

  lc_status create(const char** message) {
    for (Instance* before : {alike.get(), other.get()}) {
      lc_status status = before->create(message);
      if (status == LC_OK) status = before->disturb(std::min(1, max_depth), message);
      if (status != LC_OK) return status;
    }
    return mine->create(message);
  }

  // What comes before the next request (kTurns).
  lc_status disturb(const lc_request& request, const char** message) {
    const std::int32_t* end = request.face_depth + mine->faces();
    const std::int32_t deepest = std::max(0, *std::max_element(request.face_depth, end));
    const std::int32_t another = deepest == 1 || max_depth == 0 ? 0 : 1;
    switch (turn++) {
      case 1:
        return mine->disturb(another, message);
      case 2:
        return other->disturb(std::min(2, max_depth), message);
      case 3:
        return alike->disturb(deepest, message);
      case 4:
        other->destroy();
        return LC_OK;
      case 5:
        if (deepest >= max_depth || std::ldexp(static_cast<double>(mine->faces()), 2 * deepest + 2) > kMany)
          return LC_OK;
        return mine->disturb(deepest + 1, message);
      case 6:
        return other->create(message);
      case 7: {
        mine->destroy();
        lc_status status = other->disturb(0, message);
        if (status == LC_OK) status = mine->create(message);
        return status == LC_OK ? mine->disturb(another, message) : status;
      }
      default:
        return LC_OK;
    }
  }

  void destroy() const {
    mine->destroy();
    alike->destroy();
    other->destroy();
  }
};

}  // namespace

InTurns::InTurns(const lc_subject& of) : subject_(of) {
  inner = &of;
  subject_.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    lc_capabilities capabilities{};
    capabilities.size = sizeof capabilities;
    capabilities.scheme = mesh->scheme;
    lc_status status = inner->capabilities(options, &capabilities, message);
    if (status != LC_OK) return status;
    auto turns = std::make_unique<Turns>();
    turns->max_depth = capabilities.max_depth;
    const std::string given = options != nullptr ? options : "";
    turns->mine = std::make_unique<Instance>(LentMesh(*mesh), given);
    turns->alike = turns->mine->look_alike();
    const data::ControlMesh other = mesh->vertex_count == 6 ? data::icosahedron() : data::octahedron();
    turns->other = std::make_unique<Instance>(LentMesh(other, scheme_of(mesh->scheme)), given);
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
