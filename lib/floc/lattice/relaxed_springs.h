#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/spring_rows.h"

namespace floc {

/// Method that relaxes the springs of a lattice.
enum class LatticeMethod {
  automatic,  ///< `factor` in 2D, and in 3D for up to 20 000 unknowns; otherwise `iterative`
  factor,     ///< conjugate gradients with a Cholesky factor as preconditioner: a few steps per solution
  iterative,  ///< conjugate gradients with diagonal blocks as preconditioner: hundreds of steps, little memory
};

/// Progress of the relaxation of a lattice in one round. During a round, no unilateral element opens or closes.
struct RelaxationRound {
  int round;         ///< number of the round, from 1
  int n_open;        ///< number of open unilateral elements (which carry no force)
  int n_changed;     ///< number of unilateral elements that have opened or closed since the last round
  int n_steps;       ///< number of steps of conjugate gradients in this round
  double imbalance;  ///< size of the net forces on the nodes, divided by the size of the load
  bool factorized;   ///< whether a new preconditioner, such as a factor, was made in this round
};

struct RelaxationSettings {
  LatticeMethod method = LatticeMethod::automatic;
  /// The relaxation ends when the net forces on the nodes, divided by the load, are at most this number. Both are
  /// measured in the norm of the preconditioner.
  double tolerance = 1e-10;
  /// Range of `tolerance`. With a larger tolerance, the first iterate would count as the solution.
  static constexpr NumberRange kTolerance{.least = 0.0, .most = 1e-3, .without_least = true};
  int max_rounds = 100;  ///< largest number of rounds of the relaxation; about ten are usual
  /// Function that is called after each round of the relaxation, if set.
  std::function<void(const RelaxationRound&)> observe = {};
};

/// For each strain component of the cell, whether the strain or the load is imposed, and its value.
template <int Dim>
struct StrainControl {
  Eigen::Matrix<bool, kSymmetric<Dim>, 1>
      imposed;  ///< true if the strain is imposed, false if the load is imposed
  Eigen::Matrix<double, kSymmetric<Dim>, 1> value;  ///< imposed strain; or imposed load, as volume times stress
};

/// Report of the relaxation of a lattice.
struct SpringRelaxationReport {
  bool converged = false;
  bool holds = true;       ///< false if a mechanism, which no spring resists, moves under the load
  double imbalance = 0.0;  ///< size of the net forces that remain on the nodes, divided by the size of the load
  /// number of rounds, number of conjugate-gradient steps, and number of preconditioners that were made
  int n_rounds = 0, n_steps = 0, n_factors = 0;
};

/// Springs between nodes in a cell. The nodes and the strain of the cell are moved to the smallest energy. Some springs
/// are one-sided: they carry compression only. With the overlap o and the stiffness k of a spring, the energy is E =
/// sum_two k o^2/2 + sum_one k max(o, 0)^2/2 - dot(load, strain), where sum_two is over the two-sided and sum_one over
/// the one-sided springs. It is a convex function.
///
/// Newton's method finds the minimum of the energy. The active set consists of the one-sided springs in compression.
/// The first relaxation starts with all springs in the active set, and later relaxations start with the last active
/// set. Along each step, a line search finds the smallest energy. Therefore the energy decreases in every round, and no
/// active set occurs twice.
template <int Dim>
class RelaxedSprings {
 public:
  virtual ~RelaxedSprings() = default;

  /// Relaxes the springs under imposed strains and loads. If the relaxation does not converge, the springs are left in
  /// the best state found.
  /// @return report of the relaxation
  [[nodiscard]] virtual SpringRelaxationReport relax(const StrainControl<Dim>& control) = 0;
  /// Returns the volume times the stress per unit of each strain, in the order of StrainSet::full, after relaxation of
  /// the nodes. No spring opens or closes during this relaxation.
  /// @pre relax() was called
  virtual Eigen::MatrixXd tangent_stiffness() = 0;

  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> strain() const = 0;
  /// Returns the volume times the stress that the springs carry.
  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> load() const = 0;
  /// Returns the force of a spring: its stiffness times its overlap; 0 if the spring is open.
  /// @param row  number of the spring
  virtual double force(int row) const = 0;
  virtual bool open(int row) const = 0;
  /// Returns, for each element, the number of its first spring (row); the last entry is the number of springs.
  virtual const std::vector<int>& first_row() const = 0;
  /// Returns the displacement of a node of the lattice relative to the uniform strain; zero for a node without
  /// elements.
  virtual Vec<Dim> displacement(int node) const = 0;
  virtual int n_unknowns() const = 0;
  virtual double energy() const = 0;

  /// Removes all springs of an element.
  virtual void remove_element(int element) = 0;
};

/// Returns the springs of a lattice network.
template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings);

}  // namespace floc
