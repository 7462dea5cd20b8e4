#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/elasticity/parallel/grain_shares.h"
#include "floc/petsc/parallel_solver.h"

namespace floc {

/// Rows of the stiffness matrix K that belong to the grains of one process, and the contacts of these grains. The rows
/// are divided by `unit`, and rotations are multiplied by the grain's size (see ReducedUnknowns). Unknowns that are not
/// solved for have a one on the diagonal and zeros elsewhere, so that all blocks have the same size. If K cannot have
/// negative eigenvalues, its diagonal is shifted by far less than any stiffness that resists a strain. The shift
/// regularises mechanisms, which carry no load; refinement by balance() removes its effect.
template <int Dim>
class LocalRows {
 public:
  /// @param network  network without dead ends; it and the other references must outlive this object
  /// @param kept     one entry per unknown of K: whether to solve for it, see FreeMotions
  /// @param unit     stiffness by which K is divided (force/length)
  LocalRows(const ContactNetwork<Dim>& network, const std::vector<bool>& kept, const GrainShares& shares,
            int process, double unit, const ResponseOptions& options);

  /// Passes the rows to the solver, with the rigid motions of the grains, which its coarse grids have to represent.
  /// @param centres  centres of all grains (length)
  /// @return largest diagonal entry of these rows
  double assemble(const std::vector<Vec<Dim>>& centres, ParallelSolver& solver) const;

  /// Return the number of unknowns of this process's grains, and the number that also includes the grains of other
  /// processes that they touch (the size of u below).
  Eigen::Index n_own() const { return kDofs<Dim> * static_cast<Eigen::Index>(n_grains_); }
  Eigen::Index n_at_hand() const { return kDofs<Dim> * static_cast<Eigen::Index>(at_hand_.size()); }

  struct Balance {
    Eigen::VectorXd net;  ///< net forces -(K u + load of the boundary) on the unknowns of this process
    double energy =
        0.0;  ///< energy (A u + B)^T k (A u + B) of the contacts that this process counts, see SpringSystem
  };
  /// Computes the net forces on the grains for given motions and a unit of one boundary unknown.
  /// @param u         motions of n_at_hand() unknowns
  /// @param boundary  number of the boundary unknown
  Balance balance(const Eigen::VectorXd& u, int boundary) const;

  struct Energies {
    /// energies (A u_b + B_b)^T k (A u_c + B_c) of pairs of responses b, c, see SpringSystem
    Eigen::MatrixXd stiffness;
    Eigen::MatrixXd
        rounding;  ///< bound on the error of `stiffness` from the rounding of the contacts' geometry
  };
  /// Sums the energies over the contacts that this process counts; each contact is counted by exactly one process.
  /// @param u  responses of the grains to a unit of each boundary unknown
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
  double shift_;      // value added to the diagonal
  int first_ = 0;     // first block of this process
  int n_grains_ = 0;  // number of grains of this process
  // grains: first those of this process in the order of their rows, then their neighbours in other processes
  std::vector<int> at_hand_;
  std::vector<int> place_;     // index of each grain in `at_hand_`; -1 if it is not there
  std::vector<int> contacts_;  // contacts of the grains of this process
  std::vector<int> of_start_,
      of_;  // start of the list of contacts of each of these grains in `of_`, and these lists
};

}  // namespace floc
