#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// How the springs of a lattice are relaxed.
enum class LatticeMethod {
  automatic,  ///< factor in 2D and up to 20 000 unknowns, else iterative
  factor,     ///< conjugate gradients on a Cholesky factor, its symbolic part kept: a few steps per solution
  iterative,  ///< on the diagonal blocks: hundreds of steps, next to no memory
};

/// One round of the active set.
struct RelaxationRound {
  int round;
  int n_open;        ///< open unilateral elements
  int n_changed;     ///< that opened or closed since the last round
  int n_steps;       ///< of conjugate gradients
  double imbalance;  ///< over that of the load
  bool factorized;
};

struct RelaxationSettings {
  LatticeMethod method = LatticeMethod::automatic;
  /// Largest imbalance left, relative to that of the load, in the norm of the preconditioner.
  double tolerance = 1e-10;
  int max_rounds = 100;  ///< of the active set; some ten are usual
  /// Called once a round, with a line for the user.
  std::function<void(const RelaxationRound&)> observe = {};
};

/// Which strain components of the cell are imposed, and their values or loads.
template <int Dim>
struct StrainControl {
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> imposed;  ///< the strain is given, otherwise its load
  Eigen::Matrix<double, kSymmetric<Dim>, 1> value;  ///< strain, or volume times stress
};

/// Outcome of relaxing.
struct SpringRelaxationReport {
  bool converged = false;
  bool holds = true;       ///< false: the load moves a mechanism, nothing resists it
  double imbalance = 0.0;  ///< left, over that of the load
  int n_rounds = 0, n_steps = 0, n_factors = 0;
};

/// Springs between nodes and the strain of their cell, some of which push only, in the state of least energy
/// 1/2 sum k o^2 + 1/2 sum over the one-sided of k max(o, 0)^2 - load . strain, which is convex. It is found by
/// Newton's method on the set of one-sided springs that push (the active set), starting from the last set
/// found, at first from all closed. A search along each step for the least energy makes the energy fall in
/// every round, so that no set recurs.
template <int Dim>
class RelaxedSprings {
 public:
  virtual ~RelaxedSprings() = default;

  /// @return how it went; the state is the best found in any case.
  [[nodiscard]] virtual SpringRelaxationReport relax(const StrainControl<Dim>& control) = 0;
  /// Volume times the change of stress per unit of each strain, with nothing opening or closing; order of
  /// StrainSet::full. @pre relax() was called
  virtual Eigen::MatrixXd tangent_stiffness() = 0;

  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> strain() const = 0;
  /// Volume times the stress that the springs carry.
  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> load() const = 0;
  /// What a row of the springs carries: stiffness times overlap, none where it is open.
  virtual double force(int row) const = 0;
  virtual bool open(int row) const = 0;
  virtual const std::vector<int>& first_row() const = 0;  ///< of each element
  /// Displacement of a node of the lattice relative to the uniform strain; zero for nodes without elements.
  virtual Vec<Dim> displacement(int node) const = 0;
  virtual int n_unknowns() const = 0;
  virtual double energy() const = 0;

  /// Removes all rows of an element.
  virtual void remove_element(int element) = 0;
};

/// The springs of a lattice network.
template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings);

}  // namespace floc
