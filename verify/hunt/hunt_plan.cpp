// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>
#include <utility>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/generators/star_meshes.h"
#include "data/sharpness_classes.h"
#include "data/splitmix64.h"
#include "data/validate.h"
#include "verify/evidence/cells.h"
#include "verify/host/host.h"
#include "verify/subject/lattice.h"
#include "verify/subject/lent_mesh.h"

namespace limitcheck::verify {

namespace {

constexpr std::size_t kCandidates = 4;
constexpr std::size_t kPatience = 16;     // after so many meshes that the subject does not do, a smooth one
constexpr double kMostTriangles = 40000;  // of a case, so that none takes more than about a second

std::uint64_t below(data::SplitMix64& random, std::uint64_t n) {
  return random.next() % n;
}

// A random mesh of a family; sizes from 6 to 200 faces, each doubling as likely.
std::string random_name(const char* family, data::SplitMix64& random) {
  const int faces = static_cast<int>(6 * std::exp2(5 * random.unit()));
  return fmt::format("{}:{}:{}", family, below(random, 1'000'000'000), faces);
}

// A few vertices amid their faces, of the classes of valence, sharpness and corners that an audit counts
// (evidence/cells.h), as far as the subject does them.
std::string classes_name(const Does& does, bool smooth, data::SplitMix64& random) {
  const bool loop = does.scheme == data::Scheme::kLoop;
  const auto can = [&](std::int32_t kinds) { return !smooth && (does.sharp & kinds) == kinds; };
  const auto one_in = [&](std::uint64_t n) { return below(random, n) == 0; };
  std::string letters;
  for (std::size_t k = 0; k < data::kSharpnessClasses.size(); ++k)
    if (can(k < data::kFirstInfiniteClass ? LC_SHARP_SEMI : LC_SHARP_CREASES))
      letters += data::kSharpnessClasses[k].letter;
  const auto letter = [&] { return letters.empty() ? '.' : letters[below(random, letters.size())]; };
  data::Stars stars;
  stars.seed = below(random, 1'000'000);
  stars.chaikin = can(LC_SHARP_CHAIKIN) && one_in(2);
  stars.corners_held = can(LC_SHARP_CORNERS) && one_in(2);
  stars.smooth_triangles = !loop && can(LC_SHARP_SMOOTH_TRIANGLES) && one_in(2);
  stars.stars.resize(1 + below(random, 4));
  for (data::Star& star : stars.stars) {
    const auto faces = static_cast<std::size_t>(least_of(below(random, kSizeClasses))) + below(random, 2);
    star.open = faces < 3 || one_in(3);
    star.bare = faces > 16 || one_in(2);
    const double share = random.unit() * std::min(1., 12 / static_cast<double>(faces));
    for (std::size_t k = 0; k < faces + (star.open ? 1 : 0); ++k)
      star.spokes += random.unit() < share ? letter() : '.';
    if (can(LC_SHARP_CORNERS) && one_in(3)) star.own = letter();
    if (one_in(2)) star.beyond = one_in(2) ? '=' : letter();
    if (!loop && faces <= 16 && one_in(2))
      for (std::uint64_t k = 1 + below(random, 3); k > 0; --k)
        star.corners.push_back(one_in(2) ? 3 : least_of(2 + below(random, kSizeClasses - 2)));
  }
  return (loop ? "star:" : "quad-star:") + stars.text();
}

// A mesh about one vertex; half of the valences are from 3 to 12, a quarter each to 40 and to 70.
std::string star_name(data::Scheme scheme, bool sharp, std::uint64_t turn, data::SplitMix64& random) {
  const std::uint64_t kind = below(random, 4);
  const int n = static_cast<int>(kind < 2    ? 3 + below(random, 10)
                                 : kind == 2 ? 13 + below(random, 28)
                                             : 41 + below(random, 30));
  const bool loop = scheme == data::Scheme::kLoop;
  const std::uint64_t seed = below(random, 1'000'000);
  switch (turn % (sharp ? 5 : 3)) {
    case 4:
      return fmt::format("{}:{}", loop ? "dart" : "quad-dart", n);
    case 3:
      return fmt::format("{}:{}", loop ? "corner" : "quad-corner", 2 + n / 4);
    case 0:
      return loop ? fmt::format("wheel:{}:2", n) : fmt::format("quad-wheel:{}:{}", n, seed);
    case 1:
      return loop ? fmt::format("fan:{}:2", n) : fmt::format("quad-fan:{}:{}", n, seed);
    default:
      return fmt::format("{}:{}", loop ? "bipyramid" : "prism", n);
  }
}

// A family with as much that is sharp as the subject does.
const char* sharp_family(const Does& does, bool smooth_triangles) {
  constexpr std::int32_t kAll = LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS;
  const bool loop = does.scheme == data::Scheme::kLoop;
  if ((does.sharp & kAll) != kAll) return loop ? "creased" : "mixed-creased";
  if (loop) return "sharp";
  return smooth_triangles && (does.sharp & LC_SHARP_SMOOTH_TRIANGLES) != 0 ? "smooth-triangles"
                                                                           : "mixed-sharp";
}

std::string mesh_name(const Does& does, std::uint64_t turn, bool smooth, data::SplitMix64& random) {
  const bool sharp = !smooth && (does.sharp & LC_SHARP_CREASES) != 0;
  std::string name;
  if (turn % 16 == 0)
    name = star_name(does.scheme, sharp, turn / 16, random);
  else if (turn % 8 == 0 || turn % 8 == 2)
    name = classes_name(does, smooth, random);
  else if (sharp && turn % 8 < 4)
    name = random_name(sharp_family(does, turn % 8 == 1), random);
  else
    name = random_name(does.scheme == data::Scheme::kLoop ? "random" : "mixed", random);
  switch (below(random, 8)) {
    case 0:
      name = fmt::format("handled:{}:{}", 1 + below(random, 4), name);
      break;
    case 1:
    case 2:
      name = fmt::format("turned:{}:{}", below(random, 1'000'000), name);
      break;
    default:
      break;
  }
  // Needles, in every fourth mesh.
  return below(random, 4) == 0 ? fmt::format("stretched:{}:{}", 1 + below(random, 14), name) : name;
}

struct Asked {
  int depth;
  std::string depths;
};

Asked depths_for(std::size_t faces, std::uint64_t turn, data::SplitMix64& random) {
  int most = 0;
  while (most < 6 && std::ldexp(static_cast<double>(faces), 2 * (most + 1)) <= kMostTriangles) ++most;
  const auto depth = [&](int least) {
    return least >= most
               ? most
               : least + static_cast<int>(below(random, static_cast<std::uint64_t>(most - least + 1)));
  };
  switch (turn % 8) {
    case 1:
    case 4:
      return {depth(2), fmt::format("random:{}", below(random, 1'000'000))};
    case 2:
    case 6:
      return {depth(2), fmt::format("random:{}:visible", below(random, 1'000'000))};
    case 5:
      return {depth(1), "view"};
    case 7:
      return {depth(0), "face0-culled"};
    default:
      return {depth(0), "uniform"};
  }
}

constexpr std::size_t kPairs = 64;  // that are tried at most; each is a question to the subject

struct Key {
  std::string name;
  std::vector<std::string> values;
};

bool in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

// "key=one|two|...": what stands behind each "=".
std::vector<Key> keys_in(std::string_view text) {
  std::vector<Key> keys;
  for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && in_word(text[begin - 1])) --begin;
    Key key{std::string(text.substr(begin, at - begin)), {}};
    for (std::size_t from = at + 1;;) {
      std::size_t end = from;
      while (end < text.size() && in_word(text[end])) ++end;
      if (end > from) key.values.emplace_back(text.substr(from, end - from));
      if (text.substr(from, 1) == "N") key.values = {"1", "2", "3", "4"};
      // "avx2/4" is a word that this does not know
      if (end < text.size() && text[end] == '/' && !key.values.empty()) key.values.pop_back();
      while (end < text.size() && text[end] != '|' && text[end] != ',' && text[end] != ' ') ++end;
      if (end >= text.size() || text[end] != '|') break;
      from = end + 1;
    }
    if (!key.name.empty() && !key.values.empty()) keys.push_back(std::move(key));
  }
  return keys;
}

// What the subject says that it does of these schemes; and of one over which it breaks down?
enum class Broken : std::uint8_t { kDoesNot, kDoesWithoutSharpEdges };
std::vector<Does> does_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes,
                          Broken broken) {
  std::vector<Does> all;
  for (const data::Scheme scheme : schemes) try {
      const lc_capabilities c = capabilities(*subject.subject, subject.options, scheme);
      if (does(c, scheme)) all.push_back({scheme, c.sharp});
    } catch (const std::exception&) {
      if (broken == Broken::kDoesWithoutSharpEdges) all.push_back({scheme, 0});
    }
  return all;
}

}  // namespace

