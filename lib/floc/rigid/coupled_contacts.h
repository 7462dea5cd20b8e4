#pragma once

#include "floc/base/aligned_vector.h"
#include "floc/geometry/frame.h"
#include "floc/rigid/contact_impulse.h"
#include "floc/rigid/coupled_response.h"
#include "floc/rigid/packed_contacts.h"

namespace floc {

/// Inverse inertia tensor, a symmetric matrix, stored without its repeated components.
template <int Dim>
struct PackedInertia;

template <>
struct PackedInertia<2> {
  double component;

  explicit PackedInertia(const Mat<1>& full) : component(full(0, 0)) {}
  RotationVector<2> operator*(const RotationVector<2>& v) const { return component * v; }
};

template <>
struct PackedInertia<3> {
  double xx, yy, zz, yz, xz, xy;

  explicit PackedInertia(const Mat<3>& full)
      : xx(full(0, 0)), yy(full(1, 1)), zz(full(2, 2)), yz(full(1, 2)), xz(full(0, 2)), xy(full(0, 1)) {}
  RotationVector<3> operator*(const RotationVector<3>& v) const {
    return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2],
            xz * v[0] + yz * v[1] + zz * v[2]};
  }
};

/// Contacts of bodies of any shape, at any points of their surfaces (a model, see packed_contacts.h). In 3D the
/// tangents of a contact are the axes in which the matrix of the response to tangential impulses is diagonal.
template <int Dim, bool Cell>
struct CoupledContacts {
  static constexpr int kDim = Dim;
  using Impulse = Vec<Dim>;

  struct alignas(kCacheLine) Body {
    Vec<Dim> velocity, inverse_mass;
    RotationVector<Dim> angular_velocity;
    PackedInertia<Dim> inverse_inertia;
    bool moves;
  };
  struct alignas(kCacheLine / 4) Contact : CellArm<Dim, Cell> {
    int i, j;
    Mat<Dim> frame;
    Vec<Dim> arm_i, arm_j, bias;
    double normal_compliance, tangential_compliance;
    Vec<Dim> impulse;
    CoupledResponse<Dim> response;
  };

  static Body pack(const BodyMotion<Dim>& bodies, int i, bool moves) {
    return {bodies.velocity[i], bodies.inverse_mass[i], bodies.angular_velocity[i],
            PackedInertia<Dim>(bodies.inverse_inertia[i]), moves};
  }

  static Contact pack(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c, double shared) {
    Mat<Dim> frame = c.frame;
    if constexpr (Dim == 3)
      frame.template rightCols<2>() *=
          principal_axes(packed_response(bodies, c, frame, shared).template bottomRightCorner<2, 2>());
    const Mat<Dim> turn = frame.transpose() * c.frame;
    CellArm<Dim, Cell> cell{};
    if constexpr (Cell) cell.branch = c.branch;
    return {cell,
            c.i,
            c.j,
            frame,
            c.arm_i,
            c.arm_j,
            turn * packed_bias<Dim, Cell>(bodies, c),
            c.normal_compliance,
            c.tangential_compliance,
            turn * c.impulse,
            CoupledResponse<Dim>(packed_response(bodies, c, frame, shared), c.friction)};
  }

  static Impulse normal_impulse(double p) { return p * Vec<Dim>::Unit(0); }

  static Vec<Dim> in_frame(const Contact& c, const Mat<Dim>& frame) {
    Vec<Dim> out = frame.transpose() * (c.frame * c.impulse);
    out[0] = c.impulse[0];
    return out;
  }

  static void apply(const Contact& c, const Impulse& impulse, Body* bodies, Vec<Dim>& gain) {
    const Vec<Dim> in_space = c.frame * impulse;
    // Several threads may solve contacts of a body that does not move, so no thread may change this body.
    if (Body& i = bodies[c.i]; i.moves) {
      i.velocity -= i.inverse_mass.cwiseProduct(in_space);
      i.angular_velocity -= i.inverse_inertia * moment<double>(c.arm_i, in_space);
    }
    if (Body& j = bodies[c.j]; j.moves) {
      j.velocity += j.inverse_mass.cwiseProduct(in_space);
      j.angular_velocity += j.inverse_inertia * moment<double>(c.arm_j, in_space);
    }
    c.add_gain(in_space, gain);
  }

  static void solve(Contact& c, Body* bodies, const Vec<Dim>& stretch, Vec<Dim>& gain) {
    const Vec<Dim> impulse = c.response.impulse(velocity_without_impulse(c, bodies, stretch));
    const Vec<Dim> change = impulse - c.impulse;
    c.impulse = impulse;
    apply(c, change, bodies, gain);
  }

  /// Returns contact_error() of a contact, computed with the response in its record.
  static double error(const Contact& c, const Body* bodies, const Vec<Dim>& stretch) {
    return contact_error<Dim>(
        {c.response.response(), velocity_without_impulse(c, bodies, stretch), c.response.friction()},
        c.impulse);
  }

  static double normal(const Contact& c) { return c.impulse[0]; }

 private:
  /// Returns the principal axes of a symmetric matrix as columns. For a multiple of the unit matrix, the coordinate
  /// axes are returned.
  static Mat<2> principal_axes(const Mat<2>& matrix) {
    const double angle = 0.5 * std::atan2(2.0 * matrix(0, 1), matrix(0, 0) - matrix(1, 1));
    Mat<2> out;
    out << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return out;
  }

  static Vec<Dim> velocity_without_impulse(const Contact& c, const Body* bodies, const Vec<Dim>& stretch) {
    const Body &i = bodies[c.i], &j = bodies[c.j];
    Vec<Dim> u = j.velocity - i.velocity;
    u += cross<double>(j.angular_velocity, c.arm_j);
    u -= cross<double>(i.angular_velocity, c.arm_i);
    c.add_velocity(stretch, u);
    Vec<Dim> q = c.frame.transpose() * u;
    // The effect of the present impulse on the velocities of the bodies is subtracted. `response` is the sum of this
    // effect and of the compliance, so the compliance is added again.
    q += c.bias - c.response.times(c.impulse) + c.tangential_compliance * c.impulse;
    q[0] += (c.normal_compliance - c.tangential_compliance) * c.impulse[0];
    return q;
  }
};

}  // namespace floc
