#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// Method that relaxes the springs of a lattice.
enum class LatticeMethod {
  automatic,  ///< `factor` in 2D and for up to 20 000 unknowns in 3D, otherwise `iterative`
  factor,     ///< conjugate gradients with a Cholesky factor as preconditioner: a few steps per solution
  iterative,  ///< conjugate gradients with diagonal blocks as preconditioner: hundreds of steps, little memory
};

/// Progress of one round of the relaxation, in which the set of closed unilateral elements (the active set) is fixed.
struct RelaxationRound {
  int round;         ///< number of the round, from 1
  int n_open;        ///< number of open unilateral elements
  int n_changed;     ///< number of elements that have opened or closed since the last round
  int n_steps;       ///< number of steps of conjugate gradients
  double imbalance;  ///< imbalance of the forces over the size of the load
  bool factorized;   ///< whether a new factor or preconditioner was made
};

struct RelaxationSettings {
  LatticeMethod method = LatticeMethod::automatic;
  /// Largest imbalance of the forces that is accepted, over the size of the load, in the norm of the preconditioner.
  double tolerance = 1e-10;
  int max_rounds = 100;  ///< largest number of rounds; about ten are usual
  /// Function that is called once per round, if set.
  std::function<void(const RelaxationRound&)> observe = {};
};

/// Control of the cell: for each component, whether the strain or the load is imposed, and its value.
template <int Dim>
struct StrainControl {
  Eigen::Matrix<bool, kSymmetric<Dim>, 1>
      imposed;  ///< true if the strain is imposed, false if the load is imposed
  Eigen::Matrix<double, kSymmetric<Dim>, 1> value;  ///< strain, or load as volume times stress
};

/// Report of the relaxation of a lattice.
struct SpringRelaxationReport {
  bool converged = false;
  bool holds = true;       ///< false if no spring resists the load, which then moves a mechanism
  double imbalance = 0.0;  ///< remaining imbalance of the forces over the size of the load
  int n_rounds = 0, n_steps = 0, n_factors = 0;  ///< numbers of rounds, steps and preconditioners made
};

/// Springs between nodes and the strain of their cell, relaxed to the smallest energy. Some springs are one-sided: they
/// carry compression only. With the overlaps o, the energy 1/2 sum k o^2 + 1/2 sum over the one-sided springs of k
/// max(o, 0)^2 - load . strain is convex. The state is found by Newton's method for the set of one-sided springs in
/// compression (the active set), starting from the last set, or at first with all springs closed. A line search for the
/// smallest energy along each step makes the energy decrease in every round, so that no set occurs twice.
template <int Dim>
class RelaxedSprings {
 public:
  virtual ~RelaxedSprings() = default;

  /// Relaxes the springs under imposed strains and loads.
  /// @return report of the relaxation; the state is the best one found, whether or not it has converged
  [[nodiscard]] virtual SpringRelaxationReport relax(const StrainControl<Dim>& control) = 0;
  /// Returns the volume times the change of stress per unit of each strain, in the order of StrainSet::full, if no
  /// spring opens or closes. @pre relax() was called
  virtual Eigen::MatrixXd tangent_stiffness() = 0;

  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> strain() const = 0;
  /// Returns the volume times the stress that the springs carry.
  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> load() const = 0;
  /// Returns the force of a spring (row): stiffness times overlap; 0 if the spring is open.
  virtual double force(int row) const = 0;
  virtual bool open(int row) const = 0;
  /// first row of the springs of each element, then the number of rows
  virtual const std::vector<int>& first_row() const = 0;
  /// Returns the displacement of a node of the lattice relative to the uniform strain; zero for nodes without
  /// elements.
  virtual Vec<Dim> displacement(int node) const = 0;
  virtual int n_unknowns() const = 0;
  virtual double energy() const = 0;

  /// Removes all springs (rows) of an element.
  virtual void remove_element(int element) = 0;
};

/// Returns the springs of a lattice network.
template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings);

}  // namespace floc
