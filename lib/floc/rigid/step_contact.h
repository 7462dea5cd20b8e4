#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Velocities and inverse masses of the bodies on which contacts act, and of the periodic cell. A body that impulses
/// cannot move has zero inverse masses.
template <int Dim>
struct BodyMotion {
  std::vector<Vec<Dim>> velocity;                     ///< velocity of each body (length/time)
  std::vector<RotationVector<Dim>> angular_velocity;  ///< angular velocity of each body (1/time)
  /// Inverse mass of each body along each axis of space (1/mass); for a wall, only the component along its normal
  /// differs from zero.
  std::vector<Vec<Dim>> inverse_mass;
  /// inverse inertia tensor of each body in the axes of space (1/(mass length^2))
  std::vector<Mat<kRotations<Dim>>> inverse_inertia;
  Vec<Dim> stretch = Vec<Dim>::Zero();  ///< rate of stretch L_aa of each axis of the cell (1/time)
  /// Inverse inertia 1/M_a of each rate of stretch; zero if the rate is imposed (1/(mass length^2)).
  Vec<Dim> inverse_stretch_mass = Vec<Dim>::Zero();

  int size() const { return static_cast<int>(velocity.size()); }
};

/// A contact within a time step. Its law is rigid (zero compliance) or elastic with an implicit step: the relative
/// velocity after the step is u = u_free + W p, with the velocity u_free without impulses, the response W and the
/// impulse p, and the conditions of ContactProblem hold for u + C p + b, with the compliance C and the bias b. The
/// relative velocity at the contact, in its frame F, is
///
///     u = F'[v_j + w_j x a_j - v_i - w_i x a_i + L r],
///
/// with the velocities v and angular velocities w of the bodies, the arms a, the rate of stretch L and the branch
/// vector r.
template <int Dim>
struct StepContact {
  int i, j;        ///< indices of the two bodies
  Vec<Dim> arm_i;  ///< arm a_i from the centre of i to the contact point (length)
  Vec<Dim> arm_j;  ///< arm a_j from the centre of j to the contact point (length)
  /// branch vector r from the centre of i to the centre of the image of j (length)
  Vec<Dim> branch = Vec<Dim>::Zero();
  Mat<Dim> frame = Mat<Dim>::Identity();  ///< frame F; columns: the unit normal from i to j, then the tangents
  double friction = 0;                    ///< friction coefficient mu
  /// normal compliance C: 1/(K dt^2) for a spring of stiffness K and the time step dt; 0 if rigid (time/mass)
  double normal_compliance = 0.0;
  double tangential_compliance = 0.0;  ///< tangential compliance C (time/mass)
  /// Bias b (length/time): for a rigid contact with the gap g > 0, g/dt; for springs of stiffness K, K g dt C in the
  /// normal direction and s/dt in the tangential directions, with the elongation s.
  Vec<Dim> bias = Vec<Dim>::Zero();
  double adhesion = 0.0;  ///< impulse dt f_a of the adhesion f_a, >= 0
  /// Impulse (P, p_t): the repulsive part of the normal impulse, and the tangential impulses.
  Vec<Dim> impulse = Vec<Dim>::Zero();
};

}  // namespace floc
