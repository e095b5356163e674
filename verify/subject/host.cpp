// SPDX-License-Identifier: MIT
#include "verify/subject/host.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "data/error.h"
#include "verify/subject/coordinate_range.h"
#include "verify/subject/host_memory.h"
#include "verify/subject/subject_call.h"

namespace limitcheck::verify {
namespace {

const char* text(const std::string& options) {
  return options.empty() ? nullptr : options.c_str();
}

// What is wrong with the capabilities, or nothing. Enumerations are compared as numbers, because those of a
// foreign library may hold any.
std::string impossible(const lc_capabilities& c) {
  const auto number = [](const auto& value) {
    std::int32_t n = 0;
    static_assert(sizeof value == sizeof n);
    std::memcpy(&n, &value, sizeof n);
    return n;
  };
  struct Choice {
    const char* name;
    std::int32_t value;
  };
  for (const Choice& choice : {Choice{"precision", number(c.precision)},
                               {"weights", number(c.weights)},
                               {"boundary", number(c.boundary)},
                               {"points", number(c.points)},
                               {"normals", c.normals},
                               {"per_face_depth", c.per_face_depth},
                               {"exact_lattice", c.exact_lattice}})
    if (choice.value != 0 && choice.value != 1)
      return fmt::format("{} is {}, and only 0 and 1 mean something", choice.name, choice.value);
  if (c.max_depth < 0) return fmt::format("max_depth is {}", c.max_depth);
  return {};
}

}  // namespace

lc_capabilities capabilities(const lc_subject& subject, const std::string& options) {
  if (subject.abi != LC_SUBJECT_ABI) {
    throw NotAsked(fmt::format("the subject was built for interface {}, this program has {}", subject.abi,
                               LC_SUBJECT_ABI));
  }
  lc_capabilities result{};
  detail::call(subject, "capabilities",
               [&](const char** message) { return subject.capabilities(text(options), &result, message); });
  if (const std::string wrong = impossible(result); !wrong.empty())
    throw SubjectDied(SubjectDied::Kind::kProtocol,
                      fmt::format("{}: its capabilities are impossible: {}", subject.name, wrong));
  return result;
}

Session::Session(const lc_subject& subject, const data::ControlMesh& mesh, std::string options, Input input)
    : subject_(subject),
      options_(std::move(options)),
      capabilities_(verify::capabilities(subject, options_)),
      mesh_(mesh) {
  const bool single = capabilities_.precision == LC_FLOAT32;
  if (input == Input::kValid) {
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v)
      if (!std::ranges::all_of(mesh_.positions[v], [](double x) { return std::isfinite(x); }))
        throw SubjectError(LC_INVALID_INPUT, fmt::format("vertex {} has no finite position", v));
    if (const std::string reason = out_of_range(mesh_, !single); !reason.empty()) throw NotAsked(reason);
  }
  positions_.reserve(3 * mesh_.positions.size());
  for (auto& position : mesh_.positions)
    for (double& x : position) {
      if (single) x = static_cast<double>(static_cast<float>(x));
      positions_.push_back(x);
    }
  triangles_.reserve(3 * mesh_.faces.size());
  for (const auto& t : triangles_of(mesh_)) triangles_.insert(triangles_.end(), t.begin(), t.end());

  const lc_mesh view{positions_.data(), static_cast<std::int64_t>(mesh_.positions.size()), triangles_.data(),
                     static_cast<std::int64_t>(mesh_.faces.size())};
  detail::call(subject_, "create", [&](const char** message) {
    return subject_.create(&view, text(options_), &instance_, message);
  });
}

Session::~Session() {
  try {
    close();
  } catch (...) {  // nothing left to report to
  }
}

void Session::close() {
  if (closed_) return;
  closed_ = true;
  detail::call(subject_, "destroy", [this](const char**) {
    subject_.destroy(instance_);
    return LC_OK;
  });
}

std::string Session::label() const {
  return options_.empty() ? std::string(subject_.name) : fmt::format("{}:{}", subject_.name, options_);
}

Tessellation Session::tessellate(int depth, int threads) {
  const std::vector<std::int32_t> all(mesh_.faces.size(), depth);
  return tessellate(all, threads);
}

Tessellation Session::tessellate(std::span<const std::int32_t> face_depth, int threads) {
  if (face_depth.size() != mesh_.faces.size() || threads < 1 ||
      std::any_of(face_depth.begin(), face_depth.end(), [](std::int32_t d) { return d < -1; })) {
    throw data::ArgumentError("tessellate: one depth >= -1 for each face, and one thread or more");
  }
  if (!face_depth.empty()) {
    const auto [least, most] = std::minmax_element(face_depth.begin(), face_depth.end());
    if (*most > capabilities_.max_depth) {
      throw NotAsked(fmt::format("{}: depth {} is beyond its largest, {}", subject_.name, *most,
                                 capabilities_.max_depth));
    }
    if (capabilities_.per_face_depth == 0 && (*least != *most || *least == -1)) {
      throw NotAsked(fmt::format("{}: takes one depth for the whole mesh, not one per face", subject_.name));
    }
  }

  Tessellation result;
  result.memory_ = std::make_shared<detail::Memory>();
  result.precision_ = capabilities_.precision;
  result.faces_ = static_cast<std::int64_t>(mesh_.faces.size());
  const lc_request request{face_depth.data(), threads, result.memory_.get(), &detail::Memory::allocate};
  lc_tessellation out{};
  detail::call(subject_, "tessellate",
               [&](const char** message) { return subject_.tessellate(instance_, &request, &out, message); });

  // The arrays are the host's, so the subject can let go at once; a copy, because it may clear its own.
  const lc_tessellation delivered = out;
  try {
    subject_.release(instance_, &out);
  } catch (...) {
    result.defects_.push_back({Defect::Kind::kThrew, "", 1, -1, "release() threw"});
  }
  result.inspect(delivered, capabilities_.normals != 0);

  std::int64_t changed = 0, first = -1;
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    if (std::equal(mesh_.positions[v].begin(), mesh_.positions[v].end(),
                   positions_.begin() + 3 * static_cast<std::ptrdiff_t>(v)))
      continue;
    if (changed++ == 0) first = static_cast<std::int64_t>(v);
  }
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    if (std::equal(mesh_.faces[f].begin(), mesh_.faces[f].end(),
                   triangles_.begin() + 3 * static_cast<std::ptrdiff_t>(f)))
      continue;
    if (changed++ == 0) first = static_cast<std::int64_t>(f);
  }
  if (changed > 0) {
    result.defects_.push_back(
        {Defect::Kind::kMeshModified, "mesh", changed, first,
         fmt::format("the subject changed {} vertices or faces of the control mesh", changed)});
  }
  return result;
}

}  // namespace limitcheck::verify
