#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "floc/network/tangent_matrix.h"

namespace floc {

/// Strains of the cell that are unknowns of a Newton iteration, because the stress along them is imposed. The unknowns are
/// these strains times a length. They follow the unknowns of the grains.
template <int Dim>
struct FreeStrains {
  /// Axes (a, b) of each strain. The strain displaces grains along axis a in proportion to their coordinate along axis b.
  std::vector<std::array<int, 2>> axes;
  std::vector<double> stress;  ///< imposed stress for each strain, compression positive (force/length^(Dim-1))
  double length = 1.0;         ///< ratio of each unknown to its strain (length)

  int size() const { return static_cast<int>(axes.size()); }

  /// Returns the strain of the cell in a change of all unknowns.
  Mat<Dim> strain_of(const Eigen::VectorXd& step) const;

  /// Returns the effect of the strains on a contact.
  BoundaryColumns<Dim> columns(const NetworkContact<Dim>& contact) const;

  /// Returns the derivatives of the load of the imposed stress, which is proportional to the volume, with respect to the
  /// unknowns.
  Eigen::MatrixXd load_derivatives(double volume) const;
};

}  // namespace floc
