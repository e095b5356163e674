// SPDX-License-Identifier: MIT
// The compiled part of the Python package: control meshes, the exact surface, the engine. limitcheck/__init__.py puts the
// words to it.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/validate.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"
#include "reference/surface/certified.h"
#include "reference/surface/surface.h"

namespace py = pybind11;
using namespace limitcheck;
using py::literals::operator""_a;

namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

data::Scheme scheme_named(const std::string& name) {
  for (const auto scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
    if (name == data::name_of(scheme)) return scheme;
  throw data::ArgumentError("scheme is 'loop' or 'catmull-clark', not '" + name + "'");
}

// An array of rows of three, filled row by row.
Array<double> rows(std::size_t count) {
  return Array<double>({static_cast<py::ssize_t>(count), py::ssize_t{3}});
}

// A control mesh for one scheme; its surface is prepared when it is first evaluated.
class Mesh {
 public:
  Mesh(data::ControlMesh mesh, std::optional<std::string> scheme)
      : mesh_(std::move(mesh)), scheme_(scheme ? scheme_named(*scheme) : data::natural_scheme(mesh_)) {
    if (const auto found = data::validate(mesh_, scheme_); !found.empty())
      throw data::ArgumentError(std::string(data::code(found.front().fault)) + ": " + found.front().message);
  }
  static Mesh made(const Array<double>& vertices, const Array<std::int32_t>& corners,
                   const Array<std::int32_t>& sizes,
                   const std::vector<std::tuple<std::int32_t, std::int32_t, float>>& creases,
                   const std::vector<std::pair<std::int32_t, float>>& sharp_vertices, bool corners_held,
                   std::optional<std::string> scheme) {
    if (vertices.ndim() != 2 || vertices.shape(1) != 3)
      throw data::ArgumentError("vertices have the shape (n, 3)");
    data::ControlMesh mesh;
    const auto points = vertices.unchecked<2>();
    for (py::ssize_t v = 0; v < vertices.shape(0); ++v)
      mesh.positions.push_back({points(v, 0), points(v, 1), points(v, 2)});
    const std::int32_t* corner = corners.data();
    for (py::ssize_t f = 0; f < sizes.size(); corner += sizes.data()[f++])
      mesh.faces.push_back({corner, static_cast<std::size_t>(sizes.data()[f])});
    for (const auto& [a, b, sharpness] : creases) mesh.sharpness.edges.push_back({a, b, sharpness});
    for (const auto& [v, sharpness] : sharp_vertices) mesh.sharpness.vertices.push_back({v, sharpness});
    if (corners_held) mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    return {std::move(mesh), std::move(scheme)};
  }
  static Mesh load(const std::string& file, std::optional<std::string> scheme) {
    data::ReadOptions options{.leave_out_unused = true};
    if (scheme) options.scheme = scheme_named(*scheme);
    return {data::read_mesh(file, options), std::move(scheme)};
  }
  static Mesh generate(const std::string& name, std::optional<std::string> scheme) {
    return {data::named_mesh(name), std::move(scheme)};
  }

  void save(const std::string& file) const { data::write_mesh(file, mesh_); }
  std::string scheme() const { return std::string(data::name_of(scheme_)); }
  Array<double> vertices() const {
    auto out = rows(mesh_.positions.size());
    std::copy_n(mesh_.positions.empty() ? nullptr : mesh_.positions.front().data(),
                3 * mesh_.positions.size(), out.mutable_data());
    return out;
  }
  std::vector<std::vector<std::int32_t>> faces() const {
    std::vector<std::vector<std::int32_t>> list;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      list.emplace_back(mesh_.faces[f].begin(), mesh_.faces[f].end());
    return list;
  }

  py::dict evaluate(const Array<std::int32_t>& faces, const Array<double>& uv,
                    const std::optional<Array<std::int32_t>>& corners, int derivatives) {
    if (derivatives < 0 || derivatives > 2) throw data::ArgumentError("derivatives is 0, 1 or 2");
    if (uv.ndim() != 2 || uv.shape(1) != 2 || uv.shape(0) != faces.size() ||
        (corners && corners->size() != faces.size()))
      throw data::ArgumentError("faces have the shape (n), uv (n, 2), corners, if there are any, (n)");
    const std::int32_t* face = faces.data();
    const std::int32_t* corner = corners ? corners->data() : nullptr;
    const auto count = static_cast<std::size_t>(faces.size());
    for (std::size_t k = 0; k < count; ++k) check(face[k], corner != nullptr ? corner[k] : 0);
    static constexpr std::array<const char*, 7> kNames{"position", "d1", "d2", "normal", "d11", "d12", "d22"};
    const std::size_t columns = derivatives == 0 ? 1 : derivatives == 1 ? 4 : 7;
    std::vector<Array<double>> arrays;
    std::array<double*, 7> out{};
    for (std::size_t c = 0; c < columns; ++c) out[c] = arrays.emplace_back(rows(count)).mutable_data();
    {
      const py::gil_scoped_release unlocked;
      if (!surface_) surface_.emplace(mesh_, scheme_);
      const double* at = uv.data();
      const auto order = static_cast<reference::Derivatives>(derivatives);
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const auto p =
              surface_->evaluate(face[k], corner != nullptr ? corner[k] : 0, at[2 * k], at[2 * k + 1], order);
          const double none = std::numeric_limits<double>::quiet_NaN();
          const reference::Vec3<double> nothing{none, none, none};
          const std::array all{p.position,
                               p.first_exist ? p.d1 : nothing,
                               p.first_exist ? p.d2 : nothing,
                               p.normal,
                               p.second_exist ? p.d11 : nothing,
                               p.second_exist ? p.d12 : nothing,
                               p.second_exist ? p.d22 : nothing};
          for (std::size_t c = 0; c < columns; ++c) {
            out[c][3 * k] = all[c].x;
            out[c][3 * k + 1] = all[c].y;
            out[c][3 * k + 2] = all[c].z;
          }
        }
      });
    }
    py::dict result;
    for (std::size_t c = 0; c < columns; ++c) result[kNames[c]] = arrays[c];
    return result;
  }

  // Of each vector the decimals and the radius.
  py::dict certified(int face, const std::string& u, const std::string& v, int corner, int digits) {
    check(face, corner);
    using Enclosed = std::pair<std::array<std::string, 3>, double>;
    std::vector<std::pair<const char*, Enclosed>> found;
    {
      const py::gil_scoped_release unlocked;
      if (!certified_) certified_ = std::make_unique<reference::CertifiedEvaluator>(mesh_, scheme_);
      const auto p = certified_->evaluate(face, corner, reference::Parameter::parse(u),
                                          reference::Parameter::parse(v), digits);
      const auto add = [&](const char* name, const reference::Enclosure3& e) {
        found.emplace_back(name, Enclosed{{e[0].value, e[1].value, e[2].value},
                                          std::max({e[0].radius, e[1].radius, e[2].radius}).as_double()});
      };
      add("position", p.position);
      if (p.first_exist) add("d1", p.d1), add("d2", p.d2);
      add("normal", p.normal);
      if (p.d11) add("d11", *p.d11), add("d12", *p.d12), add("d22", *p.d22);
    }
    py::dict result;
    for (const auto& [name, e] : found) result[name] = py::make_tuple(e.first, e.second);
    return result;
  }

  // Of faces of given depths, or of a view: eye, target, up, field of view, width, height, pixels, largest depth.
  py::dict tessellate(const std::vector<std::int32_t>& depths,
                      const std::optional<std::array<double, 14>>& view) const {
    fast::IndexedMesh<double> out;
    {
      const py::gil_scoped_release unlocked;
      fast::TessellatorOptions options;
      options.provenance = true;
      options.scheme = scheme_;
      if (view) options.max_depth = static_cast<int>((*view)[13]);
      fast::Tessellator<double> engine(mesh_, options);
      if (view) {
        const auto& n = *view;
        fast::DepthOptions by;
        by.target_pixels = n[12];
        fast::Camera camera{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9]};
        camera.width = static_cast<int>(n[10]);
        camera.height = static_cast<int>(n[11]);
        engine.frame(by, camera, out);
      } else {
        engine.frame(depths, out);
      }
    }
    const std::size_t count = out.vertices.size();
    auto positions = rows(count), normals = rows(count);
    Array<double> uv({static_cast<py::ssize_t>(count), py::ssize_t{2}});
    Array<std::int32_t> face(static_cast<py::ssize_t>(count)), corner(static_cast<py::ssize_t>(count));
    for (std::size_t v = 0; v < count; ++v) {
      const auto put = [v](Array<double>& to, const auto& p) {
        double* row = to.mutable_data() + 3 * v;
        row[0] = p.x, row[1] = p.y, row[2] = p.z;
      };
      put(positions, out.vertices[v].position);
      put(normals, out.vertices[v].normal);
      const fast::LatticePoint& at = out.provenance[v];
      face.mutable_data()[v] = at.face;
      corner.mutable_data()[v] = at.corner;
      uv.mutable_data()[2 * v] = static_cast<double>(at.i) / at.denominator;
      uv.mutable_data()[2 * v + 1] = static_cast<double>(at.j) / at.denominator;
    }
    Array<std::uint32_t> triangles({static_cast<py::ssize_t>(out.triangles.size()), py::ssize_t{3}});
    std::copy_n(out.triangles.data()->data(), 3 * out.triangles.size(), triangles.mutable_data());
    return py::dict("positions"_a = positions, "normals"_a = normals, "triangles"_a = triangles,
                    "faces"_a = face, "uv"_a = uv, "corners"_a = corner);
  }

 private:
  void check(int face, int corner) const {
    if (face < 0 || static_cast<std::size_t>(face) >= mesh_.faces.size())
      throw data::ArgumentError("the mesh has faces 0 to " +
                                std::to_string(static_cast<long>(mesh_.faces.size()) - 1) + ", not " +
                                std::to_string(face));
    const std::size_t size = mesh_.faces[face].size();
    const std::size_t corners = scheme_ == data::Scheme::kLoop || size == 4 ? 1 : size;
    if (corner < 0 || static_cast<std::size_t>(corner) >= corners)
      throw data::ArgumentError("face " + std::to_string(face) + " has parts 0 to " +
                                std::to_string(corners - 1) + ", not " + std::to_string(corner));
  }

  data::ControlMesh mesh_;
  data::Scheme scheme_;
  std::optional<reference::Surface> surface_;
  std::unique_ptr<reference::CertifiedEvaluator> certified_;
};

}  // namespace

PYBIND11_MODULE(_core, m) {
  py::register_exception<data::Error>(m, "Error", PyExc_ValueError);
  py::class_<Mesh>(m, "Mesh")
      .def_static("made", &Mesh::made)
      .def_static("load", &Mesh::load)
      .def_static("generate", &Mesh::generate)
      .def("save", &Mesh::save)
      .def_property_readonly("scheme", &Mesh::scheme)
      .def_property_readonly("vertices", &Mesh::vertices)
      .def_property_readonly("faces", &Mesh::faces)
      .def("evaluate", &Mesh::evaluate)
      .def("certified", &Mesh::certified)
      .def("tessellate", &Mesh::tessellate);
}
