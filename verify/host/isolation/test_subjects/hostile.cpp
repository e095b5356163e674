// SPDX-License-Identifier: MIT
// A library that behaves as the C example does, except on meshes of six vertices (the octahedron): there it
// does what its option says, do=THING, or only when on=CASE; validates=no says that it does not. Everything here is wrong on purpose.
#include <limitcheck/subject.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" const lc_subject* good_subject_get(std::uint32_t abi);  // good_subject.c, its entry renamed

namespace {

const lc_subject& good() {
  return *good_subject_get(LC_SUBJECT_ABI);
}

struct Instance {
  void* inner = nullptr;
  std::string what;
  bool second_only = false;  // not in the first request
};

std::string option(const char* options, const std::string& key) {
  const std::string text = std::string(",") + (options != nullptr ? options : "") + ",";
  const std::size_t place = text.find("," + key + "=");
  if (place == std::string::npos) return "";
  const std::size_t begin = place + key.size() + 2;
  return text.substr(begin, text.find(',', begin) - begin);
}

// Whether this mesh is the one to misbehave on, made from the octahedron by the audit.
bool is_the_case(const std::string& which, const lc_mesh& mesh) {
  const auto all_equal = [&](int axis) {
    for (int v = 1; v < mesh.vertex_count; ++v)
      if (mesh.positions[3 * v + axis] != mesh.positions[axis]) return false;
    return true;
  };
  static int made = 0;  // in this process
  if (++made > 1 && which == "another") return mesh.vertex_count == 6;
  if (which == "another") return false;
  if (which == "broken") return mesh.vertex_count == 7 && mesh.triangle_count == 4;
  if (mesh.vertex_count != 6) return false;
  if (which == "mirrored") return mesh.triangles[0] == 0 && mesh.triangles[1] == 4;
  if (which == "line") return all_equal(1) && !all_equal(0);
  if (which == "point") return all_equal(1) && all_equal(0);
  if (which == "large") return mesh.positions[0] == 1024;
  return true;
}

volatile int* nowhere = nullptr;

int overflow_the_stack(int depth) {
  volatile char page[4096];
  page[0] = static_cast<char>(depth);
  return depth == INT_MAX ? page[0] : overflow_the_stack(depth + 1) + page[0];
}

// What is done instead of tessellating, or before it.
void misbehave(const std::string& what) {
  if (what == "segfault") *nowhere = 1;
  if (what == "abort") std::abort();
  if (what == "exit") std::exit(0);
  if (what == "throw") throw std::runtime_error("out of luck");
  if (what == "throw_int") throw 42;
  if (what == "stack") overflow_the_stack(0);
  if (what == "sleep")
    for (;;) sleep(1000);
  volatile bool for_ever = true;
  while (what == "spin" && for_ever) {
  }
  if (what == "print") {
    std::printf("{\"status\": \"ok\", \"vertices\": 5, \"triangles\": 5}\n");
    std::fflush(stdout);
    if (write(STDOUT_FILENO, "not an answer\n", 14) < 0) std::abort();
  }
  if (what == "close") {
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
  }
  if (what == "leak") {
    void* volatile lost = std::malloc(std::size_t{64} << 20);
    std::memset(lost, 1, std::size_t{64} << 20);
  }  // NOLINTNEXTLINE(clang-analyzer-unix.Malloc): lost on purpose
  if (what == "memory")
    for (;;) {  // ten gigabytes, if it is let
      static std::vector<char*> taken;
      taken.push_back(static_cast<char*>(std::malloc(std::size_t{10} << 20)));
      std::memset(taken.back(), 1, std::size_t{10} << 20);
      if (taken.size() == 1024) std::exit(0);
    }
}

// What is done to a good answer.
void spoil(const std::string& what, const lc_mesh& mesh, lc_tessellation& out) {
  auto* position = static_cast<double*>(out.positions);
  if (what == "huge_count") out.vertex_count = std::int64_t{1} << 60;
  if (what == "garbage_counts") out.vertex_count = out.triangle_count = 0x5A5A5A5A5A5A5A5A;
  if (what == "negative_count") out.triangle_count = -7;
  if (what == "write_behind") position[3 * out.vertex_count] = 1;
  if (what == "write_before") position[-1] = 1;
  if (what == "wild_write") std::memset(position, 0, std::size_t{1} << 40);
  if (what == "foreign") out.positions = malloc(24 * static_cast<std::size_t>(out.vertex_count));
  if (what == "modify_mesh") const_cast<double*>(mesh.positions)[4] += 1;
}

lc_mesh lent;

}  // namespace

extern "C" const lc_subject* lc_subject_get(std::uint32_t) {
  static lc_subject subject = good();
  subject.name = "hostile";
  subject.options = "do=THING, on=CASE, validates=no";
  subject.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
    const lc_status status = good().capabilities(nullptr, out, message);
    const int nine = 9;
    if (option(options, "validates") == "no") out->does_not_validate = 1;
    if (option(options, "do") == "weights") std::memcpy(&out->weights, &nine, sizeof nine);
    return status;
  };
  subject.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    auto* made = new Instance;
    const std::string which = option(options, "on");
    if (is_the_case(which, *mesh)) made->what = option(options, "do");
    made->second_only = which == "second";
    lent = *mesh;
    *instance = made;
    if (made->what == "create") *nowhere = 1;
    if (which == "broken") misbehave(made->what);
    return good().create(mesh, nullptr, &made->inner, message);
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    auto& self = *static_cast<Instance*>(instance);
    if (self.second_only) {
      self.second_only = false;
      return good().tessellate(self.inner, request, out, message);
    }
    misbehave(self.what);
    const lc_status status = good().tessellate(self.inner, request, out, message);
    spoil(self.what, lent, *out);
    return status;
  };
  subject.release = [](void* instance, lc_tessellation*) {
    if (static_cast<Instance*>(instance)->what == "release") throw 42;
  };
  subject.destroy = [](void* instance) {
    auto* self = static_cast<Instance*>(instance);
    good().destroy(self->inner);
    if (self->what == "destroy") std::abort();
    delete self;
  };
  return &subject;
}
