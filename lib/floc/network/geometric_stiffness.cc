#include "floc/network/geometric_stiffness.h"

namespace floc {
namespace {

/// Returns the matrix that is multiplied by a vector v to give the cross product v x force.
Eigen::Matrix<double, 1, 2> crossed_with(const Vec<2>& force) {
  return {force[1], -force[0]};
}
Eigen::Matrix3d crossed_with(const Vec<3>& f) {
  return Eigen::Matrix3d{{0.0, f[2], -f[1]}, {-f[2], 0.0, f[0]}, {f[1], -f[0], 0.0}};
}

/// Returns a matrix for one of the two grains of a contact. Its product with the unknowns of this grain is the motion
/// at the contact (rows as in MotionMatrix).
/// @param sign            1 for grain j, -1 for grain i: the displacement of j relative to i contains the displacement
/// of this grain with this sign
/// @param first_rotation  first row of the rotation of this grain
/// @param size            length by which rotations are multiplied to give the unknowns
template <int Dim>
Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> motion_of_grain(double sign, int first_rotation,
                                                                    double size) {
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> rows;
  rows.setZero();
  rows.template topLeftCorner<Dim, Dim>() = sign * Mat<Dim>::Identity();
  rows.template block<kRotations<Dim>, kRotations<Dim>>(first_rotation, Dim).setIdentity();
  rows.template rightCols<kRotations<Dim>>() /= size;
  return rows;
}

}  // namespace

template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const NetworkContact<Dim>& c) {
  constexpr int kRotationDofs = kRotations<Dim>;
  const Vec<Dim> n = c.normal();
  const double r = c.branch.norm();
  const Vec<Dim>& shear = c.shear_force;
  const Mat<Dim> across = Mat<Dim>::Identity() - n * n.transpose();
  const double share_i = c.arm_i.dot(n) / r;
  const double share_j = -c.arm_j.dot(n) / r;

  // The header defines the symbols. The displacement of j relative to i does work on the force on j, which is -f. The
  // rows of the displacement therefore contain +df, and the rows of the rotations contain minus the changes of the
  // moments. The part n x dn of the rotation of the frame gives w x S = -n (S.dn), which is parallel to r, so r x (w x
  // S) is zero.
  MotionMatrix<Dim> k = MotionMatrix<Dim>::Zero();
  k.template topLeftCorner<Dim, Dim>() = -(c.normal_force * across + n * shear.transpose()) / r;
  const auto moment_by_displacement = crossed_with(shear).eval();
  k.template block<kRotationDofs, Dim>(Dim, 0) = -share_i * moment_by_displacement;
  k.template block<kRotationDofs, Dim>(Dim + kRotationDofs, 0) = -share_j * moment_by_displacement;
  if constexpr (Dim == 3) {
    const Vec<3> springs = spring_moment<3>(c.rolling_moment, c.twisting_moment, n);
    const Mat<3> springs_by_displacement = (n.dot(springs) * across - n * (across * springs).transpose()) / r;
    k.template block<3, 3>(3, 0) -= springs_by_displacement;
    k.template block<3, 3>(6, 0) += springs_by_displacement;
    Eigen::Matrix<double, 9, 1> by_twist;
    const Vec<3> springs_by_twist = n.cross(springs);
    by_twist << n.cross(shear), share_i * r * shear - springs_by_twist, share_j * r * shear + springs_by_twist;
    k.template block<9, 3>(0, 3) += 0.5 * by_twist * n.transpose();
    k.template block<9, 3>(0, 6) += 0.5 * by_twist * n.transpose();
  }
  return k;
}

template <int Dim>
GrainMotions<Dim> grain_motions(const NetworkContact<Dim>& c, double size_i, double size_j) {
  GrainMotions<Dim> motions{motion_of_grain<Dim>(-1.0, Dim, size_i),
                            motion_of_grain<Dim>(1.0, Dim + kRotations<Dim>, size_j)};
  if (c.i == c.j) {
    if (!c.on_wall()) motions.on_i += motions.on_j;
    motions.on_j.setZero();
  }
  return motions;
}

template MotionMatrix<2> geometric_stiffness(const NetworkContact<2>&);
template MotionMatrix<3> geometric_stiffness(const NetworkContact<3>&);
template GrainMotions<2> grain_motions(const NetworkContact<2>&, double, double);
template GrainMotions<3> grain_motions(const NetworkContact<3>&, double, double);

}  // namespace floc
