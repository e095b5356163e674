// SPDX-License-Identifier: MIT
// A library that behaves as the C example does until it is told otherwise; everything here is wrong on purpose. The
// option behaviour=THING@PLACE names what goes wrong and in which call: capabilities, create, tessellate, release,
// destroy, unload; "answer" spoils what was tessellated well. With on=CASE it goes wrong in one case alone: on one of
// the meshes that an audit makes of the octahedron, or for one of its requests. With validates=no the library says that
// it validates no mesh.
#include <limitcheck/subject.h>
#include <sys/mman.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "verify/host/isolation/test_subjects/things.h"

extern "C" const lc_subject* good_subject_get(std::uint32_t abi);  // good_subject.c, its entry renamed

namespace {

const lc_subject& good() {
  return *good_subject_get(LC_SUBJECT_ABI);
}

// Spoils a good answer.
using Spoil = void (*)(lc_tessellation&);
lc_mesh lent;  // the mesh that was tessellated
volatile bool zero = false;
double* positions(const lc_tessellation& t) {
  return static_cast<double*>(t.positions);
}
const std::map<std::string, Spoil>& spoils() {
  static const std::map<std::string, Spoil> all{
      {"huge_vertex_count", [](lc_tessellation& t) { t.vertex_count = std::int64_t{1} << 60; }},
      {"huge_triangle_count", [](lc_tessellation& t) { t.triangle_count = INT64_MAX; }},
      {"negative_vertices", [](lc_tessellation& t) { t.vertex_count = -1; }},
      {"negative_triangles", [](lc_tessellation& t) { t.triangle_count = INT64_MIN; }},
      {"garbage_counts", [](lc_tessellation& t) { t.vertex_count = t.triangle_count = 0x5A5A5A5A5A5A5A5A; }},
      {"one_vertex_more", [](lc_tessellation& t) { ++t.vertex_count; }},
      {"no_positions", [](lc_tessellation& t) { t.positions = nullptr; }},
      {"no_triangles", [](lc_tessellation& t) { t.triangles = nullptr; }},
      {"no_provenance", [](lc_tessellation& t) { t.provenance = nullptr; }},
      {"no_faces", [](lc_tessellation& t) { t.triangle_face = nullptr; }},
      {"heap_positions", [](lc_tessellation& t) { t.positions = std::malloc(1 << 16); }},
      {"stack_positions",
       [](lc_tessellation& t) {
         double local[4] = {};
         void* volatile place = local;
         t.positions = place;
       }},
      {"wild_positions", [](lc_tessellation& t) { t.positions = reinterpret_cast<void*>(0xDEADBEEF000); }},
      {"misaligned", [](lc_tessellation& t) { t.positions = static_cast<char*>(t.positions) + 1; }},
      {"same_array", [](lc_tessellation& t) { t.normals = t.positions; }},
      {"write_8_behind", [](lc_tessellation& t) { positions(t)[3 * t.vertex_count] = 1; }},
      {"write_1000_behind", [](lc_tessellation& t) { positions(t)[3 * t.vertex_count + 124] = 1; }},
      {"write_1100_behind", [](lc_tessellation& t) { positions(t)[3 * t.vertex_count + 137] = 1; }},
      {"write_100000_behind", [](lc_tessellation& t) { positions(t)[3 * t.vertex_count + 12500] = 1; }},
      {"write_8_before", [](lc_tessellation& t) { positions(t)[-1] = 1; }},
      {"write_9000_before", [](lc_tessellation& t) { positions(t)[-1125] = 1; }},
      {"write_a5_behind",  // a pattern that was guard bytes once
       [](lc_tessellation& t) { std::memset(positions(t) + 3 * t.vertex_count, 0xA5, 64); }},
      {"read_behind", [](lc_tessellation& t) { zero = positions(t)[3 * t.vertex_count + 4000] > 0; }},
      {"erase_all", [](lc_tessellation& t) { std::memset(t.positions, 0, std::size_t{1} << 40); }},
      {"unmap",
       [](lc_tessellation& t) {
         auto* const page = reinterpret_cast<void*>(reinterpret_cast<std::uintptr_t>(t.positions) & ~4095ULL);
         munmap(page, 4096);
       }},
      {"free_it", [](lc_tessellation& t) { std::free(t.positions); }},  // NOLINT: not from malloc
      {"bad_index", [](lc_tessellation& t) { t.triangles[1] = 0xFFFFFFFF; }},
      {"bad_face", [](lc_tessellation& t) { t.triangle_face[0] = -5; }},
      {"bad_provenance", [](lc_tessellation& t) { t.provenance[0].denominator = 0; }},
      {"not_a_number",
       [](lc_tessellation& t) { positions(t)[0] = std::numeric_limits<double>::quiet_NaN(); }},
      {"infinite", [](lc_tessellation& t) { positions(t)[0] = HUGE_VAL; }},
      {"write_behind_itself", [](lc_tessellation& t) { reinterpret_cast<std::int32_t*>(&t + 1)[2] = 1; }},
      {"nothing_at_all", [](lc_tessellation& t) { std::memset(&t, 0, sizeof t); }},
      {"modify_positions", [](lc_tessellation&) { const_cast<double*>(lent.positions)[4] += 1; }},
      {"modify_triangles", [](lc_tessellation&) { const_cast<std::int32_t*>(lent.triangles)[0] ^= 1; }},
  };
  return all;
}

std::string option(const char* options, const std::string& key) {
  const std::string text = std::string(",") + (options != nullptr ? options : "") + ",";
  const std::size_t place = text.find("," + key + "=");
  if (place == std::string::npos) return "";
  const std::size_t begin = place + key.size() + 2;
  return text.substr(begin, text.find(',', begin) - begin);
}

// Whether this mesh is the one to misbehave on, made from the octahedron by the audit.
bool is_the_case(const std::string& which, const lc_mesh& mesh) {
  if (which.empty()) return true;
  const auto all_equal = [&](int axis) {
    for (int v = 1; v < mesh.vertex_count; ++v)
      if (mesh.positions[3 * v + axis] != mesh.positions[axis]) return false;
    return true;
  };
  static int made = 0;  // in this process
  const bool first = ++made == 1;
  if (which == "another") return !first && mesh.vertex_count == 6;
  if (which == "broken") return mesh.vertex_count == 7 && mesh.triangle_count == 4;
  if (mesh.vertex_count != 6) return false;
  if (which == "mirrored") return mesh.triangles[0] == 0 && mesh.triangles[1] == 4;
  if (which == "line") return all_equal(1) && !all_equal(0);
  if (which == "point") return all_equal(1) && all_equal(0);
  if (which == "large") return mesh.positions[0] == 1024;
  return true;
}

struct Instance {
  void* inner = nullptr;
  lc_mesh mesh{};
  std::string how;
  bool once_right = false;  // in the first request
};

void misbehave(const std::string& how, const std::string& place) {
  const std::size_t at = how.find('@');
  if (at == std::string::npos || how.substr(at + 1) != place) return;
  const auto found = things().find(how.substr(0, at));
  if (found == things().end()) throw std::invalid_argument("no such behaviour: " + how);
  found->second();
}

// Constructed with the library and destroyed with it.
struct Last {
  std::string how;
  ~Last() { misbehave(how, "unload"); }
} last;

}  // namespace

