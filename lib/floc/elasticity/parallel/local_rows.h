#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/elasticity/parallel/grain_shares.h"
#include "floc/petsc/parallel_solver.h"

namespace floc {

/// Rows of K of the grains of one process, and the contacts of these grains. The rows are divided by `unit`, in
/// unknowns of one unit: rotations times the grain's size (see ReducedUnknowns). Unknowns that are not solved
/// for have a one on the diagonal and zeros elsewhere, so that all blocks have one size. Where K cannot have
/// negative eigenvalues, its diagonal is shifted by far less than any stiffness that resists a strain. The
/// shift regularises mechanisms, which carry no load; refinement by balance() removes its effect.
template <int Dim>
class LocalRows {
 public:
  /// @param network  without dead ends; it and the other references must outlive this
  /// @param kept     unknowns of K to solve for, see FreeMotions
  /// @param unit     (force/length)
  LocalRows(const ContactNetwork<Dim>& network, const std::vector<bool>& kept, const GrainShares& shares,
            int process, double unit, const ResponseOptions& options);

  /// Hands these rows to the solver, with the rigid motions, which coarse grids have to represent.
  /// @param centres  of all grains (length)
  /// @return the largest entry of their diagonal
  double assemble(const std::vector<Vec<Dim>>& centres, ParallelSolver& solver) const;

  /// Unknowns of this process, and these with the unknowns of other processes' grains that they touch: u below.
  Eigen::Index n_own() const { return kDofs<Dim> * static_cast<Eigen::Index>(n_grains_); }
  Eigen::Index n_at_hand() const { return kDofs<Dim> * static_cast<Eigen::Index>(at_hand_.size()); }

  struct Balance {
    Eigen::VectorXd net;  ///< forces -(K u + the load of the boundary) on the unknowns of this process
    double energy = 0.0;  ///< (A u + B)^T k (A u + B) of the contacts that this process counts
  };
  /// Computes the balance of forces under a unit of one boundary unknown.
  Balance balance(const Eigen::VectorXd& u, int boundary) const;

  struct Energies {
    Eigen::MatrixXd stiffness;  ///< (A u_b + B_b)^T k (A u_c + B_c), see SpringSystem
    Eigen::MatrixXd rounding;   ///< bound on the error of `stiffness` from rounding of the contacts' geometry
  };
  /// Sums the energies over the contacts that this process counts; each contact is counted by one process.
  /// @param u  the response to a unit of each boundary unknown
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
  double shift_;                    // of the diagonal
  int first_ = 0;                   // block of this process
  int n_grains_ = 0;                // of this process
  std::vector<int> at_hand_;        // grains: its own in the order of their rows, then those of others
  std::vector<int> place_;          // there, of each grain; -1: none
  std::vector<int> contacts_;       // that its grains take part in
  std::vector<int> of_start_, of_;  // those of each of its grains
};

}  // namespace floc
