#pragma once

#include <array>
#include <span>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/contact_dynamics.h"

namespace floc {

/// Indices of the unknowns of a packing of frictionless polyhedra. The unknowns are the displacements and rotation
/// vectors of the grains, the displacements of the walls that move under a force, and the stretches of the cell along
/// axes under stress. The index of a fixed displacement or stretch is -1.
struct PlaneUnknowns {
  std::vector<int> wall;  ///< displacement of each wall along its axis
  std::array<int, 3> stretch = {-1, -1, -1};
  int n = 0;  ///< number of all unknowns

  PlaneUnknowns() = default;
  PlaneUnknowns(const Packing<3>& packing, const BoundaryLoad<3>& load);

  static int of_grain(int grain) { return 6 * grain; }
};

/// Number of unknowns of a pair: displacement and rotation vector of each body, and the stretches of the cell.
inline constexpr int kPairUnknowns = 15;
/// Number of unknowns of a plane: two turns of its normal, and its displacement along the normal.
inline constexpr int kPlaneUnknowns = 3;
using PlaneMatrix = Eigen::Matrix<double, kPairUnknowns + kPlaneUnknowns, kPairUnknowns + kPlaneUnknowns>;
using PlaneVector = Eigen::Matrix<double, kPairUnknowns + kPlaneUnknowns, 1>;

/// Plane between two convex bodies. Each vertex of a body has a gap to the plane, and the bodies do not overlap if and
/// only if there is a plane for which no gap is negative. The plane of a grain and a wall is the wall, and only the
/// vertices of the grain have gaps.
struct SeparatingPlane {
  int i = 0, j = 0;
  Vec<3, int> image;  ///< periodic image of j, as in Contact
  bool is_wall = false;
  Vec<3> branch;  ///< vector from the centre of i to the centre of the image of j, or to the wall (length)
  Vec<3> normal;  ///< unit normal, from i to j
  double offset;  ///< distance of the plane from the centre of i along the normal (length); not used for walls
  Vec<3> centre;  ///< point about which the plane turns, relative to the centre of grain i (length)
  std::array<int, kPairUnknowns> unknown;  ///< index of each unknown of the pair, -1 if it is fixed
  /// Gap (length) and multiplier (force) of each vertex of i, then of each vertex of j.
  std::vector<double> gap, multiplier;

  /// Returns the force between the bodies: the sum of the multipliers of the vertices of i (force).
  /// @param n_first  number of vertices of i
  double force(std::size_t n_first) const;
};

/// Vertices of all grains: the vectors from the centre of a grain to its vertices, in space-fixed axes. The only
/// vertex of a sphere is its centre.
class GrainVertices {
 public:
  explicit GrainVertices(const Grains<3>& grains);
  std::span<const Vec<3>> of(int grain) const {
    return {vertex_.data() + first_[grain], vertex_.data() + first_[grain + 1]};
  }
  /// Returns the radius of the rounding of a grain (length).
  double rounding(int grain) const { return rounding_[grain]; }
  /// Returns whether some grain is rounded.
  bool are_rounded() const;

 private:
  std::vector<Vec<3>> vertex_;
  std::vector<int> first_ = {0};
  std::vector<double> rounding_;
};

/// Finds the pairs of bodies that are closer than `reach` (length) and returns a plane for each of them, in the order
/// of the contacts of a packing. A pair with a plane in `known` keeps this plane up to the distance 2 `reach`, so that
/// a pair at the limit does not enter and leave the list again and again. A new plane lies midway between the bodies,
/// with the normal of their contact, and has no multipliers.
/// @pre the bodies do not overlap
std::vector<SeparatingPlane> separating_planes(const Packing<3>& packing, const GrainVertices& vertices,
                                               const PlaneUnknowns& unknowns, double reach,
                                               const std::vector<SeparatingPlane>& known);

/// Returns the plane of a contact in a list that separating_planes() returned; null if there is none.
const SeparatingPlane* plane_of(const Contact<3>& contact, const std::vector<SeparatingPlane>& planes);

/// Computes the gaps of all vertices of a pair.
void set_gaps(const GrainVertices& vertices, SeparatingPlane& plane);

/// Returns a plane after the step of its pair and its own step, and computes the gaps of all vertices.
/// @param motion  step of all unknowns of the packing
/// @param own     step of the pair and the plane, of which the last kPlaneUnknowns elements are used
/// @param share   factor of both steps
/// @param vertices  vertices of the grains after the step
SeparatingPlane moved_plane(const SeparatingPlane& plane, const Eigen::VectorXd& motion, const PlaneVector& own,
                            double share, const GrainVertices& vertices);

/// Numbers on which the terms of gaps in Newton's equations depend.
struct GapTerms {
  double mu;  ///< weight of the logarithms (energy)
  /// Force below which the multiplier l of a gap counts as weak: the second derivatives of the gap are multiplied by
  /// l/(l + weak). Those of wide gaps, which would make the matrix indefinite, thus disappear.
  double weak;
  double growth;  ///< relative growth of all grains in the step
};

/// Adds the terms of a pair to Newton's equations for a minimum of f - mu sum log g, with an objective f and a sum over
/// all gaps g (PlaneEquations). Let l be the multiplier, G the gradient and H the matrix of second derivatives of a
/// gap, and dg the change of the gap due to the growth of the grains. Adds to `matrix` the sum of (l/g) G G' - l H over
/// the gaps of the pair, and to `load` the sum of (mu - l dg)/g G.
void add_gaps(const GrainVertices& vertices, const SeparatingPlane& plane, const GapTerms& terms,
              PlaneMatrix& matrix, PlaneVector& load);

/// Returns the changes of all gaps to first order.
/// @param growth  relative growth of the grains in the step
std::vector<double> gap_changes(const GrainVertices& vertices, const SeparatingPlane& plane,
                                const PlaneVector& step, double growth);

}  // namespace floc
