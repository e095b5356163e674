// SPDX-License-Identifier: MIT
#include "verify/host/host.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "data/error.h"
#include "data/validate.h"
#include "verify/host/matching.h"
#include "verify/host/subject_call.h"

namespace limitcheck::verify {

namespace {

// What is wrong with the capabilities, or nothing. Enumerations are compared as numbers, because those of a
// foreign library may hold any.
std::string impossible(const lc_capabilities& c) {
  const auto number = [](const auto& value) {
    std::int32_t n = 0;
    static_assert(sizeof value == sizeof n);
    std::memcpy(&n, &value, sizeof n);
    return n;
  };
  for (const auto& [name, value] : {std::pair{"precision", number(c.precision)},
                                    {"weights", number(c.weights)},
                                    {"boundary", number(c.boundary)},
                                    {"points", number(c.points)},
                                    {"normals", c.normals},
                                    {"per_face_depth", c.per_face_depth},
                                    {"exact_lattice", c.exact_lattice},
                                    {"does_not_validate", c.does_not_validate},
                                    {"no_provenance", c.no_provenance},
                                    {"channel_derivatives", c.channel_derivatives},
                                    {"points_anywhere", c.points_anywhere},
                                    {"quads_only", c.quads_only}})
    if (value != 0 && value != 1)
      return fmt::format("{} is {}, and only 0 and 1 mean something", name, value);
  if (c.schemes < 0 || c.schemes > (LC_DOES_LOOP | LC_DOES_CATMULL_CLARK))
    return fmt::format("schemes is {}", c.schemes);
  if (c.sharp < 0 || c.sharp >= 2 * LC_SHARP_NO_DARTS) return fmt::format("sharp is {}", c.sharp);
  if (c.channel_rules < 0 || c.channel_rules >= 2 << LC_CHANNEL_ALL)
    return fmt::format("channel_rules is {}", c.channel_rules);
  if (c.no_provenance != 0 && c.per_face_depth != 0)
    return "no_provenance and per_face_depth are 1, and only uniform depths can do without provenance";
  if (c.points_anywhere != 0 && (c.no_provenance != 0 || c.points != LC_POINTS_LIMIT))
    return "points_anywhere is 1, and only limit points with provenance can be anywhere";
  if (c.max_depth < 0) return fmt::format("max_depth is {}", c.max_depth);
  return {};
}

// "semi-sharp edges, sharp vertices".
std::string name_of_kinds(std::int32_t kinds) {
  std::string names;
  for (const auto& [bit, name] : {std::pair{std::int32_t{LC_SHARP_CREASES}, "edges that stay sharp"},
                                  {LC_SHARP_SEMI, "semi-sharp edges and vertices"},
                                  {LC_SHARP_CHAIKIN, "Chaikin's creasing"},
                                  {LC_SHARP_CORNERS, "sharp vertices"},
                                  {LC_SHARP_SMOOTH_TRIANGLES, "the smooth rule for triangles"}})
    if ((kinds & bit) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

}  // namespace

lc_capabilities capabilities(const lc_subject& subject, const std::string& options, data::Scheme scheme) {
  if (subject.abi < 1 || subject.abi > LC_SUBJECT_ABI) {
    throw NotAsked(fmt::format("the subject was built for interface {}, this program has {}", subject.abi,
                               LC_SUBJECT_ABI));
  }
  detail::Guarded<lc_capabilities> answer;
  lc_capabilities& result = answer.known;
  result.scheme = scheme_of(scheme);
  detail::call(subject, "capabilities", [&](const char** message) {
    return subject.capabilities(detail::text(options), &result, message);
  });
  answer.expect_nothing_behind(subject);
  if (const std::string wrong = impossible(result); !wrong.empty())
    throw SubjectDied(SubjectDied::Kind::kProtocol,
                      fmt::format("{}: its capabilities are impossible: {}", subject.name, wrong));
  return result;
}

Session::Session(const lc_subject& subject, const data::ControlMesh& mesh, std::string options, Input input,
                 std::optional<data::Scheme> asked)
    : subject_(subject), options_(std::move(options)), mesh_(mesh) {
  const data::Scheme scheme = asked.value_or(data::natural_scheme(mesh));
  capabilities_ = verify::capabilities(subject, options_, scheme);
  if (!does(capabilities_, scheme))
    throw NotAsked(fmt::format("{}: does not subdivide by {}", subject.name, data::name_of(scheme)));
  if (const std::int32_t beyond = sharp_kinds(mesh, scheme) & ~capabilities_.sharp; beyond != 0)
    throw NotAsked(fmt::format("{}: does not do {}", subject.name, name_of_kinds(beyond)));
  if (input == Input::kAsItIs && capabilities_.does_not_validate != 0)
    throw NotAsked(fmt::format("{}: does not validate", subject.name));
  if (input == Input::kValid && (capabilities_.sharp & LC_SHARP_NO_DARTS) != 0 && has_darts(mesh))
    throw NotAsked(fmt::format("{}: does not do sharp edges that end inside the surface", subject.name));
  const bool single = capabilities_.precision == LC_FLOAT32;
  // A channel that does not fit the mesh, as that of one with fewer faces, is nobody's to interpolate.
  std::erase_if(mesh_.channels, [&](const data::Channel& c) {
    const data::ChannelRule rule = c.rule.value_or(data::kUsualChannelRule);
    return (capabilities_.channel_rules >> static_cast<int>(rule) & 1) == 0 ||
           !data::fault_of(c, mesh_).empty();
  });
  if (input == Input::kValid) {
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v)
      if (!std::ranges::all_of(mesh_.positions[v], [](double x) { return std::isfinite(x); }))
        throw SubjectError(LC_INVALID_INPUT, fmt::format("vertex {} has no finite position", v));
    if (const std::string reason = out_of_range(mesh_, !single); !reason.empty()) throw NotAsked(reason);
  }
  if (single)
    for (auto& position : mesh_.positions)
      for (double& x : position) x = static_cast<double>(static_cast<float>(x));
  for (data::Channel& channel : mesh_.channels)
    for (double& x : channel.values)
      if (single) x = static_cast<double>(static_cast<float>(x));
  lent_ = LentMesh(mesh_, scheme);
  if (input == Input::kValid && capabilities_.quads_only != 0 && scheme == data::Scheme::kCatmullClark &&
      std::ranges::any_of(lent_.face_sizes, [](std::int32_t n) { return n != 4; }))
    throw NotAsked(fmt::format("{}: does quads alone", subject.name));

  const lc_mesh& mine = lent_.lend();
  detail::call(subject_, "create", [&](const char** message) {
    return subject_.create(&mine, detail::text(options_), &instance_, message);
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
  result.scheme_ = lent_.scheme;
  result.face_sizes_ = lent_.face_sizes;
  for (const data::Channel& channel : mesh_.channels)
    result.channel_components_.push_back(channel.components);
  const auto [delivered, release_threw] =
      detail::tessellate(subject_, instance_, face_depth, threads, *result.memory_);
  if (release_threw) result.defects_.push_back({Defect::Kind::kThrew, "", 1, -1, "release() threw"});
  std::function<Matching(const Bare&)> find_places;
  if (capabilities_.no_provenance != 0)
    find_places = [&](const Bare& t) {
      const int depth = face_depth.empty() ? 0 : face_depth.front();
      // A mesh that is no manifold was taken as it is: nothing can be laid on it.
      if (!expected_ && !data::validate(mesh_, lent_.scheme).empty())
        return Matching{
            .provenance = std::vector<lc_provenance>(static_cast<std::size_t>(t.vertices), {-1, 0, 0, 1}),
            .corner = std::vector<std::int32_t>(static_cast<std::size_t>(t.vertices)),
            .triangle_face = std::vector<std::int32_t>(t.triangles.size(), -1)};
      if (!expected_ || expected_->depth != depth)
        expected_ = std::make_shared<RefinedComplex>(mesh_, lent_.scheme, depth);
      return match(*expected_, t);
    };
  result.inspect(delivered, capabilities_, find_places);

  if (const LentMesh before(mesh_, lent_.scheme); !(before == lent_))
    result.defects_.push_back(
        {Defect::Kind::kMeshModified, "mesh", 1, -1, "the subject changed the control mesh"});
  return result;
}

std::string host_shortage() {
  struct Need {
    __rlimit_resource resource;
    rlim_t least;
    const char* of;
  };
  constexpr rlim_t kMemory = rlim_t{4} << 30;
  for (const Need& need : {Need{RLIMIT_AS, kMemory, "bytes of addresses"},
                           {RLIMIT_DATA, kMemory, "bytes of data"},
                           {RLIMIT_NOFILE, 64, "open files"},
                           {RLIMIT_NPROC, 64, "processes"}})
    if (rlimit limit{}; getrlimit(need.resource, &limit) == 0 && limit.rlim_cur < need.least)
      return fmt::format("not judged: the system allows {} {}, and a subject may take {}", limit.rlim_cur,
                         need.of, need.least);
  return {};
}

std::string out_of_range(const data::ControlMesh& mesh, bool double_precision) {
  const double most = std::ldexp(1.0, double_precision ? 240 : 100);
  double largest = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  if (largest == 0 || (largest >= 1 / most && largest <= most)) return {};
  return fmt::format(
      "the largest coordinate is {:.2g}: with {} it has to be between {:.2g} and {:.2g}; scale the mesh",
      largest, double_precision ? "double precision" : "single precision", 1 / most, most);
}

void require_range(const std::string& name, const data::ControlMesh& mesh, bool double_precision) {
  const std::string reason = out_of_range(mesh, double_precision);
  if (!reason.empty()) throw data::ArgumentError(name + ": " + reason);
}

}  // namespace limitcheck::verify
