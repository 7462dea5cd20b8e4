#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Velocities and inverse masses of the bodies on which contacts act, and of the periodic cell. The inverse masses of a
/// body that does not move under impulses are zero.
template <int Dim>
struct BodyMotion {
  std::vector<Vec<Dim>> velocity;                     ///< velocity of each body (length/time)
  std::vector<RotationVector<Dim>> angular_velocity;  ///< angular velocity of each body (1/time)
  /// Inverse mass of each body along each axis of space (1/mass). For a wall, only the component along the normal can
  /// differ from zero.
  std::vector<Vec<Dim>> inverse_mass;
  /// inverse inertia tensor of each body in space-fixed axes (1/(mass length^2))
  std::vector<Mat<kRotations<Dim>>> inverse_inertia;
  Vec<Dim> stretch = Vec<Dim>::Zero();  ///< rate of stretch L_aa of each axis of the cell (1/time)
  /// Inverse 1/M_a of the inertia of each rate of stretch; zero if the rate is imposed (1/(mass length^2)).
  Vec<Dim> inverse_stretch_mass = Vec<Dim>::Zero();

  int size() const { return static_cast<int>(velocity.size()); }
};

/// A contact within an implicit time step. Its law is rigid (zero compliance) or elastic. The relative velocity after
/// the step is u = u_free + W p, with the velocity u_free without impulses, the response W and the impulse p. The
/// vector u + C p + b, with the compliance C and the bias b, takes the place of the relative velocity in the conditions
/// of ContactProblem. The relative velocity at the contact, in the frame F of the contact, is
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
  /// branch vector r from the centre of i to the centre of the periodic image of j (length)
  Vec<Dim> branch = Vec<Dim>::Zero();
  Mat<Dim> frame = Mat<Dim>::Identity();  ///< frame F; columns: the unit normal from i to j, then the tangents
  double friction = 0;                    ///< friction coefficient mu
  /// normal component of the compliance C: 1/(K dt^2) for a spring of stiffness K and the time step dt; 0 if rigid
  /// (1/mass)
  double normal_compliance = 0.0;
  double tangential_compliance = 0.0;  ///< tangential component of the compliance C (1/mass)
  /// Bias b (length/time). For a rigid contact with the gap g > 0, the normal component is g/dt. For springs of
  /// stiffness K, the normal component is K g dt C, and the tangential components are s/dt, with the elongation s.
  Vec<Dim> bias = Vec<Dim>::Zero();
  double adhesion = 0.0;  ///< impulse dt F_a of the adhesion F_a, >= 0
  /// Impulse (P, p_t): the repulsive part P of the normal impulse, and the tangential impulse p_t.
  Vec<Dim> impulse = Vec<Dim>::Zero();
};

}  // namespace floc