std::vector<Does> schemes_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes) {
  return does_of(subject, schemes, Broken::kDoesWithoutSharpEdges);
}

std::set<std::uint64_t> kinds_of_edges(const AuditMesh& audited) {
  const data::ControlMesh& mesh = audited.mesh;
  const Lattice lattice(mesh, audited.scheme(), 0);
  std::vector<std::uint64_t> faces_at(mesh.positions.size());
  std::vector<bool> border(mesh.positions.size()), tagged(mesh.positions.size());
  for (const std::int32_t v : mesh.faces.corners()) ++faces_at[v];
  for (const Lattice::Edge& e : lattice.edges())
    if (e.on_boundary()) border[e.a] = border[e.b] = true;
  std::set<std::pair<std::int32_t, std::int32_t>> sharp;
  for (const data::SharpEdge& e : mesh.sharpness.edges) sharp.insert(std::minmax(e.a, e.b));
  for (const data::SharpVertex& v : mesh.sharpness.vertices) tagged[v.vertex] = true;

  std::set<std::uint64_t> kinds;
  const auto end = [&](std::int32_t v) {
    return std::min<std::uint64_t>(faces_at[v], 63) << 2 | (border[v] ? 1U : 0U) | (tagged[v] ? 2U : 0U);
  };
  const auto corners = [&](std::int32_t face) { return face < 0 ? 0 : mesh.faces[face].size(); };
  const auto depth = [&](std::int32_t face) {
    return audited.face_depth.empty() ? 0 : audited.face_depth[face];
  };
  for (const Lattice::Edge& e : lattice.edges()) {
    const auto [low, high] = std::minmax({end(e.a), end(e.b)});
    const auto [few, many] = std::minmax({corners(e.face[0]), corners(e.face[1])});
    std::uint64_t kind = low << 8 | high;
    kind = kind << 8 | std::min<std::size_t>(few, 15) << 4 | std::min<std::size_t>(many, 15);
    kind = kind << 4 |
           static_cast<std::uint64_t>(e.on_boundary() ? 0 : std::abs(depth(e.face[0]) - depth(e.face[1])));
    kinds.insert(kind << 1 | (sharp.contains({e.a, e.b}) ? 1U : 0U));
  }
  return kinds;
}

