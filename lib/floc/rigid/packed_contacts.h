#pragma once

#include "floc/geometry/frame.h"
#include "floc/rigid/step_contact.h"

/// Bodies and contacts of a time step in the form that the sweeps of GaussSeidel read and change: small records without
/// pointers. All values that do not change during the sweeps are computed once and stored in the records. There are two
/// models, the classes RoundContacts and CoupledContacts. Both have the types Body, Contact and Impulse and the same
/// functions. The argument `stretch` of the functions is the rate of stretch of the cell. The argument `gain` contains,
/// for each axis a of space, the sum of r_a (F p)_a over the contacts, with the branch vector r, the frame F and the
/// impulse p.
namespace floc {

/// Branch vector r of a contact, stored only if the rate of stretch L of the cell is an unknown of the step. If L is
/// imposed, the velocity L r is part of the bias.
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

/// Returns the matrix C + W' of a contact in the given frame, with the compliance C and an upper bound W' of the
/// response W.
/// @param shared  number of contacts that change the stretch of the cell at the same time. W' is W with the response of
/// the cell multiplied by this number. A sweep then never adds energy, even if the cell is light. For one contact, or
/// without a cell, W' equals W.
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

/// Returns the bias of a contact in its frame (length/time). If the rate of stretch of the cell is imposed, the bias
/// includes the velocity that the stretch causes at the contact.
template <int Dim, bool Cell>
Vec<Dim> packed_bias(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c) {
  if constexpr (Cell) return c.bias;
  return c.bias + c.frame.transpose() * bodies.stretch.cwiseProduct(c.branch);
}

}  // namespace floc
