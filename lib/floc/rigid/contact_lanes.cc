#include "floc/rigid/contact_lanes.h"

#include <cmath>

namespace floc {
namespace {

template <int n>
void set_lane(const Vec<n>& from, Lanes (&to)[n], int lane) {
  for (int k = 0; k < n; ++k) to[k][lane] = from[k];
}

/// Returns the matrix C + W' of a contact in the given frame, with the compliance C and the upper bound W' of the
/// response (set_contact()).
template <int Dim>
Mat<Dim> bounded_response(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c, const Mat<Dim>& frame,
                          int shared) {
  Vec<Dim> per_axis = bodies.inverse_mass[c.i] + bodies.inverse_mass[c.j];
  per_axis += shared * c.branch.cwiseAbs2().cwiseProduct(bodies.inverse_stretch_mass);
  Mat<Dim> out = frame.transpose() * per_axis.asDiagonal() * frame;
  Eigen::Matrix<double, kRotations<Dim>, Dim> moments;
  for (int a = 0; a < Dim; ++a) moments.col(a) = moment<double>(c.arm_i, Vec<Dim>(frame.col(a)));
  out += moments.transpose() * bodies.inverse_inertia[c.i] * moments;
  for (int a = 0; a < Dim; ++a) moments.col(a) = moment<double>(c.arm_j, Vec<Dim>(frame.col(a)));
  out += moments.transpose() * bodies.inverse_inertia[c.j] * moments;
  out.diagonal() += Vec<Dim>::Constant(c.tangential_compliance);
  out(0, 0) += c.normal_compliance - c.tangential_compliance;
  return out;
}

/// Returns the bias of a contact in its frame (length/time). If the rate of stretch of the cell is imposed, the bias
/// includes the velocity that the stretch causes at the contact.
template <int Dim, bool Cell>
Vec<Dim> whole_bias(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c) {
  if constexpr (Cell) return c.bias;
  return c.bias + c.frame.transpose() * bodies.stretch.cwiseProduct(c.branch);
}

/// Sets the bodies, the branch vector and the impulses of a contact. Before the first sweep, the impulses at the start
/// of earlier sweeps are those of the contact.
template <class Group, int Dim>
void set_common(Group& group, int lane, const StepContact<Dim>& c, const Vec<Group::kImpulse>& impulse) {
  group.i[lane] = c.i;
  group.j[lane] = c.j;
  group.touches_itself = group.touches_itself || c.i == c.j;
  if constexpr (Group::kCell) set_lane<Dim>(c.branch, group.branch, lane);
  for (auto* const to : {&group.impulse, &group.start, &group.earlier_start})
    set_lane<Group::kImpulse>(impulse, *to, lane);
}

/// Returns the normal component of a vector in the frame of a contact, followed by its tangential vector.
template <int Dim>
Vec<1 + kShearComponents<Dim>> normal_and_shear(const Mat<Dim>& frame, const Vec<Dim>& v) {
  Vec<1 + kShearComponents<Dim>> out;
  out << v[0], to_shear<double>(Vec<Dim>(frame.col(0)),
                                Vec<Dim>(frame.template rightCols<Dim - 1>() * v.template tail<Dim - 1>()));
  return out;
}

/// Returns the principal axes of a symmetric matrix as columns. For a multiple of the unit matrix, the coordinate axes
/// are returned.
Mat<2> principal_axes(const Mat<2>& matrix) {
  const double angle = 0.5 * std::atan2(2.0 * matrix(0, 1), matrix(0, 0) - matrix(1, 1));
  Mat<2> out;
  out << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return out;
}

}  // namespace

template <int Dim>
void set_row(const BodyMotion<Dim>& bodies, int i, double* row) {
  using Row = BodyRow<Dim>;
  Eigen::Map<Vec<Dim>>(row + Row::kVelocity) = bodies.velocity[i];
  Eigen::Map<RotationVector<Dim>>(row + Row::kSpin) = bodies.angular_velocity[i];
  Eigen::Map<Vec<Dim>>(row + Row::kInverseMass) = bodies.inverse_mass[i];
  const auto& inertia = bodies.inverse_inertia[i];
  double* const to = row + Row::kInverseInertia;
  to[0] = inertia(0, 0);
  if constexpr (Dim == 3)
    to[1] = inertia(1, 1), to[2] = inertia(2, 2), to[3] = inertia(1, 2), to[4] = inertia(0, 2),
    to[5] = inertia(0, 1);
}

template <int Dim, bool Cell>
void set_contact(RoundGroup<Dim, Cell>& group, int lane, const BodyMotion<Dim>& bodies,
                 const StepContact<Dim>& c, int shared) {
  set_common(group, lane, c, normal_and_shear<Dim>(c.frame, c.impulse));
  const Vec<Dim> n = c.frame.col(0);
  set_lane<Dim>(n, group.normal, lane);
  // A body that does not rotate, such as a plane, may have any shape; the arm of such a body is set to zero.
  group.arm_i[lane] = bodies.inverse_inertia[c.i](0, 0) > 0.0 ? c.arm_i.dot(n) : 0.0;
  group.arm_j[lane] = bodies.inverse_inertia[c.j](0, 0) > 0.0 ? -c.arm_j.dot(n) : 0.0;
  // The sum of the absolute values in a row of the response is an upper bound (Gershgorin). The first row gives the
  // bound for the normal direction. The largest sum of the other rows is the bound for the tangential directions.
  // Off-diagonal components are due to walls and to the cell.
  const Vec<Dim> bound = bounded_response(bodies, c, c.frame, shared).cwiseAbs().rowwise().sum();
  const double normal = bound[0], tangential = bound.template tail<Dim - 1>().maxCoeff();
  group.inverse_normal[lane] = 1.0 / normal;
  group.inverse_tangential[lane] = 1.0 / tangential;
  group.keep_normal[lane] = 1.0 - c.normal_compliance / normal;
  group.keep_tangential[lane] = 1.0 - c.tangential_compliance / tangential;
  const auto bias = normal_and_shear<Dim>(c.frame, whole_bias<Dim, Cell>(bodies, c));
  group.bias_normal[lane] = bias[0] / normal;
  set_lane<kShearComponents<Dim>>(bias.template tail<kShearComponents<Dim>>() / tangential,
                                  group.bias_tangential, lane);
  group.friction[lane] = c.friction;
}

template <int Dim, bool Cell>
void set_contact(CoupledGroup<Dim, Cell>& group, int lane, const BodyMotion<Dim>& bodies,
                 const StepContact<Dim>& c, int shared) {
  Mat<Dim> frame = c.frame;
  if constexpr (Dim == 3)
    frame.template rightCols<2>() *=
        principal_axes(bounded_response(bodies, c, frame, shared).template bottomRightCorner<2, 2>());
  const Mat<Dim> turn = frame.transpose() * c.frame;
  set_common(group, lane, c, Vec<Dim>(turn * c.impulse));
  for (int b = 0; b < Dim; ++b)
    for (int a = 0; a < Dim; ++a) group.frame[Dim * b + a][lane] = frame(a, b);
  set_lane<Dim>(c.arm_i, group.arm_i, lane);
  set_lane<Dim>(c.arm_j, group.arm_j, lane);
  set_lane<Dim>(turn * whole_bias<Dim, Cell>(bodies, c), group.bias, lane);
  group.normal_compliance[lane] = c.normal_compliance;
  group.tangential_compliance[lane] = c.tangential_compliance;
  CoupledResponse<Dim> response(bounded_response(bodies, c, frame, shared), c.friction);
  int n = 0;
  response.visit([&](double value) { group.response[n++][lane] = value; });
}

template <int Dim, bool Cell>
Vec<Dim> impulse_in_frame(const RoundGroup<Dim, Cell>& group, int lane, const Mat<Dim>& frame) {
  Shear<Dim> tangential;
  for (int k = 0; k < kShearComponents<Dim>; ++k) tangential[k] = group.impulse[1 + k][lane];
  Vec<Dim> out = frame.transpose() * from_shear<double>(Vec<Dim>(frame.col(0)), tangential);
  out[0] = group.impulse[0][lane];
  return out;
}

template <int Dim, bool Cell>
Vec<Dim> impulse_in_frame(const CoupledGroup<Dim, Cell>& group, int lane, const Mat<Dim>& frame) {
  Vec<Dim> in_space = Vec<Dim>::Zero();
  for (int b = 0; b < Dim; ++b)
    for (int a = 0; a < Dim; ++a) in_space[a] += group.frame[Dim * b + a][lane] * group.impulse[b][lane];
  Vec<Dim> out = frame.transpose() * in_space;
  out[0] = group.impulse[0][lane];
  return out;
}

template void set_row(const BodyMotion<2>&, int, double*);
template void set_row(const BodyMotion<3>&, int, double*);
#define FLOC_INSTANTIATE(Group, Dim, Cell)                                                                 \
  template void set_contact(Group<Dim, Cell>&, int, const BodyMotion<Dim>&, const StepContact<Dim>&, int); \
  template Vec<Dim> impulse_in_frame(const Group<Dim, Cell>&, int, const Mat<Dim>&);
FLOC_INSTANTIATE(RoundGroup, 2, false)
FLOC_INSTANTIATE(RoundGroup, 2, true)
FLOC_INSTANTIATE(RoundGroup, 3, false)
FLOC_INSTANTIATE(RoundGroup, 3, true)
FLOC_INSTANTIATE(CoupledGroup, 2, false)
FLOC_INSTANTIATE(CoupledGroup, 2, true)
FLOC_INSTANTIATE(CoupledGroup, 3, false)
FLOC_INSTANTIATE(CoupledGroup, 3, true)
#undef FLOC_INSTANTIATE

}  // namespace floc
