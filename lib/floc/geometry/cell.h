#pragma once

#include <Eigen/LU>
#include <cmath>

#include "floc/base/vec.h"

namespace floc {

/// Periodic cell, spanned by any lattice vectors, skewed or not.
template <int Dim>
struct Cell {
  /// Lattice vectors of the cell, one per row (length).
  Mat<Dim> matrix = Mat<Dim>::Identity();
  /// Time derivative of the lattice vectors in `matrix` (length/time).
  Mat<Dim> velocity = Mat<Dim>::Zero();

  /// Returns the area (2D) or volume (3D), which is positive also for a left-handed lattice.
  double volume() const { return std::abs(matrix.determinant()); }

  /// Returns the displacement by `image` lattice vectors to a periodic image: image * matrix (length).
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

  /// Returns the velocity gradient (1/time): the affine part of a grain's velocity is rate() * x.
  Mat<Dim> rate() const { return velocity.transpose() * matrix.transpose().inverse(); }
};

}  // namespace floc
