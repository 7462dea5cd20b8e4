#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/lattice/relaxed_springs.h"

namespace floc {

/// Load on a sample, compression positive: for each component, in the order of StrainSet::full, the imposed strain or
/// the imposed stress.
template <int Dim>
struct LatticeLoad {
  using Components = Eigen::Matrix<double, kSymmetric<Dim>, 1>;
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> imposed = Eigen::Matrix<bool, kSymmetric<Dim>, 1>::Constant(false);
  /// for each component, the imposed strain if `imposed` is true, otherwise the imposed stress
  Components value = Components::Zero();

  /// Returns a load with the given stress along one axis and zero stress in all other components.
  static LatticeLoad uniaxial(int axis, double stress) {
    LatticeLoad load;
    load.value[axis] = stress;
    return load;
  }
};

/// Returns the component of the stress and strain, in the order of StrainSet::full, in which a proportional load is
/// measured: the normal component along an axis or, if the load has no such component, the largest component of the
/// load. If a load has no stress along the axis, the stress along the axis is a rounding error.
/// @param axis  axis of the load, from 0
template <int Dim>
int measured_component(const LatticeLoad<Dim>& load, int axis);

/// State of a lattice network under load.
template <int Dim>
struct LatticeSolution {
  using Components = Eigen::Matrix<double, kSymmetric<Dim>, 1>;
  Components strain;  ///< strain of the cell, in the order of StrainSet::full, shortening positive
  Components stress;  ///< stress that the elements carry, compression positive
  std::vector<double> normal_force;  ///< normal force of each element, compression positive (force)
  /// shear force of each element on its node i (force); empty if all elements are central springs
  std::vector<Vec<Dim>> shear_force;
  /// Bending moment of each element on its node i (force * length); empty if all elements are central springs.
  std::vector<RotationVector<Dim>> moment;
  std::vector<bool> open;  ///< for each element, whether it is open; an open element carries no force
  std::vector<Vec<Dim>> displacement;  ///< displacement of each node relative to the uniform strain (length)
  double energy = 0.0;                 ///< elastic energy of the elements (force * length)
  SpringRelaxationReport report;

  int n_open() const;
  /// Returns the force of an element on its node i.
  Vec<Dim> force_on_i(const LatticeNetwork<Dim>& network, int element) const;
};

/// Solver for a lattice network under one load or several successive loads. The factor of the stiffness matrix and the
/// set of closed elements are kept for the next load.
template <int Dim>
class LatticeSolver {
 public:
  /// @param network    network that is loaded; it must outlive the solver
  /// @param boundary   boundary condition with which the network was made
  /// @param axis       axis along which plates load the network, counted from 0
  LatticeSolver(const LatticeNetwork<Dim>& network, const RelaxationSettings& settings,
                LatticeBoundary boundary = LatticeBoundary::periodic, int axis = Dim - 1);

  /// Finds the state of the network under a load. Between plates, only the component of the load along the axis of the
  /// plates is used, and all other components must be zero.
  [[nodiscard]] LatticeSolution<Dim> solve(const LatticeLoad<Dim>& load);

  /// Returns the moduli of the sample: stress per unit of each strain after relaxation of all nodes, in the order of
  /// StrainSet::full. The elements that were open in the last solution remain open.
  /// @pre solve() was called
  Eigen::MatrixXd moduli();

  /// Removes an element permanently.
  void remove(int element) { springs_->remove_element(element); }
  int n_unknowns() const { return springs_->n_unknowns(); }

 private:
  const LatticeNetwork<Dim>& network_;
  LatticeBoundary boundary_;
  int axis_;
  std::unique_ptr<RelaxedSprings<Dim>> springs_;
};

}  // namespace floc
