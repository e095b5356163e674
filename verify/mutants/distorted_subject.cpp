// SPDX-License-Identifier: MIT
// The subject `distorted`: the recursive subdivider in double, of both schemes, with one fault of distortions.h.
//
//   options   fault=NAME (default none)
#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/host/host.h"
#include "verify/mutants/distortions.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;

const Distortion& fault_of(Options& options) {
  std::vector<std::string_view> names;
  for (const Distortion& d : distortions()) names.push_back(d.name);
  return distortions()[static_cast<std::size_t>(options.choice("fault", names))];
}

class DistortedSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    (void)fault_of(options);
    return verify::capabilities(*lc_subject_naive(), {}, scheme_of(scheme));
  }

  DistortedSubject(const lc_mesh& mesh, Options& options)
      : fault_(fault_of(options)), scheme_(scheme_of(mesh.scheme)), mesh_(known(control_mesh(mesh))) {
    (void)Session(*lc_subject_naive(), mesh_, {}, Session::Input::kAsItIs,
                  scheme_);  // refuses what it refuses
    if (mesh_.faces.size() == 0) throw SubjectError(LC_INVALID_INPUT, "no faces");
    last_ = mesh_;
    if (first_most_ == 0) first_most_ = most();
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    std::vector<std::int32_t> depths(request.face_depth, request.face_depth + mesh_.faces.size());
    const int deepest = std::max(0, *std::max_element(depths.begin(), depths.end()));
    if (fault_.kept == Distortion::Kept::kCulling) depths = first_.try_emplace(deepest, depths).first->second;
    Around around(mesh_, scheme_, deepest);
    around.first_most = first_most_;
    data::ControlMesh taken = mesh_;
    if (fault_.take) fault_.take(around, taken.sharpness);
    if (fault_.kept == Distortion::Kept::kTagsOfTheLast && last_.faces == mesh_.faces)
      taken.sharpness = last_.sharpness;
    Session session(*lc_subject_naive(), taken, {}, Session::Input::kValid, scheme_);
    const Tessellation t = session.tessellate(depths, request.threads);
    const auto to = allocate_output<double>(request, out, t.vertex_count(), t.triangle_count(), true,
                                            scheme_ == data::Scheme::kCatmullClark);
    std::copy(t.positions_f64().begin(), t.positions_f64().end(), to.positions);
    std::copy(t.normals_f64().begin(), t.normals_f64().end(), to.normals);
    std::copy(t.provenance().begin(), t.provenance().end(), to.provenance);
    std::copy(t.corners().begin(), t.corners().end(), to.corner);
    std::copy(t.triangle_face().begin(), t.triangle_face().end(), to.triangle_face);
    for (std::size_t k = 0; k < t.triangles().size(); ++k)
      std::copy(t.triangles()[k].begin(), t.triangles()[k].end(), to.triangles + 3 * k);
    if (!fault_.vertex && !fault_.face) return;
    double size = 0;
    for (const auto& p : mesh_.positions)
      for (const double x : p) size = std::max(size, std::abs(x));
    for (std::int64_t v = 0; v < t.vertex_count(); ++v)
      if (is_off(around, t.place(v))) to.positions[3 * v] += 1e-5 * size;
  }

 private:
  // The last instance empties what all share, as the end of a process would.
  struct Alive {
    Alive() { ++count; }
    ~Alive() {
      if (--count > 0) return;
      seen_.clear();
      last_ = {};
      first_most_ = 0;
    }
    Alive(const Alive&) = delete;
    Alive& operator=(const Alive&) = delete;
    inline static int count = 0;
  };

  // The first mesh that is the same but for what is forgotten.
  data::ControlMesh known(const data::ControlMesh& mesh) const {
    if (!fault_.forget) return mesh;
    data::ControlMesh key = mesh;
    fault_.forget(key);
    for (const auto& [other, first] : seen_)
      if (other == key) return first;
    seen_.emplace_back(std::move(key), mesh);
    return mesh;
  }

  int most() const {
    const Around around(mesh_, scheme_, 0);
    int most = 0;
    for (const std::int32_t v : mesh_.faces.corners()) most = std::max(most, around.faces(v));
    return most;
  }

  bool is_off(const Around& around, const Place& at) const {
    const auto face = static_cast<std::size_t>(at.face);
    const FaceDomain domain(scheme_, static_cast<int>(mesh_.faces[face].size()));
    const FaceDomain::Point p{at.i, at.j, at.corner};
    const std::int64_t n = domain.steps(at.denominator);
    if (fault_.face) return !domain.side_of(p, n) && fault_.face(around, face);
    const auto corner = domain.corner_at(p, n);
    return corner && fault_.vertex(around, mesh_.faces[face][static_cast<std::size_t>(*corner)]);
  }

  const Distortion& fault_;
  const data::Scheme scheme_;
  const data::ControlMesh mesh_;
  std::map<int, std::vector<std::int32_t>> first_;  // depths of requests by the deepest
  const Alive alive_;
  // Shared by all instances, as what is kept in a static variable would be.
  inline static std::vector<std::pair<data::ControlMesh, data::ControlMesh>> seen_;
  inline static data::ControlMesh last_;
  inline static int first_most_ = 0;
};

}  // namespace

extern "C" const lc_subject* lc_subject_distorted() {
  static const lc_subject subject = make_subject<DistortedSubject>(
      "distorted", "the recursive subdivider, with a fault that some tags, places or memories bring out",
      "fault=NAME (default none)");
  return &subject;
}
