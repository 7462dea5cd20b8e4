#include "floc/rigid/gap_curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

#include "floc/geometry/frame.h"
#include "floc/network/contact_network.h"

namespace floc {
namespace {

/// Radius of curvature, divided by the size of the grain, that is used for a face instead of infinity.
constexpr double kFlat = 1e5;
/// Radius of curvature, divided by the size of the grain, that is used for a corner instead of zero.
constexpr double kSharp = 1e-7;
/// A vertex counts as a vertex of the face or edge in contact if its distance from the support plane, divided by the
/// size of the grain, is at most this number.
constexpr double kOnPlane = 1e-6;

template <int Dim>
using Tangents = Eigen::Matrix<double, Dim, Dim - 1>;
template <int Dim>
using TangentMatrix = Eigen::Matrix<double, Dim - 1, Dim - 1>;
/// Matrix that gives a tangential vector for a motion of the two grains of a contact.
template <int Dim>
using MotionMap = Eigen::Matrix<double, Dim - 1, 2 * kDofs<Dim>>;

/// Returns the matrix of the radii of curvature of a body, in the axes of the tangents, at the point with the outward
/// normal n (length).
template <int Dim>
TangentMatrix<Dim> radii_of_curvature(const Packing<Dim>& packing, int body, const Vec<Dim>& n,
                                      const Tangents<Dim>& tangents) {
  const TangentMatrix<Dim> one = TangentMatrix<Dim>::Identity();
  if (packing.is_wall(body)) return kFlat * packing.cell.matrix.diagonal().maxCoeff() * one;
  const double radius = packing.grains.radius[body];
  if (packing.grains.are_round()) return radius * one;
  const PlacedShape<Dim> placed = packing.grains.placed(body);
  const Shape<Dim>& shape = *placed.shape;
  TangentMatrix<Dim> out = placed.rounding() * one;
  if (shape.is_round()) return out;
  const Vec<Dim> direction = placed.rotation.transpose() * -n;
  const Vec<Dim> lowest = core_vertex(shape, lowest_vertex(shape, direction));
  for (const Vec<Dim>& vertex : shape.vertices) {
    const Vec<Dim> edge = vertex - lowest;
    if (edge.dot(direction) > kOnPlane * shape.outer_radius || edge.isZero(0.0)) continue;
    const Vec<Dim - 1> along = (tangents.transpose() * (placed.rotation * edge)).normalized();
    out += kFlat * radius * along * along.transpose();
  }
  return out;
}

/// Returns the vector from the centre of a body to its surface at a contact.
/// @param midway   vector from the centre to the point midway between the two surfaces; it is the result for walls and
/// for grains with corners
/// @param outward  normal of the body at the contact
template <int Dim>
Vec<Dim> surface_arm(const Packing<Dim>& packing, int body, const Vec<Dim>& midway, const Vec<Dim>& outward) {
  const bool is_ball = packing.grains.are_round() && !packing.is_wall(body);
  return is_ball ? Vec<Dim>(packing.grains.radius[body] * outward) : midway;
}

/// Returns the matrix that converts a rotation vector w to the tangential components of w x arm.
template <int Dim>
Eigen::Matrix<double, Dim - 1, kRotations<Dim>> turn(const Tangents<Dim>& tangents, const Vec<Dim>& arm) {
  Eigen::Matrix<double, Dim - 1, kRotations<Dim>> out;
  for (int a = 0; a < kRotations<Dim>; ++a)
    out.col(a) = tangents.transpose() * cross<double>(RotationVector<Dim>(RotationVector<Dim>::Unit(a)), arm);
  return out;
}

}  // namespace

template <int Dim>
PairMatrix<Dim> gap_curvature(const Packing<Dim>& packing, const Contact<Dim>& c) {
  const Vec<Dim> n = c.normal;
  const Tangents<Dim> tangents = contact_frame(n).template rightCols<Dim - 1>();
  const Vec<Dim> arm_i = surface_arm<Dim>(packing, c.i, c.arm_i - 0.5 * c.gap * n, n);
  const Vec<Dim> arm_j = surface_arm<Dim>(packing, c.j, c.arm_j + 0.5 * c.gap * n, -n);
  const bool wall = packing.is_wall(c.j);
  // Changes due to the motion of the grains: alpha is the change of a normal that rotates with grain i, beta is the
  // change of a normal that rotates with grain j, and w is the relative tangential displacement of the points in
  // contact.
  MotionMap<Dim> alpha = MotionMap<Dim>::Zero(), beta = alpha, w = alpha;
  alpha.template middleCols<kRotations<Dim>>(Dim) = turn<Dim>(tangents, n);
  w.template leftCols<Dim>() = -tangents.transpose();
  w.template middleCols<kRotations<Dim>>(Dim) = -turn<Dim>(tangents, arm_i);
  if (!wall) {
    beta.template rightCols<kRotations<Dim>>() = turn<Dim>(tangents, n);
    w.template middleCols<Dim>(kDofs<Dim>) = tangents.transpose();
    w.template rightCols<kRotations<Dim>>() = turn<Dim>(tangents, arm_j);
  }
  const TangentMatrix<Dim> radii_i = radii_of_curvature<Dim>(packing, c.i, n, tangents);
  const TangentMatrix<Dim> radii_j = radii_of_curvature<Dim>(packing, c.j, Vec<Dim>(-n), tangents);
  // The depth of an overlap is limited to half of the smallest eigenvalue of `sum`, so that the matrix below is
  // positive definite.
  const TangentMatrix<Dim> sum = radii_i + radii_j;
  const double least =
      Eigen::SelfAdjointEigenSolver<TangentMatrix<Dim>>(sum, Eigen::EigenvaluesOnly).eigenvalues()[0];
  const double apart = std::max(c.gap, -0.5 * least) + kSharp * packing.grains.radius[c.i];
  const TangentMatrix<Dim> inverse = (sum + apart * TangentMatrix<Dim>::Identity()).inverse();
  // The direction n that maximises the gap changes by inverse (w + radii_i alpha + radii_j beta).
  const MotionMap<Dim> drive = w + radii_i * alpha + radii_j * beta;
  PairMatrix<Dim> out = drive.transpose() * inverse * drive - alpha.transpose() * radii_i * alpha -
                        beta.transpose() * radii_j * beta;
  out.template block<kRotations<Dim>, kRotations<Dim>>(Dim, Dim) -= turn_curvature(arm_i, n);
  if (!wall) out.template bottomRightCorner<kRotations<Dim>, kRotations<Dim>>() += turn_curvature(arm_j, n);
  return 0.5 * (out + out.transpose());  // removes the asymmetry due to rounding errors of the large radii
}

template <int Dim>
PairMatrix<Dim> convex_stiffness(const PairMatrix<Dim>& curvature, double weight) {
  const Eigen::SelfAdjointEigenSolver<PairMatrix<Dim>> modes(-weight * curvature);
  const auto positive = modes.eigenvalues().cwiseMax(0.0);
  return modes.eigenvectors() * positive.asDiagonal() * modes.eigenvectors().transpose();
}

template PairMatrix<2> convex_stiffness<2>(const PairMatrix<2>&, double);
template PairMatrix<3> convex_stiffness<3>(const PairMatrix<3>&, double);
template PairMatrix<2> gap_curvature(const Packing<2>&, const Contact<2>&);
template PairMatrix<3> gap_curvature(const Packing<3>&, const Contact<3>&);

}  // namespace floc
