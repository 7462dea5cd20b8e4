#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/rigid/contact_impulse.h"

namespace floc {

/// Velocities and inverse masses of the bodies that contacts act on. A body that nothing moves has zero inverse masses.
template <int Dim>
struct BodyMotion {
  std::vector<Vec<Dim>> velocity;                     ///< (length/time)
  std::vector<RotationVector<Dim>> angular_velocity;  ///< (1/time)
  std::vector<Vec<Dim>> inverse_mass;                 ///< along each axis of space (1/mass)
  std::vector<Mat<kRotations<Dim>>> inverse_inertia;  ///< in space (1/(mass length^2))
  Vec<Dim> stretch = Vec<Dim>::Zero();                ///< rate of stretch of each axis of the cell (1/time)
  Vec<Dim> inverse_stretch_mass = Vec<Dim>::Zero();   ///< (1/(mass length^2)); zero: the rate is imposed

  int size() const { return static_cast<int>(velocity.size()); }
};

/// A contact within a time step. Its law is rigid (compliances zero) or elastic with an implicit step: the relative
/// velocity after the step is u = u_free + W p, and the conditions of ContactProblem hold for u + C p + b.
template <int Dim>
struct StepContact {
  int i, j;                            ///< bodies
  Vec<Dim> arm_i;                      ///< from the centre of i to the contact point (length)
  Vec<Dim> arm_j;                      ///< from the centre of j to the contact point (length)
  Vec<Dim> branch = Vec<Dim>::Zero();  ///< from the centre of i to the image of j (length)
  Mat<Dim> frame;                      ///< columns: the unit normal from i to j, then the tangents
  double friction = 0;                 ///< mu
  /// C of the normal and of the tangents (time/mass): 1/(K dt^2) of a spring K, 0 of a rigid contact.
  double normal_compliance = 0.0, tangential_compliance = 0.0;
  /// b (length/time): of a rigid contact g/dt of an open gap g; of springs K g dt C and s/dt of the elongation s.
  Vec<Dim> bias = Vec<Dim>::Zero();
  double adhesion = 0.0;  ///< dt f_a: impulse of the adhesion, >= 0
  Vec<Dim> impulse =
      Vec<Dim>::Zero();  ///< (P, p_t): the repulsive part of the normal impulse, and tangential ones
};

/// Result of the sweeps of a step.
struct SweepResult {
  int n_sweeps = 0;
  double residual = 0.0;  ///< largest contact_error() over the mean normal impulse
  bool converged = false;
};

/// Non-linear Gauss-Seidel method for the contacts of one implicit time step. Contacts of one colour share no body that
/// moves, so that the result does not depend on the order within a colour. Moreau 1988; Jean 1999.
template <int Dim>
class GaussSeidel {
 public:
  /// Takes the contacts of a step with their impulses as a start, and applies these to the bodies.
  /// @param bodies  velocities without the impulses of the contacts, to which all external impulses have been added
  GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int threads = 1);

  /// Sweeps over all contacts until the residual is below a tolerance.
  /// @param check_every  number of sweeps between two computations of the residual
  SweepResult solve(double tolerance, int max_sweeps, int check_every = 10);

  /// Number of colours of the contacts.
  int n_colours() const { return static_cast<int>(colour_start_.size()) - 1; }

  /// Largest contact_error() of the present impulses over the mean normal impulse.
  double residual() const;

 private:
  /// Action of an impulse of a contact on one of its bodies.
  struct Side {
    int body;
    double sign;                                         // +1 for j, -1 for i
    Eigen::Matrix<double, kRotations<Dim>, Dim> turn;    // angular velocity per impulse in the frame
    Eigen::Matrix<double, kRotations<Dim>, Dim> moment;  // moment per impulse in the frame
  };
  struct Block {
    int contact;
    Side on_i, on_j;
    Mat<Dim> response;  // W + C
    Mat<Dim> strain;    // relative velocity per stretch
  };

  void colour();
  Vec<Dim> relative_velocity(const Block& block) const;
  void apply(const Block& block, const Vec<Dim>& impulse);
  ContactProblem<Dim> problem(const Block& block) const;

  BodyMotion<Dim>& bodies_;
  std::vector<StepContact<Dim>>& contacts_;
  std::vector<Block> blocks_;
  std::vector<int> colour_start_;
};

}  // namespace floc
