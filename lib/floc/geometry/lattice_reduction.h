#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "floc/geometry/separation.h"

namespace floc {

/// Lattice of a periodic cell after a reduction: shorter vectors span the same lattice as the vectors of the original
/// cell. Row a of `cell.matrix` is the sum over b of combination(a, b) times lattice vector b of the original cell.
template <int Dim>
struct ReducedLattice {
  Cell<Dim> cell;
  Mat<Dim, std::int64_t> combination = Mat<Dim, std::int64_t>::Identity();
  bool is_original = true;

  /// Converts a lattice displacement to numbers of lattice vectors of the original cell.
  /// @param image  the displacement in numbers of lattice vectors of the reduced cell
  Vec<Dim, std::int64_t> original(const Vec<Dim, int>& image) const {
    return combination.transpose() * image.template cast<std::int64_t>();
  }
};

/// Reduces a lattice by the method of Lagrange and Gauss, pair by pair in 3D: whole multiples of the other vectors are
/// subtracted from each vector, as long as this makes a vector shorter. The cost of a neighbour search grows if the
/// distance between opposite faces of the cell is small. The reduction keeps the cost low even if the original cell is
/// strongly slanted. Lattices whose vectors are already short do not change.
template <int Dim>
ReducedLattice<Dim> reduced_lattice(const Cell<Dim>& cell) {
  ReducedLattice<Dim> lattice{cell};
  std::array<DoubleDoubleVec<Dim>, Dim> row;
  for (int a = 0; a < Dim; ++a) row[a] = double_double<Dim>(cell.matrix.row(a).transpose(), Vec<Dim>::Zero());
  constexpr int kMaxRounds = 1000;
  bool shorter = true;
  for (int round = 0; shorter && round < kMaxRounds; ++round) {
    shorter = false;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) {
        const Vec<Dim> along = lattice.cell.matrix.row(b).transpose();
        const Vec<Dim> from = lattice.cell.matrix.row(a).transpose();
        const double steps = std::round(from.dot(along) / along.squaredNorm());
        if (a == b || steps == 0.0 || !(std::abs(steps) < 1e15)) continue;
        DoubleDoubleVec<Dim> to = row[a];
        for (int k = 0; k < Dim; ++k) to[k] = to[k] - row[b][k] * steps;
        if (!(rounded<Dim>(to).squaredNorm() < from.squaredNorm())) continue;
        row[a] = to;
        lattice.cell.matrix.row(a) = rounded<Dim>(to).transpose();
        lattice.combination.row(a) -= static_cast<std::int64_t>(steps) * lattice.combination.row(b);
        lattice.is_original = false;
        shorter = true;
      }
  }
  return lattice;
}

}  // namespace floc
