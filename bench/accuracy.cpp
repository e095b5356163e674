// SPDX-License-Identifier: MIT
// How far the float engines are from the limit surface, by depth: median, 99.9 % and worst, as a table.
//   accuracy [MESH [DEEPEST [SUBJECT...]]]
// Defaults: bumpy:4000, 8, row-stream:output=indexed and sliding-window:output=indexed.
// The scheme is Loop's if all faces are triangles, else Catmull and Clark's.
// Every lattice point of all faces up to two million of them; beyond, of faces evenly spread over the mesh.
// The reference is Stam's evaluator in double on the control mesh rounded to float.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "reference/surface/surface.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using verify::operator-;

constexpr std::int64_t kMostPoints = 2'000'000;

struct Spread {
  double median = 0, most = 0, worst = 0;  // `most`: 99.9 % are not beyond
};

Spread spread(std::vector<double> errors) {
  if (errors.empty()) return {};
  const auto at = [&](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), errors.begin() + k, errors.end());
    return errors[k];
  };
  return {at(.5), at(.999), *std::max_element(errors.begin(), errors.end())};
}

double angle(const verify::Vector& a, const verify::Vector& b) {
  return std::atan2(verify::norm(verify::cross(a, b)), verify::dot(a, b));
}

void print_line(verify::Session& session, const reference::Surface& limit, data::Scheme scheme, int depth) {
  const auto faces = static_cast<std::int64_t>(session.mesh().faces.size());
  const verify::FaceDomain first(scheme, static_cast<int>(session.mesh().faces[0].size()));
  const std::int64_t each = first.point_count(std::int64_t{1} << depth);
  const std::int64_t sampled = std::clamp<std::int64_t>(kMostPoints / each, 1, faces);
  std::vector<std::int32_t> depths(faces, -1);
  for (std::int64_t s = 0; s < sampled; ++s) depths[s * faces / sampled] = depth;

  const verify::Tessellation t = session.tessellate(depths);
  const auto count = static_cast<std::size_t>(t.vertex_count());
  const double scale = data::box_diagonal(session.mesh());
  std::vector<double> position(count), normal(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const auto at = static_cast<std::int64_t>(v);
    const verify::Place p = t.place(at);
    const auto exact = limit.evaluate(p.face, p.corner, static_cast<double>(p.i) / p.denominator,
                                      static_cast<double>(p.j) / p.denominator, reference::Order::kFirst);
    position[v] = verify::norm(t.position(at) - verify::vector_of(exact.position)) / scale;
    normal[v] = exact.normal_kind == reference::NormalKind::kRegular
                    ? angle(t.normal(at), verify::vector_of(exact.normal))
                    : -1;
  });
  std::erase_if(normal, [](double x) { return x < 0; });
  const Spread p = spread(std::move(position)), a = spread(std::move(normal));
  fmt::print("| {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", session.label(),
             depth, count, p.median, p.most, p.worst, a.median, a.most, a.worst);
  std::fflush(stdout);
}

int run(const std::vector<std::string>& arguments) {
  const std::string name = arguments.empty() ? "bumpy:4000" : arguments[0];
  const int deepest = arguments.size() < 2 ? 8 : std::atoi(arguments[1].c_str());
  std::vector<std::string> subjects(arguments.begin() + std::min<std::ptrdiff_t>(2, std::ssize(arguments)),
                                    arguments.end());
  if (subjects.empty()) subjects = {"row-stream:output=indexed", "sliding-window:output=indexed"};
  const data::ControlMesh mesh = data::open_mesh(name).mesh;
  const bool triangles = 3 * mesh.faces.size() == mesh.faces.corners().size();
  const data::Scheme scheme = triangles ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
  fmt::print(
      "{}, scheme: {}\n\n| subject | depth | points | position, diagonals: median | 99.9 % | worst "
      "| normal, rad: median | 99.9 % | worst |\n|---|---|---|---|---|---|---|---|---|\n",
      name, triangles ? "loop" : "catmull-clark");
  for (const std::string& text : subjects) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const lc_subject* subject = verify::find_subject(text.substr(0, colon));
    if (subject == nullptr) throw data::ArgumentError("there is no subject " + text);
    verify::Session session(*subject, mesh, text.substr(std::min(colon + 1, text.size())),
                            verify::Session::Input::kValid, scheme);
    const reference::Surface limit(session.mesh(), scheme);
    for (int depth = 1; depth <= std::min(deepest, session.capabilities().max_depth); ++depth)
      print_line(session, limit, scheme, depth);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "accuracy: {}\n", error.what());
    return 2;
  }
}
