#pragma once

#include <array>

#include "floc/contact/law_table.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/row_sums.h"

namespace floc::test {

/// Two spheres of unit diameter and mass whose motion is prescribed. The compiled kernels of one instruction set
/// compute their forces. At the start, the second sphere lies next to the first along the x axis.
class KernelPair {
 public:
  KernelPair(const LawParameters& law, double overlap, InstructionSet instructions)
      : grains_(start(overlap), {0, 1}),
        interaction_(Partner::grain, law, laws_of_same_rows({law})[0],
                     row_kind<3>(*laws_of_same_rows({law})[0]), 0.5, instructions, LatticeShape::rectangular) {
    interaction_.set_pairs({{{0, 1, {0, 0, 0}}}, Partner::grain, grains_, interaction_.law(), 1e-9, 1});
    rows_ = {{&interaction_.pairs()}, interaction_.rows(), 2, SweepPlan(interaction_.pairs(), 1, 1, 1)};
    interaction_.set_rows(rows_.rows_of_group(0));
    inverse_skin_squared_.assign(grains_.x[0].size(), 1.0);
  }

  Vec<3> position(int grain) const { return {grains_.x[0][grain], grains_.x[1][grain], grains_.x[2][grain]}; }

  /// Moves both spheres to the given positions within `time`, at constant velocities and angular velocities.
  void move(const std::array<Vec<3>, 2>& to, const std::array<Vec<3>, 2>& spin, double time) {
    for (int i = 0; i < 2; ++i)
      for (int a = 0; a < 3; ++a) {
        grains_.v[a][i] = (to[i][a] - grains_.x[a][i]) / time;
        grains_.x[a][i] = to[i][a];
        grains_.spin[a][i] = spin[i][a];
      }
    PairCell<3> cell{{}, {}, time, {}};
    for (int a = 0; a < 3; ++a) cell.lattice[a][a] = 100.0;
    interaction_.compute(interaction_.view(), 0, 1, grains_.view(grains_.x, inverse_skin_squared_), cell);
  }
  /// Moves the second sphere along the normal to the given overlap, without slip.
  void approach(double overlap, double time = 1.0) {
    const Vec<3> n = normal();
    move({position(0), position(0) + (1.0 - overlap) * n}, {Vec<3>::Zero(), Vec<3>::Zero()}, time);
  }
  /// Makes the surfaces slip by a vector in the tangent plane: both spheres rotate while their positions stay fixed.
  void slip(const Vec<3>& by) {
    // Surface j slips relative to surface i by -(l_i w_i + l_j w_j) x n, where w_i and w_j are the rotations, n is the
    // normal, and each of the lever arms l_i and l_j is half of the branch.
    const Vec<3> n = normal(), r = position(1) - position(0);
    const Vec<3> spin = -n.cross(by) / r.norm();
    move({position(0), position(1)}, {spin, spin}, 1.0);
  }

  /// Changes the overlap and makes the surfaces slip, both in one step.
  void approach_and_slip(double overlap, const Vec<3>& by) {
    const Vec<3> n = normal();
    const double mean_distance = 0.5 * ((position(1) - position(0)).norm() + 1.0 - overlap);
    const Vec<3> spin = -n.cross(by) / mean_distance;
    move({position(0), position(0) + (1.0 - overlap) * n}, {spin, spin}, 1.0);
  }

  Vec<3> normal() const { return (position(1) - position(0)).normalized(); }
  Vec<3> force_on_j() const { return row(force_in_row<3>(interaction_.rows())); }
  Vec<3> moment_on_i() const {
    if (interaction_.rows() == RowKind::moments) return row(RowLayout<3, RowKind::moments>::kMomentI);
    return number_in_row(Levers::kArmI) * row(Levers::kUnitMoment);
  }
  Vec<3> moment_on_j() const {
    if (interaction_.rows() == RowKind::moments) return row(RowLayout<3, RowKind::moments>::kMomentJ);
    return number_in_row(Levers::kArmJ) * row(Levers::kUnitMoment);
  }
  double normal_force() const { return force_on_j().dot(normal()); }
  /// Tangential force on the first sphere.
  Vec<3> tangential_force() const { return normal() * normal_force() - force_on_j(); }

  /// History of the contact between the spheres.
  ContactHistory<3> history() const { return interaction_.history(0, false); }
  void set_history(const ContactHistory<3>& history) {
    interaction_.load_history(0, history, false), interaction_.refresh_bridges();
  }

 private:
  static Grains<3> start(double overlap) {
    Grains<3> grains = Grains<3>::with_size(2);
    grains.position[1][0] = 1.0 - overlap;
    grains.radius.assign(2, 0.5);
    grains.mass.assign(2, 1.0);
    return grains;
  }
  using Levers = RowLayout<3, RowKind::levers>;
  double number_in_row(int at) const { return interaction_.view().row[at]; }
  Vec<3> row(int at) const { return {number_in_row(at), number_in_row(at + 1), number_in_row(at + 2)}; }

  GrainArrays<3> grains_;
  Interaction<3> interaction_;
  RowSums<3> rows_;
  AlignedVector<double> inverse_skin_squared_;
};

}  // namespace floc::test
