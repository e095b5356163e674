// SPDX-License-Identifier: MIT
// A subject around a library of matrices: with igl::loop in the place of loop.h's it judges libigl. `halves`
// is the order in which a step cuts a triangle: each corner of the four lies between two old corners.
#include <limitcheck/subject.h>

#include "loop.h"

using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Indices = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Mesh = std::pair<Eigen::MatrixXd, Eigen::MatrixXi>;  // V and F

template <class Rows, class T>
void deliver(const lc_request& request, const Rows& rows, T*& array) {  // into memory of the host
  array = static_cast<T*>(request.allocate(request.host, sizeof(typename Rows::Scalar) * rows.size()));
  Eigen::Map<Rows>(reinterpret_cast<typename Rows::Scalar*>(array), rows.rows(), rows.cols()) = rows;
}

lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out, const char**) {
  const Indices halves{{2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {1, 1, 0},
                       {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 1}};
  auto [V, F] = *static_cast<Mesh*>(instance);
  Indices at = Indices{{0, 0}, {1, 0}, {0, 1}}.replicate(F.rows(), 1);  // (i, j) of each triangle's corners
  for (int d = 0; d < request->face_depth[0]; ++d) {
    loop(Eigen::MatrixXd(V), Eigen::MatrixXi(F), V, F);
    const Indices before = at;
    at.resize(3 * F.rows(), 2);
    for (int t = 0; t < F.rows(); t += 4) at.middleRows(3 * t, 12) = halves * before.middleRows(3 * t / 4, 3);
  }
  const int denominator = 1 << request->face_depth[0];
  Indices face(F.rows(), 1), provenance(V.rows(), 4);
  for (int t = 0; t < F.rows(); ++t) {
    face(t) = t / denominator / denominator;
    for (int k = 0; k < 3; ++k) provenance.row(F(t, k)) << face(t), at.row(3 * t + k), denominator;
  }
  out->vertex_count = V.rows(), out->triangle_count = F.rows();
  deliver<Points>(*request, V, out->positions), deliver<Indices>(*request, provenance, out->provenance);
  deliver<Indices>(*request, F, out->triangles), deliver<Indices>(*request, face, out->triangle_face);
  return LC_OK;
}

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static lc_subject subject{};
  subject.abi = LC_SUBJECT_ABI, subject.name = "matrices", subject.description = "Loop's scheme on matrices";
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    out->precision = LC_FLOAT64, out->points = LC_POINTS_REFINED, out->max_depth = 6, out->exact_lattice = 1;
    return out->does_not_validate = 1, LC_OK;  // others than oriented manifolds would crash it
  };
  subject.create = [](const lc_mesh* mesh, const char*, void** instance, const char**) {
    const Eigen::Map<const Points> V(mesh->positions, mesh->vertex_count, 3);
    const Eigen::Map<const Indices> F(mesh->triangles, mesh->triangle_count, 3);
    return *instance = new Mesh(V, F), LC_OK;
  };
  subject.tessellate = tessellate;
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<Mesh*>(instance); };
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
