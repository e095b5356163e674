// SPDX-License-Identifier: MIT
// The kernels, and the result of the proofs about one of them and one topology: a line of the table.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>

namespace limitcheck::verify {

/// What is proved of pairs of triangles, and of quads, which have no centres of fans.
enum class ProvedKernel : std::uint8_t {
  kSlidingWindow,
  kCrackEdge,
  kCrackCentre,
  kRowStream,
  kRowStreamEdge,
  kRowStreamPatch  ///< of regular quads and pairs
};
inline constexpr std::array kProvedKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
                                           ProvedKernel::kCrackCentre,   ProvedKernel::kRowStream,
                                           ProvedKernel::kRowStreamEdge, ProvedKernel::kRowStreamPatch};
constexpr const char* name_of(ProvedKernel kernel) {
  constexpr std::array kNames{"sliding-window", "crack-edge",      "crack-centre",
                              "row-stream",     "row-stream-edge", "row-stream-patch"};
  return kNames[static_cast<std::size_t>(kernel)];
}
/// Throws std::logic_error: there is none of that name.
inline ProvedKernel kernel_named(const std::string& name) {
  for (const ProvedKernel kernel : kProvedKernels)
    if (name == name_of(kernel)) return kernel;
  throw std::logic_error("no kernel is called " + name);
}
constexpr bool is_stream(ProvedKernel kernel) {
  return kernel >= ProvedKernel::kRowStream;
}

/// Processor time of the calling thread: what a proof costs, however many share the machine.
class ThreadClock {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

/// The weight that is wrong, and where.
struct MapWitness {
  std::string point;       ///< "depth 3, face 0 at (1/8, 5/8)"
  std::string quantity;    ///< position, tangents, sum, negative, centre, ..
  int control_point = -1;  ///< vertex of the neighbourhood's mesh; 0 1 2 3 are the corners A B C D
  double found = 0, expected = 0;
};

/// Equality of two linear maps, the kernel's and the reference's, over all limit points of the depths.
struct MapProof {
  bool equal = false;
  std::string arithmetic;  ///< "exact": rationals and sqrt(3); "residues": modulo two primes; "digits"
  double digits = 0;       ///< of the largest difference; infinite if there is none
  std::optional<MapWitness> witness;
};

/// The float32 kernel as it ships (deliver), on a few control meshes at each depth. A share above 1,
/// or one that is no number, refutes the proof.
struct ShippedProof {
  double position_share = 0;  ///< largest share of its own point's bound that the error of a position had
  double normal_share = 0;    ///< likewise of a unit normal: of its angle's bound, or its length's
  std::string targets;        ///< of row streaming: the vector targets that ran, by a space
  std::string unlike;  ///< the first of them with other bits than the scalar code; empty: there is none

  bool held() const { return position_share <= 1 && normal_share <= 1 && unlike.empty(); }
  void add(const ShippedProof& other) {
    position_share = std::max(position_share, other.position_share);
    normal_share = std::max(normal_share, other.normal_share);
    if (targets.empty()) targets = other.targets;
    if (unlike.empty()) unlike = other.unlike;
  }
};

/// Rounding of a float32 kernel over all control meshes in the unit box.
struct BoundProof {
  int first_depth = 0, last_depth = 0;
  double position_bound = 0;  ///< of a coordinate
  double position_worst = 0;  ///< observed
  double tangent_bound = 0;   ///< of a coordinate, relative to the largest it can be
  double tangent_worst = 0;
  /// A unit normal is right to asin(normal_bound / q) + 2^-23, q the share that |du x dv| has of its largest.
  double normal_bound = 0;
  /// A unit normal is right to asin(product_bound / |d1 x d2|) + 2^-23, d1 and d2 the derivatives by the
  /// parameters of a face: the largest at any point but control vertices.
  double product_bound = 0;
  double share = 0;   ///< largest share of its own point's bound that an error had: at most 1
  bool alike = true;  ///< equal x, y and z give equal bits, so that the bound of x holds for y and z
  ShippedProof shipped;

  bool held() const { return share <= 1 && alike && shipped.held(); }
  /// What is true of both: the worst of either.
  void add(const BoundProof& other) {
    first_depth = std::min(first_depth, other.first_depth);
    last_depth = std::max(last_depth, other.last_depth);
    for (const auto figure : {&BoundProof::position_bound, &BoundProof::position_worst,
                              &BoundProof::tangent_bound, &BoundProof::tangent_worst,
                              &BoundProof::normal_bound, &BoundProof::product_bound, &BoundProof::share})
      this->*figure = std::max(this->*figure, other.*figure);
    alike = alike && other.alike;
    shipped.add(other.shipped);
  }
};

/// Counted at the last depth, per distinct limit point of the pair (operation_count.h).
struct CostProof {
  double flops = 0;    ///< position and unit normal, fma as two
  double vectors = 0;  ///< written during subdivision
};

struct ProofRow {
  std::string topology;  ///< signature of the pair (neighbourhood.h)
  std::string kernel;    ///< name_of a ProvedKernel
  int first_depth = 0, last_depth = 0;
  std::int64_t points = 0;  ///< limit points compared
  double seconds = 0;       ///< processor time that this row took
  MapProof map;
  std::optional<BoundProof> bound;
  std::optional<CostProof> cost;  ///< of sliding-window and row-stream
};

}  // namespace limitcheck::verify
