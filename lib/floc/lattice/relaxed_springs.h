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
  factor,     ///< conjugate gradients on a Cholesky factor, whose symbolic part is kept: a few steps a solution
  iterative,  ///< on the diagonal blocks: hundreds of steps, next to no memory
};

/// One round of the active set.
struct RelaxationRound {
  int round;
  int n_open;        ///< unilateral elements open
  int n_changed;     ///< since the round before
  int n_steps;       ///< of conjugate gradients
  double imbalance;  ///< over that of the load
  bool factorized;
};

struct RelaxationSettings {
  LatticeMethod method = LatticeMethod::automatic;
  /// Of the imbalance that is left to that of the load, in the norm of the preconditioner.
  double tolerance = 1e-10;
  int max_rounds = 100;  ///< of the active set; some ten are usual
  /// Called once a round, with a line for the user.
  std::function<void(const RelaxationRound&)> observe = {};
};

/// What a strain component of the cell does.
template <int Dim>
struct StrainControl {
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> imposed;  ///< the strain is given, otherwise its load
  Eigen::Matrix<double, kSymmetric<Dim>, 1> value;  ///< strain, or volume times stress
};

/// What relaxing found.
struct RelaxationReport {
  bool converged = false;
  bool holds = true;       ///< false: the load moves a mechanism, nothing resists it
  double imbalance = 0.0;  ///< left, over that of the load
  int n_rounds = 0, n_steps = 0, n_factors = 0;
};

/// Springs between nodes and the strain of their cell, some of which push only, in the state of least energy
/// 1/2 sum k o^2 + 1/2 sum over the one-sided of k max(o, 0)^2 - load . strain: convex. Found by Newton's
/// method on the set of one-sided springs that push (the active set), from where it last was, at first from all
/// closed; each step is searched along for the least energy, so that the energy falls in every round and no set
/// comes back.
template <int Dim>
class RelaxedSprings {
 public:
  virtual ~RelaxedSprings() = default;

  /// @return how it went; the state is the best found in any case.
  [[nodiscard]] virtual RelaxationReport relax(const StrainControl<Dim>& control) = 0;
  /// Volume times the change of stress by a unit of each strain, nothing opening or closing; order of
  /// StrainSet::full. @pre relax() was called
  virtual Eigen::MatrixXd tangent_stiffness() = 0;

  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> strain() const = 0;
  /// Volume times the stress that the springs carry.
  virtual Eigen::Matrix<double, kSymmetric<Dim>, 1> load() const = 0;
  /// Of a row of the springs, what it carries: stiffness times overlap, none where it is open.
  virtual double force(int row) const = 0;
  virtual bool open(int row) const = 0;
  virtual const std::vector<int>& first_row() const = 0;  ///< of each element
  /// Displacement of a node of the lattice beside the uniform strain; zero without elements.
  virtual Vec<Dim> displacement(int node) const = 0;
  virtual int n_unknowns() const = 0;
  virtual double energy() const = 0;

  /// Takes all rows of an element away.
  virtual void remove_element(int element) = 0;
};

/// The springs of a lattice network.
template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings);

}  // namespace floc
