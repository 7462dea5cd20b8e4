#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// Method by which the springs of a lattice are relaxed.
enum class LatticeMethod {
  automatic,  ///< factor in 2D and up to 20 000 unknowns, else iterative
  factor,     ///< conjugate gradients on a Cholesky factor, its symbolic part kept: a few steps per solution
  iterative,  ///< conjugate gradients on the diagonal blocks: hundreds of steps, little memory
};

/// One round of the active set.
struct RelaxationRound {
  int round;
  int n_open;        ///< open unilateral elements
  int n_changed;     ///< elements that opened or closed since the last round
  int n_steps;       ///< steps of conjugate gradients
  double imbalance;  ///< imbalance over that of the load
  bool factorized;
};

struct RelaxationSettings {
  LatticeMethod method = LatticeMethod::automatic;
  /// Largest imbalance accepted, relative to that of the load, in the norm of the preconditioner.
  double tolerance = 1e-10;
  int max_rounds = 100;  ///< largest number of rounds of the active set; some ten are usual
  /// Called once per round, if set.
  std::function<void(const RelaxationRound&)> observe = {};
};

/// Control of the cell: the strain components that are imposed, and the strains or loads.
template <int Dim>
struct StrainControl {
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> imposed;  ///< the strain is given, otherwise its load
  Eigen::Matrix<double, kSymmetric<Dim>, 1> value;  ///< strain, or volume times stress
};

/// Report of one relaxation.
struct SpringRelaxationReport {
  bool converged = false;
  bool holds = true;       ///< false if the load moves a mechanism, which nothing resists
  double imbalance = 0.0;  ///< imbalance left, over that of the load
  int n_rounds = 0, n_steps = 0, n_factors = 0;
};

/// Springs between nodes and the strain of their cell, in the state of least energy. Some springs are
/// one-sided: they carry compression only. The energy 1/2 sum k o^2 + 1/2 sum over the one-sided of k max(o,
/// 0)^2 - load . strain is convex. The state is found by Newton's method on the set of one-sided springs in
/// compression (the active set), starting from the last set found, at first with all springs closed. A line
/// search for the least energy along each step makes the energy fall in every round, so that no set recurs.
template <int Dim>
class RelaxedSprings {
 public:
  virtual ~RelaxedSprings() = default;

  /// Relaxes the springs under given strains and loads.
  /// @return a report of the relaxation; the state is the best one found in any case
  [[nodiscard]] virtual SpringRelaxationReport relax(const StrainControl<Dim>& control) = 0;
  /// Returns the volume times the change of stress per unit of each strain, with no spring opening or closing,
  /// in the order of StrainSet::full. @pre relax() was called
  virtual Eigen::MatrixXd tangent_stiffness() = 0;

  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> strain() const = 0;
  /// Returns the volume times the stress that the springs carry.
  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> load() const = 0;
  /// Returns the force carried by a row of the springs: stiffness times overlap, 0 where the row is open.
  virtual double force(int row) const = 0;
  virtual bool open(int row) const = 0;
  virtual const std::vector<int>& first_row() const = 0;  ///< first row of each element
  /// Returns the displacement of a node of the lattice relative to the uniform strain; zero for nodes without
  /// elements.
  virtual Vec<Dim> displacement(int node) const = 0;
  virtual int n_unknowns() const = 0;
  virtual double energy() const = 0;

  /// Removes all rows of an element.
  virtual void remove_element(int element) = 0;
};

/// Makes the springs of a lattice network.
template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings);

}  // namespace floc
