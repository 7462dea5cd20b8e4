#pragma once

#include <Eigen/LU>
#include <cmath>

#include "floc/base/vec.h"

namespace floc {

/// Periodic cell. Its lattice vectors need not be orthogonal.
template <int Dim>
struct Cell {
  /// Lattice vectors of the cell, one per row (length).
  Mat<Dim> matrix = Mat<Dim>::Identity();
  /// Time derivative of the lattice vectors in `matrix` (length/time).
  Mat<Dim> velocity = Mat<Dim>::Zero();

  /// Returns the area (2D) or volume (3D) of the cell, which is positive for a left-handed lattice, too.
  double volume() const { return std::abs(matrix.determinant()); }

  /// Returns image * matrix. This is the displacement (length) from a point to its periodic image that lies image[b]
  /// cells away along each lattice vector b.
  Vec<Dim> shift(const Vec<Dim, int>& image) const {
    return matrix.transpose() * image.template cast<double>();
  }

  /// Returns the coordinates of a point in units of the lattice vectors.
  Vec<Dim> reduced(const Vec<Dim>& x) const { return matrix.transpose().inverse() * x; }

  /// Returns the periodic image of x that lies in the cell, with coordinates in [0, 1) in units of the lattice vectors.
  Vec<Dim> wrapped(const Vec<Dim>& x) const {
    Vec<Dim, int> image;
    const Vec<Dim> s = reduced(x);
    for (int a = 0; a < Dim; ++a) image[a] = -static_cast<int>(std::floor(s[a]));
    return x + shift(image);
  }

  bool rectangular() const { return matrix.isDiagonal(0.0); }

  /// Returns the velocity gradient of the cell (1/time). A grain at the position x that moves with the cell has the
  /// velocity rate() * x.
  Mat<Dim> rate() const { return velocity.transpose() * matrix.transpose().inverse(); }
};

}  // namespace floc
