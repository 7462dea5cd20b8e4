#pragma once

#include <cmath>

#include "support/network_packings.h"

namespace floc::test {

/// Returns equal disks at the given positions of a cell. Neighbours at the distance `spacing` touch with an
/// overlap of 2 %.
inline Packing<2> disks(const Mat<2>& cell, const std::vector<Vec<2>>& places, double spacing, const Law& law) {
  Packing<2> packing;
  packing.law = law;
  packing.cell.matrix = cell;
  packing.grains = Grains<2>::with_size(static_cast<int>(places.size()));
  packing.grains.position = places;
  packing.grains.radius.assign(places.size(), 0.51 * spacing);
  packing.grains.mass.assign(places.size(), 1.0);
  find_contacts(packing);
  return packing;
}

/// Returns a square lattice of frames: nodes that are joined by straight chains of n disks. The nodes at both ends
/// count among the n disks, so n = 2 gives the plain square lattice.
inline Packing<2> square_frames(int n, double spacing, const Law& law) {
  std::vector<Vec<2>> places{Vec<2>::Zero()};
  for (int k = 1; k < n - 1; ++k) {
    places.emplace_back(k * spacing, 0.0);
    places.emplace_back(0.0, k * spacing);
  }
  return disks((n - 1) * spacing * Mat<2>::Identity(), places, spacing, law);
}

/// Returns the lattice of square_frames() with additional disks of the same size at the positions `more`.
inline Packing<2> square_frames_around(const std::vector<Vec<2>>& more, int n, double spacing, const Law& law) {
  const Packing<2> frames = square_frames(n, spacing, law);
  std::vector<Vec<2>> places = frames.grains.position;
  places.insert(places.end(), more.begin(), more.end());
  return disks(frames.cell.matrix, places, spacing, law);
}

/// Triangular lattice with one disk per cell.
inline Packing<2> triangular(double spacing, const Law& law) {
  Mat<2> cell;
  cell << spacing, 0.0, 0.5 * spacing, std::sqrt(0.75) * spacing;
  return disks(cell, {Vec<2>::Zero()}, spacing, law);
}

/// Triangular lattice of n columns and n rows in a rectangular cell.
/// @pre n is even
inline Packing<2> triangular_crystal(int n, double spacing, const Law& law) {
  const double row = std::sqrt(0.75) * spacing;
  std::vector<Vec<2>> places;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) places.emplace_back((i + 0.5 * (j % 2)) * spacing, j * row);
  return disks(Vec<2>(n * spacing, n * row).asDiagonal().toDenseMatrix(), places, spacing, law);
}

/// Honeycomb lattice with two disks per cell.
inline Packing<2> honeycomb(double spacing, const Law& law) {
  Mat<2> cell;
  cell << std::sqrt(3.0) * spacing, 0.0, std::sqrt(0.75) * spacing, 1.5 * spacing;
  return disks(cell, {Vec<2>::Zero(), Vec<2>(0.0, spacing)}, spacing, law);
}

/// Straight chain of n disks along x. The last disk touches the periodic image of the first disk. `height` is the other
/// side of the cell.
inline Packing<2> chain_across(int n, double spacing, double height, const Law& law) {
  std::vector<Vec<2>> places;
  for (int k = 0; k < n; ++k) places.emplace_back(k * spacing, 0.0);
  Mat<2> cell;
  cell << n * spacing, 0.0, 0.0, height;
  return disks(cell, places, spacing, law);
}

}  // namespace floc::test
