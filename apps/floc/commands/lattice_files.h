#pragma once

#include <string>
#include <vector>

#include "commands/lattice_arguments.h"
#include "floc/lattice/node_stress.h"
#include "floc/tables/lattice_row.h"

namespace floc {

/// A loaded sample, as the files need it.
template <int Dim>
struct LoadedSample {
  const CementedSample<Dim>& sample;
  const LatticeNetwork<Dim>& network;
  const LatticeSolution<Dim>& solution;
  std::vector<Mat<Dim>> stress;    ///< stress of each node
  std::vector<double> pair_force;  ///< normal force of each pair of grains
};

/// Returns the normal stress along an axis of all nodes that have an element, or of those in a phase.
template <int Dim>
std::vector<double> stresses_of(const LoadedSample<Dim>& of, int axis, std::optional<Phase> phase);

/// Writes the tables and pictures that the arguments name; each file is complete or absent.
template <int Dim>
void write_lattice_files(const LatticeArguments& arguments, const LatticeRow& row, const LoadedSample<Dim>& of);

/// Writes the breakages as a table and as a picture, if the arguments name these files.
template <int Dim>
void write_fracture_files(const LatticeArguments& arguments, const LatticeRow& row,
                          const LoadedSample<Dim>& of);

/// Checks, before any work, the names of pictures, the section, and that the cell can be drawn.
/// @throws InputError naming the option at fault
template <int Dim>
void check_lattice_pictures(const LatticeArguments& arguments, const Cell<Dim>& cell);

}  // namespace floc
