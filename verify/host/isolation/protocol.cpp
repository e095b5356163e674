// SPDX-License-Identifier: MIT
#include "verify/host/isolation/protocol.h"

#include <fmt/core.h>

#include <bit>
#include <boost/locale/utf.hpp>
#include <charconv>
#include <cstdint>
#include <new>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <vector>

#include "verify/host/isolation/header.h"
#include "verify/subject/lent_mesh.h"

static_assert(std::endian::native == std::endian::little, "payloads are little-endian and sent as they lie");

namespace limitcheck::verify::protocol {
namespace {

std::string append(std::string text, std::initializer_list<std::span<const std::byte>> arrays) {
  for (const auto& bytes : arrays) text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text;
}

template <class T>
void append_rows(std::string& text, const T* data, std::int64_t rows, int columns) {
  for (std::int64_t row = 0; row < rows; ++row)
    for (int c = 0; c < columns; ++c) text += fmt::format("{}{}", *data++, c + 1 < columns ? ' ' : '\n');
}

// One line of a text payload: numbers separated by blanks, exactly as many as are taken.
class Row {
 public:
  Row(Source& source, const char* what, std::int64_t index)
      : text_(source.line(kLongestLine)), left_(text_), what_(what), index_(index) {}

  template <class T>
  T next() {
    skip_blanks();
    T value{};
    auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if constexpr (std::is_floating_point_v<T>) {
      // Beyond the range of its type a number is zero or infinite, as if it had been computed.
      long double wide = 0;
      if (error == std::errc::result_out_of_range)
        error = std::from_chars(left_.data(), left_.data() + left_.size(), wide).ec;
      if (wide != 0) value = static_cast<T>(wide);
    }
    if (error != std::errc{} || (end != left_.data() + left_.size() && *end != ' ' && *end != '\t')) refuse();
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return value;
  }
  void finish() {
    skip_blanks();
    if (!left_.empty()) refuse();
  }

 private:
  void skip_blanks() {
    const std::size_t begin = left_.find_first_not_of(" \t\r");
    left_.remove_prefix(begin == std::string_view::npos ? left_.size() : begin);
  }
  [[noreturn]] void refuse() const {
    throw Error(fmt::format("{} {} is \"{}\"", what_, index_, printable(text_, 80)));
  }

  const std::string text_;
  std::string_view left_;
  const char* what_;
  std::int64_t index_;
};

template <class Real>
void read_rows(Source& source, const lc_mesh& mesh, const lc_tessellation& out) {
  auto* position = static_cast<Real*>(out.positions);
  auto* normal = static_cast<Real*>(out.normals);
  for (std::int64_t v = 0; v < out.vertex_count; ++v) {
    Row row(source, "vertex", v);
    for (int c = 0; c < 3; ++c) *position++ = row.next<Real>();
    for (int c = 0; normal != nullptr && c < 3; ++c) *normal++ = row.next<Real>();
    if (out.provenance != nullptr) {
      lc_provenance& p = out.provenance[v];
      p.face = row.next<std::int32_t>();
      p.i = row.next<std::uint32_t>();
      p.j = row.next<std::uint32_t>();
      p.denominator = row.next<std::uint32_t>();
    }
    if (out.corner != nullptr) out.corner[v] = row.next<std::int32_t>();
    row.finish();
  }
  for (std::int64_t t = 0; t < out.triangle_count; ++t) {
    Row row(source, "triangle", t);
    for (int c = 0; c < 3; ++c) out.triangles[3 * t + c] = row.next<std::uint32_t>();
    if (out.triangle_face != nullptr) out.triangle_face[t] = row.next<std::int32_t>();
    row.finish();
  }
  const auto read_channels = [&](void* array, const char* what, std::int32_t numbers) {
    auto* value = static_cast<Real*>(array);
    if (value == nullptr) return;
    for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count)))
      for (std::int64_t corner = 0; corner < 3 * out.triangle_count; ++corner) {
        Row row(source, what, corner);
        for (std::int32_t k = 0; k < numbers * c.components; ++k) *value++ = row.next<Real>();
        row.finish();
      }
  };
  read_channels(out.channel_values, "channel value", 1);
  read_channels(out.channel_derivatives, "channel derivative", 2);
}

std::int32_t schemes_of(const Header& header) {
  const bool listed = header.at("schemes").is_array();
  const std::int32_t schemes = listed ? header.bits("schemes", kSchemes) : 0;
  if (schemes == 0) throw Error(R"("schemes" is no list with "loop" or "catmull-clark")");
  return schemes;
}

// "loop", "catmull-clark"
std::string_view name_of(lc_scheme scheme) {
  return data::name_of(scheme_of(scheme));
}

