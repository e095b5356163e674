// SPDX-License-Identifier: MIT
// The tasks of `limitcheck prove`: which topologies, in which arithmetic, to which depth; how they are run; and their rows
// as a table and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/proof/maps/prove_map.h"

namespace limitcheck::verify {

/// Over the points looked at. Lengths are of the control mesh's bounding-box diagonal.
struct CertifiedErrors {
  std::int64_t points = 0;
  double position = 0;  ///< no point is farther from the true surface's than this
  double normal = 0;    ///< degrees; likewise, of the angle between the normals where derivatives exist
  double radius = 0;    ///< largest radius of an enclosure, included above
  int face = -1;        ///< where the position is worst
  std::string l1, l2;   ///< or u, v; of a face that is no quad at the corner
  int corner = 0;
  /// What a bound for the unit box is a bound of here: the side of a box about the origin that holds the mesh, a
  /// power of two; 2^-24 of it more for placing the mesh.
  double unit = 0;
  /// 1 / |d1 x d2| in that unit, and what rounding the control points to the kernel's coordinates turns a normal
  /// by (its sine): the largest at any point whose normal was compared.
  double condition = 0, placing = 0;
};

/// What proofs of topologies say of a kernel: the largest of their rows.
struct ProvedBounds {
  double position = 0, product = 0;  ///< BoundProof::position_bound and product_bound
  /// What they allow the errors of a mesh: of the diagonal, and degrees.
  double position_of(const CertifiedErrors& errors) const;
  double normal_of(const CertifiedErrors& errors) const;
  bool hold(const CertifiedErrors& errors) const {
    return errors.position <= position_of(errors) && errors.normal <= normal_of(errors);
  }
};

/// Tessellates the mesh, of triangles by Loop's scheme and others by Catmull-Clark's, with the float kernel, the sliding
/// window or row streaming, and compares about `points` of its lattice points, spread evenly over the output, with the exact limit:
/// Stam's evaluator in ball arithmetic at `digits` digits, the control points taken as the floats they are.
/// Upper bounds: float to double is exact, a decimal is read to 2^-53 of itself, and radius and reading are
/// added. Points without two derivatives that span a plane count for positions alone: their normals are made
/// in double, and compared in the proofs of the topologies.
///   throws   data::ArgumentError: a coordinate that is no float
CertifiedErrors compare_certified(ProvedKernel kernel, const data::ControlMesh& mesh, int depth, int points,
                                  int digits = 20);

/// One mesh, one kernel.
struct CertifiedLine {
  std::string mesh, kernel;
  int depth = 0;
  CertifiedErrors errors;
};

/// The stock shapes of the audit, of Catmull-Clark's scheme a choice of its meshes: lines to be certified.
std::vector<CertifiedLine> stock_shape_lines(const std::vector<ProvedKernel>& kernels, int depth,
                                             data::Scheme scheme = data::Scheme::kLoop);
/// Fills in their errors, on all cores.
void certify(std::vector<CertifiedLine>& lines, int points);

enum class ProofSize : std::uint8_t {
  kSample,    ///< every tenth topology of each group and arithmetic of the standard set: a first look
  kStandard,  ///< every kind of topology; two minutes on two cores
  kFull       ///< deeper, and of Loop's scheme all bumpy spheres; some twenty minutes
};

struct ProofRequest {
  data::Scheme scheme = data::Scheme::kLoop;
  std::vector<int> valences{3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< of the interior triples or quadruples
  int depth = 6;                                               ///< the deepest
  bool sliding_window = true, row_stream = true;
  ProofSize size = ProofSize::kStandard;
};

/// Bounds of the rounding errors, for each of the depths; and the control meshes tried against
/// them, see prove_bound.
struct BoundOptions {
  int first_depth = 0, last_depth = 4;
  int meshes = 40;
};

/// One topology, one arithmetic.
struct ProofTask {
  std::string group;
  Neighbourhood neighbourhood;
  MapOptions options;
  std::optional<BoundOptions> bounds;
  double estimate = 0;  ///< of the work, in seconds of a core: good enough for a progress bar
};

struct ProofSet {
  data::Scheme scheme = data::Scheme::kLoop;
  std::vector<ProofTask> tasks;
  std::vector<std::string> impossible;  ///< triples of valences that no face of a manifold mesh has
  /// What is compared with certified enclosures, at about so many points each; the errors are not there yet.
  std::vector<CertifiedLine> certified;
  int certified_points = 12;
};

/// The groups of topologies, each with its kinds of arithmetic and depths, stand in the tables of proof_set.cpp.
ProofSet proof_set(const ProofRequest& request);

struct ProofProgress {
  std::size_t tasks = 0;  ///< done
  double share = 0;       ///< of the estimated work, 0 .. 1
  const ProofTask* latest = nullptr;
  const std::vector<ProofRow>* rows = nullptr;  ///< of the latest; none if it was stopped
};

/// Runs the tasks on all cores, begun in their order. The rows of task t are result[t], whatever the number
/// of threads.
///   progress   called from one thread at a time after every task
///   stop       asked by any thread between the steps of its task: once true, tasks not done have no rows
std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(const ProofProgress&)>& progress = {},
                                         const std::function<bool()>& stop = {});

class ProofReport {
 public:
  /// Both must outlive this; rows as `prove` returns them: a task without rows was not run.
  ProofReport(const ProofSet& set, const std::vector<std::vector<ProofRow>>& rows,
              std::vector<CertifiedLine> certified = {})
      : set_(set), rows_(rows), certified_(std::move(certified)) {}

  /// Whether every map that was proved is equal and no error exceeds its bound; those that are certified, once
  /// all rows are there to be compared with.
  bool held() const;
  /// Whether all of the set was done, certified lines and all.
  bool complete() const;
  /// A line per group and kernel, or with `each` per topology and kernel; then what failed, with its witness.
  std::string table(bool each) const;
  /// {"scheme": .., "held": .., "complete": .., "rows": [{"group", "topology", "kernel", "depths", "points",
  /// "map", "arithmetic", "digits", "witness", "bound", "worst", ..}], "impossible": [..], "certified": [{"mesh",
  /// "kernel", "depth", "points", "position", "normal", "position_bound", "normal_bound"}]}; bounds are null until
  /// all rows are there
  std::string json() const;

 private:
  bool has_all_rows() const;
  /// What the rows prove of the kernel that a certified line names.
  std::optional<ProvedBounds> proved_of(const CertifiedLine& line) const;

  const ProofSet& set_;
  const std::vector<std::vector<ProofRow>>& rows_;
  const std::vector<CertifiedLine> certified_;
};

/// Rows, and certified lines, as JSON that loses nothing, to go on with and to merge.
template <class T>
nlohmann::json list_json(const std::vector<T>& values);
template <class T>
std::vector<T> list_of(const nlohmann::json& json);

}  // namespace limitcheck::verify