// As libraries do that never look at the interface asked for; INTERFACE: the one that this was built for.
extern "C" const lc_subject* lc_subject_get(std::uint32_t) {
  static lc_subject subject = good();
  subject.abi = INTERFACE;
  subject.name = "behaviours";
  subject.options = "behaviour=THING@PLACE, on=CASE, validates=no";
  subject.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
    const std::string how = option(options, "behaviour");
    const lc_status status = good().capabilities(nullptr, out, message);
    if (option(options, "validates") == "no") out->does_not_validate = 1;
    if (const int nine = 9; how == "weights") std::memcpy(&out->weights, &nine, sizeof nine);
    if (how == "later_interface") reinterpret_cast<std::int32_t*>(out + 1)[2] = 1;
    misbehave(how, "capabilities");
    return status;
  };
  subject.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    const std::string which = option(options, "on");
    auto* const made = new Instance{nullptr, *mesh, "", which == "second"};
    if (is_the_case(which, *mesh)) made->how = option(options, "behaviour");
    last.how = made->how;
    *instance = made;
    misbehave(made->how, "create");
    return good().create(mesh, nullptr, &made->inner, message);
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    auto& self = *static_cast<Instance*>(instance);
    const std::string how = std::exchange(self.once_right, false) ? "" : self.how;
    misbehave(how, "tessellate");
    const lc_status status = good().tessellate(self.inner, request, out, message);
    lent = self.mesh;
    if (how.ends_with("@answer")) spoils().at(how.substr(0, how.find('@')))(*out);
    return status;
  };
  subject.release = [](void* instance, lc_tessellation*) {
    misbehave(static_cast<Instance*>(instance)->how, "release");
  };
  subject.destroy = [](void* instance) {
    auto* const self = static_cast<Instance*>(instance);
    good().destroy(self->inner);
    misbehave(self->how, "destroy");
    delete self;
  };
  return &subject;
}