std::size_t real_size(const Capabilities& capabilities) {
  return capabilities.values.precision == LC_FLOAT32 ? sizeof(float) : sizeof(double);
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  const std::string_view shown = text.substr(0, longest);
  std::string out;
  for (auto at = shown.begin(); at != shown.end();) {
    auto next = at;
    const std::uint32_t code = boost::locale::utf::utf_traits<char>::decode(next, shown.end());
    if (boost::locale::utf::is_valid_codepoint(code) && code >= 0x20 && (code < 0x7F || code >= 0xA0)) {
      out.append(at, next);
      at = next;
    } else {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(*at++));
    }
  }
  return text.size() > longest ? out + "..." : out;
}

// Each question says version 1, as programs of that version expect it, and which is the latest.
std::string ask_capabilities(const std::string& options, lc_scheme scheme) {
  return to_line({{"limitcheck", 1},
                  {"latest", kVersion},
                  {"request", "capabilities"},
                  {"scheme", name_of(scheme)},
                  {"options", options}});
}

std::string ask_create(const lc_mesh& mesh, const std::string& options, const Capabilities& capabilities) {
  const bool polygons = capabilities.version > 1;
  nlohmann::json question{{"request", "create"}, {"options", options}, {"vertices", mesh.vertex_count}};
  if (polygons) {
    question["scheme"] = name_of(mesh.scheme);
    question["faces"] = mesh.face_count;
    question["corners"] = mesh.corner_count;
    question["sharp_edges"] = mesh.sharp_edge_count;
    question["sharp_vertices"] = mesh.sharp_vertex_count;
    question["creasing"] = mesh.creasing == LC_CREASING_CHAIKIN ? "chaikin" : "uniform";
    question["corners_held"] = mesh.corners_held != 0;
    question["smooth_triangles"] = mesh.smooth_triangles != 0;
    for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count)))
      question["channels"].push_back(
          {{"components", c.components}, {"rule", data::kChannelRules[c.rule]}, {"values", c.value_count}});
  } else {
    question["triangles"] = mesh.triangle_count;
  }
  std::string text = to_line(question);
  if (capabilities.payload == Payload::kText) {
    append_rows(text, mesh.positions, mesh.vertex_count, 3);
    const std::int32_t* corner = mesh.corners;
    for (std::int64_t f = 0; f < mesh.face_count; corner += mesh.face_sizes[f++])
      append_rows(text, corner, 1, mesh.face_sizes[f]);
    for (std::int64_t k = 0; k < mesh.sharp_edge_count; ++k) {
      const lc_sharp_edge& e = mesh.sharp_edges[k];
      text += fmt::format("{} {} {}\n", e.a, e.b, e.sharpness);
    }
    for (std::int64_t k = 0; k < mesh.sharp_vertex_count; ++k)
      text += fmt::format("{} {}\n", mesh.sharp_vertices[k].vertex, mesh.sharp_vertices[k].sharpness);
    for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count))) {
      append_rows(text, c.values, c.value_count, c.components);
      append_rows(text, c.corners, mesh.corner_count, 1);
    }
    return text;
  }
  std::vector<std::span<std::byte>> arrays = arrays_of(mesh);
  if (!polygons) arrays = {arrays[0], arrays[2]};  // positions and corners
  for (const auto& array : arrays) text = append(std::move(text), {array});
  return text;
}

std::string ask_tessellate(std::span<const std::int32_t> face_depth, int threads,
                           const Capabilities& capabilities) {
  std::string text = to_line({{"request", "tessellate"},
                              {"threads", threads},
                              {capabilities.version > 1 ? "faces" : "triangles", face_depth.size()}});
  if (capabilities.payload == Payload::kBinary) return append(text, {std::as_bytes(face_depth)});
  append_rows(text, face_depth.data(), static_cast<std::int64_t>(face_depth.size()), 1);
  return text;
}

std::string ask_end() {
  return to_line({{"request", "end"}});
}

