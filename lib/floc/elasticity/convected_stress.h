#pragma once

#include <Eigen/Core>

#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Returns the component of a stress tensor that does work on one of the strains of the cell.
/// @param column  number of this strain in the order of StrainSet
template <int Dim>
double conjugate(const Mat<Dim>& tensor, int column) {
  return (tensor.transpose() * unit_strain<Dim>(column)).trace();
}

/// Returns the term that prestress adds to the moduli, because a strain E of the cell convects the static stress sigma:
/// -sym(sigma E) + sigma tr E, as a symmetrised matrix (docs/physics.md, "Prestress"). The term is added to K/V, where
/// K is the stiffness against strain after relaxation of the grains, and V the volume.
/// @param stress  static stress sigma, compression positive (force/length^(Dim-1))
/// @param n       number of strains of the cell, in the order of StrainSet
/// @return n x n matrix, in the unit of the stress
template <int Dim>
Eigen::MatrixXd convected_stress(const Mat<Dim>& stress, int n) {
  Eigen::MatrixXd added(n, n);
  for (int b = 0; b < n; ++b) {
    const Mat<Dim> e = unit_strain<Dim>(b);
    const Mat<Dim> turned = stress * e;
    const Mat<Dim> change = stress * e.trace() - 0.5 * (turned + turned.transpose());
    for (int a = 0; a < n; ++a) added(a, b) = conjugate<Dim>(change, a);
  }
  return 0.5 * (added + added.transpose());
}

}  // namespace floc