HuntPlan::HuntPlan(std::uint64_t seed, std::vector<Does> does, std::vector<Way> ways, bool tagged)
    : seed_(seed), does_(std::move(does)), ways_(std::move(ways)), tagged_(tagged) {
  if (does_.empty())
    throw data::ArgumentError("there is nothing to hunt: the subject does not do this scheme");
}

HuntCase HuntPlan::at(std::uint64_t number) {
  if (number < number_ || number / kBlock != number_ / kBlock || number_ % kBlock == 0) {
    number_ = number / kBlock * kBlock;
    seen_.clear();
  }
  while (number_ < number) (void)next();
  return next();
}

HuntCase HuntPlan::next() {
  Does does = does_[number_ % does_.size()];
  const std::uint64_t turn = number_ / does_.size();
  const std::uint64_t of_case = data::SplitMix64(seed_ + 0x632be59bd9b4e019U * number_).next();
  HuntCase best;
  data::SplitMix64 choice(of_case ^ 0x6f7074696f6e73U);
  std::string options;
  if (!ways_.empty() && below(choice, 2) == 0) {
    const Way& way = ways_[below(choice, ways_.size())];
    for (const Does& d : way.does)
      if (d.scheme == does.scheme) does = d, options = way.options;
  }
  std::set<std::uint64_t> best_kinds;
  std::size_t best_new = 0;
  for (std::size_t k = 0; k < kCandidates || best.mesh.name.empty(); ++k) {
    data::SplitMix64 random(of_case + k);
    AuditMesh m{mesh_name(does, turn, k >= kPatience, random), {}};
    if (tagged_ && turn % 8 != 7) m.name = fmt::format("tagged:{}:{}", below(random, 1'000'000), m.name);
    m.mesh = data::named_mesh(m.name);
    m.asked_scheme = does.scheme;
    if (!data::validate(m.mesh, does.scheme).empty() || !does_sharp(does.sharp, m.mesh, does.scheme))
      continue;
    const Asked asked = depths_for(m.mesh.faces.size(), turn / 8 + turn, random);
    m.depth = asked.depth, m.depths = asked.depths;
    m.face_depth = face_depths(parse_depths(asked.depths), m.mesh, m.depth);
    if (turn % 4 == 1) m.depths = fmt::format("after:{}:{}", below(random, 1'000'000), m.depths);
    m.relations = turn % 4 == 3;
    std::set<std::uint64_t> kinds = kinds_of_edges(m);
    std::size_t is_new = 1;
    for (const std::uint64_t kind : kinds) is_new += seen_.contains(kind) ? 0 : 1;
    if (is_new <= best_new) continue;
    best_new = is_new, best_kinds = std::move(kinds);
    best = {number_, std::move(m), options};
  }
  seen_.insert(best_kinds.begin(), best_kinds.end());
  ++number_;
  return best;
}