Capabilities read_capabilities(Source& source) {
  const Header header = read_header(source);
  if (!header.has("limitcheck")) throw Error(R"(the first answer does not say "limitcheck": 1)");
  const std::int64_t version = header.integer("limitcheck", INT64_MIN, INT64_MAX);
  if (version < 1 || version > kVersion)
    throw Error(
        fmt::format("it speaks version {} of the protocol, this program speaks 1 to {}", version, kVersion));
  header.refuse_unless_ok();
  if (header.has("impossible")) throw Error(header.text("impossible"));  // the worker has seen it

  Capabilities result;
  result.version = static_cast<int>(version);
  lc_capabilities& c = result.values;
  c.precision = header.choice("precision", {"float32", "float64"}) == 0 ? LC_FLOAT32 : LC_FLOAT64;
  c.weights = header.choice("weights", {"loop", "warren"}) == 0 ? LC_WEIGHTS_LOOP : LC_WEIGHTS_WARREN;
  c.boundary = header.choice("boundary", {"spline", "none"}) == 0 ? LC_BOUNDARY_SPLINE : LC_BOUNDARY_NONE;
  c.points = header.choice("points", {"limit", "refined"}) == 0 ? LC_POINTS_LIMIT : LC_POINTS_REFINED;
  c.max_depth = static_cast<std::int32_t>(header.integer("max_depth", 0, INT32_MAX));
  c.normals = header.flag("normals");
  c.per_face_depth = header.flag("per_face_depth");
  c.exact_lattice = header.flag("exact_lattice");
  c.schemes = version == 1 ? std::int32_t{LC_DOES_LOOP} : schemes_of(header);
  c.sharp = version > 1 && header.has("sharp") ? header.bits("sharp", kSharpKinds) : 0;
  if (header.has("does_not_validate")) c.does_not_validate = header.flag("does_not_validate");
  if (header.has("provenance")) c.no_provenance = header.flag("provenance") ? 0 : 1;
  if (version > 1 && header.has("channels")) c.channel_rules = header.bits("channels", data::kChannelRules);
  if (version > 1 && header.has("channel_derivatives"))
    c.channel_derivatives = header.flag("channel_derivatives");
  if (version > 1 && header.has("points_anywhere")) c.points_anywhere = header.flag("points_anywhere");
  if (header.has("quads_only")) c.quads_only = header.flag("quads_only");
  if (header.has("options")) result.options = header.text("options");
  if (header.has("device")) result.device = printable(header.text("device"), 200);
  if (header.has("payload"))
    result.payload = header.choice("payload", {"binary", "text"}) == 0 ? Payload::kBinary : Payload::kText;
  return result;
}

void read_created(Source& source) {
  read_header(source).refuse_unless_ok();
}

int read_ended(Source& source) {
  const Header header = read_header(source);
  header.refuse_unless_ok();
  return static_cast<int>(header.integer("exit", 0, 255));
}

void read_tessellation(Source& source, const Capabilities& capabilities, std::uint64_t most_bytes,
                       const lc_mesh& mesh, const lc_request& request, lc_tessellation& out) {
  const Header header = read_header(source);
  header.refuse_unless_ok();
  const std::int64_t vertices = header.integer("vertices", 0, INT64_MAX);
  const std::int64_t triangles = header.integer("triangles", 0, INT64_MAX);

  // A count is checked before memory is allocated for it.
  const std::size_t point = 3 * real_size(capabilities);
  const bool normals = capabilities.values.normals != 0;
  const std::size_t values = 3 * components_of_channels(mesh) * real_size(capabilities);
  const std::size_t derivatives = capabilities.values.channel_derivatives != 0 ? 2 * values : 0;
  const double bytes =
      static_cast<double>(vertices) *
          static_cast<double>(point * (normals ? 2 : 1) + sizeof(lc_provenance) + sizeof(std::int32_t)) +
      static_cast<double>(triangles) * (16.0 + static_cast<double>(values + derivatives));
  if (bytes > static_cast<double>(most_bytes))
    throw Error(fmt::format("it announces {} vertices and {} triangles, {:.3g} MiB; {} MiB are allowed",
                            vertices, triangles, bytes / 1048576, most_bytes >> 20));
  out.vertex_count = vertices;
  out.triangle_count = triangles;
  std::vector<std::span<std::byte>> arrays;  // in the order of the payload
  const auto allocate = [&](auto*& array, std::int64_t count, std::size_t size) {
    const std::size_t whole = static_cast<std::size_t>(count) * size;
    void* const memory = request.allocate(request.host, whole);
    if (memory == nullptr) throw std::bad_alloc();
    array = static_cast<std::remove_reference_t<decltype(array)>>(memory);
    arrays.emplace_back(static_cast<std::byte*>(memory), whole);
  };
  const bool places = capabilities.values.no_provenance == 0;
  allocate(out.positions, vertices, point);
  if (normals) allocate(out.normals, vertices, point);
  if (places) allocate(out.provenance, vertices, sizeof(lc_provenance));
  if (places && capabilities.version > 1) allocate(out.corner, vertices, sizeof(std::int32_t));
  allocate(out.triangles, triangles, 3 * sizeof(std::uint32_t));
  if (places) allocate(out.triangle_face, triangles, sizeof(std::int32_t));
  if (values > 0) allocate(out.channel_values, triangles, values);
  if (derivatives > 0) allocate(out.channel_derivatives, triangles, derivatives);

  if (capabilities.payload == Payload::kBinary)
    for (const auto& array : arrays) source.read(array);
  else if (capabilities.values.precision == LC_FLOAT32)
    read_rows<float>(source, mesh, out);
  else
    read_rows<double>(source, mesh, out);
}

}  // namespace limitcheck::verify::protocol
