#pragma once

#include "floc/geometry/frame.h"
#include "floc/rigid/step_contact.h"

/// Bodies and contacts of a time step as the sweeps of GaussSeidel read and change them: small records without
/// pointers, with all that does not change from sweep to sweep computed once. A model is a class with the types Body,
/// Contact and Impulse and with the functions of RoundContacts and CoupledContacts. In each of them, `stretch` is the
/// rate of stretch of the cell, and `gain` is the sum of r (F p) over impulses p, for each axis of space.
namespace floc {

/// Branch r of a contact, where the stretch of the cell has to be found with the impulses. Otherwise the velocity L r
/// is part of the bias.
template <int Dim, bool Cell>
struct CellArm {
  Vec<Dim> branch;

  void add_velocity(const Vec<Dim>& stretch, Vec<Dim>& u) const { u += stretch.cwiseProduct(branch); }
  void add_gain(const Vec<Dim>& in_space, Vec<Dim>& gain) const { gain += branch.cwiseProduct(in_space); }
};
template <int Dim>
struct CellArm<Dim, false> {
  void add_velocity(const Vec<Dim>&, Vec<Dim>&) const {}
  void add_gain(const Vec<Dim>&, Vec<Dim>&) const {}
};

/// Returns a matrix C + W' >= C + W of a contact with compliance C and response W, in a frame.
/// @param shared  number of contacts that change the stretch of the cell at once. Their common velocity is at most
///                that of each of them with `shared` times its own response to the stretch, so that with W' a sweep
///                never adds energy however light the cell is. W' is W for 1 contact, or without a cell.
template <int Dim>
Mat<Dim> packed_response(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c, const Mat<Dim>& frame,
                         double shared) {
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

/// Bias of a contact (length/time) in its frame, with the velocity of a stretch that is imposed.
template <int Dim, bool Cell>
Vec<Dim> packed_bias(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c) {
  if constexpr (Cell) return c.bias;
  return c.bias + c.frame.transpose() * bodies.stretch.cwiseProduct(c.branch);
}

}  // namespace floc