std::vector<Way> ways_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes,
                         const std::vector<std::string>& asked) {
  const char* const text = subject.subject->options;
  std::vector<Key> keys = keys_in(text != nullptr ? text : "");
  for (const std::string& name : asked)
    if (name != "all" && std::none_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; }))
      throw data::ArgumentError(fmt::format("--vary {}: the options of {} are {}", name,
                                            subject.subject->name, text != nullptr ? text : "none"));
  const auto given = [&](const std::string& name) {
    return fmt::format(",{}", subject.options).find(fmt::format(",{}=", name)) != std::string::npos;
  };
  std::erase_if(keys, [&](const Key& k) {
    const bool wanted = std::any_of(asked.begin(), asked.end(),
                                    [&](const std::string& name) { return name == "all" || name == k.name; });
    return !wanted || given(k.name);
  });

  std::vector<Way> ways;
  const auto attempt = [&](const std::string& more) {
    AuditSubject with = subject;
    with.options += (with.options.empty() ? "" : ",") + more;
    Way way{with.options, does_of(with, schemes, Broken::kDoesNot)};
    if (!way.does.empty()) ways.push_back(std::move(way));
  };
  std::vector<std::string> pairs;
  for (std::size_t a = 0; a < keys.size(); ++a)
    for (const std::string& x : keys[a].values) {
      attempt(keys[a].name + "=" + x);
      for (std::size_t b = a + 1; b < keys.size(); ++b)
        for (const std::string& y : keys[b].values)
          pairs.push_back(keys[a].name + "=" + x + "," + keys[b].name + "=" + y);
    }
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / kPairs);
  for (std::size_t k = 0; k < pairs.size(); k += step) attempt(pairs[k]);
  return ways;
}

}  // namespace limitcheck::verify
