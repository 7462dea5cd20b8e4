#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/elasticity/parallel/grain_shares.h"
#include "floc/petsc/parallel_solver.h"

namespace floc {

/// Rows of the stiffness matrix K that belong to the grains of one process, and the contacts of these grains. K is
/// divided by the stiffness `unit`, and rotations are multiplied by the grain's size (see ReducedUnknowns). An unknown
/// that is not solved for has a row with a one on the diagonal and zeros elsewhere, so that all blocks have the same
/// size.
///
/// Mechanisms have no influence on the response, but would make K singular. Therefore a shift is added to the diagonal
/// of K if K cannot have negative eigenvalues. The shift is far below any stiffness that resists a strain, and
/// refinement by balance() removes the effect of the shift.
template <int Dim>
class LocalRows {
 public:
  /// @param network  network without dead ends; `network`, `kept` and `shares` must outlive this object
  /// @param kept     for each unknown of K, whether it is solved for, see FreeMotions
  /// @param unit     stiffness by which K is divided (force/length)
  LocalRows(const ContactNetwork<Dim>& network, const std::vector<bool>& kept, const GrainShares& shares,
            int process, double unit, const ResponseOptions& options);

  /// Passes the rows of K to the solver, together with the rigid motions of the grains. The coarse grids of the solver
  /// have to represent these motions.
  /// @param centres  centres of all grains (length)
  /// @return largest diagonal entry of these rows
  double assemble(const std::vector<Vec<Dim>>& centres, ParallelSolver& solver) const;

  /// n_own() is the number of unknowns of the grains of this process. n_at_hand() also counts the unknowns of their
  /// neighbours, which are those grains of other processes that touch a grain of this process. n_at_hand() is the size
  /// of u in balance() and energies().
  Eigen::Index n_own() const { return kDofs<Dim> * static_cast<Eigen::Index>(n_grains_); }
  Eigen::Index n_at_hand() const { return kDofs<Dim> * static_cast<Eigen::Index>(at_hand_.size()); }

  struct Balance {
    /// net force -(K u + f) on each unknown of this process, with the force f due to the boundary unknown
    Eigen::VectorXd net;
    /// twice the elastic energy of the contacts that this process counts
    double energy = 0.0;
  };
  /// Computes the net forces on the grains for given motions of the grains and a displacement by 1 of one boundary
  /// unknown (a strain of the cell or a wall displacement).
  /// @param u         motions of the grains, n_at_hand() unknowns
  /// @param boundary  number of the boundary unknown
  Balance balance(const Eigen::VectorXd& u, int boundary) const;

  struct Energies {
    /// for each pair b, c of boundary unknowns, the sum over springs of stiffness * stretch_b * stretch_c
    Eigen::MatrixXd stiffness;
    /// bound on the error of `stiffness` that results from rounding in the geometry of the contacts
    Eigen::MatrixXd rounding;
  };
  /// Sums Energies over the contacts that this process counts; each contact is counted by exactly one process.
  /// @param u  for each boundary unknown, the response of the grains if this unknown is displaced by 1
  Energies energies(const std::vector<Eigen::VectorXd>& u) const;

 private:
  using Block = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;
  using Unknowns = Eigen::Matrix<double, kDofs<Dim>, 1>;

  void gather(int process);
  std::vector<int> columns_of(int place) const;
  Eigen::Map<const Eigen::VectorXi> contacts_of(int place) const;
  Unknowns scale_of(int grain) const;
  Unknowns motion_of(int grain, const Eigen::VectorXd& u) const;
  template <class Visit>
  void for_each_spring(const NetworkContact<Dim>& contact, const Visit& visit) const;
  double set_row(int place, ParallelSolver& solver) const;
  std::vector<double> rigid_motions(const std::vector<Vec<Dim>>& centres) const;

  const ContactNetwork<Dim>& network_;
  const std::vector<bool>& kept_;
  const GrainShares& shares_;
  double unit_;
  StrainSet strains_;
  bool prestress_;
  double shift_;      // value added to the diagonal of K
  int first_ = 0;     // first block of this process
  int n_grains_ = 0;  // number of grains of this process
  // first the grains of this process in the order of their rows, then those grains of other processes that touch a
  // grain of this process
  std::vector<int> at_hand_;
  std::vector<int> place_;     // index of each grain in `at_hand_`; -1 for grains that are not listed there
  std::vector<int> contacts_;  // contacts of the grains of this process
  std::vector<int> of_start_,
      // contacts of the grains of this process, listed grain by grain; `of_start_` contains, for each grain, the index
      // in `of_` at which its list begins
      of_;
};

}  // namespace floc
