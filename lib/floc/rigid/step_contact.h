#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Velocities and inverse masses of the bodies that contacts act on, and of the periodic cell. A body that nothing
/// moves has zero inverse masses.
template <int Dim>
struct BodyMotion {
  std::vector<Vec<Dim>> velocity;                     ///< (length/time)
  std::vector<RotationVector<Dim>> angular_velocity;  ///< (1/time)
  /// For each axis of space; a wall has one that differs from zero (1/mass).
  std::vector<Vec<Dim>> inverse_mass;
  std::vector<Mat<kRotations<Dim>>> inverse_inertia;  ///< in space (1/(mass length^2))
  Vec<Dim> stretch = Vec<Dim>::Zero();  ///< L_aa: rate of stretch of each axis of the cell (1/time)
  /// 1/M_a of the rates of stretch, zero where a rate is imposed (1/(mass length^2)).
  Vec<Dim> inverse_stretch_mass = Vec<Dim>::Zero();

  int size() const { return static_cast<int>(velocity.size()); }
};

/// A contact within a time step. Its law is rigid (compliances zero) or elastic with an implicit step: the relative
/// velocity after the step is u = u_free + W p, and the conditions of ContactProblem hold for u + C p + b. The relative
/// velocity at the contact, in its frame F, is
///
///     u = F'[v_j + w_j x a_j - v_i - w_i x a_i + L r].
template <int Dim>
struct StepContact {
  int i, j;                               ///< bodies
  Vec<Dim> arm_i;                         ///< a_i, from the centre of i to the contact point (length)
  Vec<Dim> arm_j;                         ///< a_j, from the centre of j to the contact point (length)
  Vec<Dim> branch = Vec<Dim>::Zero();     ///< r, from the centre of i to that of the image of j (length)
  Mat<Dim> frame = Mat<Dim>::Identity();  ///< F; columns: the unit normal from i to j, then the tangents
  double friction = 0;                    ///< mu
  double normal_compliance = 0.0;         ///< C of the normal: 1/(K dt^2) of a spring K, 0 if rigid (time/mass)
  double tangential_compliance = 0.0;     ///< C of the tangents (time/mass)
  /// b: of a rigid contact g/dt of an open gap g; of springs K g dt C and s/dt of the elongation s (length/time).
  Vec<Dim> bias = Vec<Dim>::Zero();
  double adhesion = 0.0;  ///< dt f_a: impulse of the adhesion, >= 0
  /// (P, p_t): the repulsive part of the normal impulse, and the tangential impulses.
  Vec<Dim> impulse = Vec<Dim>::Zero();
};

}  // namespace floc
