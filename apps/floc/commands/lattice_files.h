#pragma once

#include <string>
#include <vector>

#include "commands/lattice_arguments.h"
#include "floc/lattice/node_stress.h"
#include "floc/tables/lattice_row.h"

namespace floc {

/// A loaded sample with its solution, and stresses and forces computed from the solution for the output files.
template <int Dim>
struct LoadedSample {
  const CementedSample<Dim>& sample;
  const LatticeNetwork<Dim>& network;
  const LatticeSolution<Dim>& solution;
  std::vector<Mat<Dim>> stress;    ///< stress of each node
  std::vector<double> pair_force;  ///< normal force of each pair of grains
};

/// Returns the normal stress along an axis for each node that belongs to an element.
/// @param axis   index of the axis, from 0
/// @param phase  if given, only nodes of this phase are included
template <int Dim>
std::vector<double> stresses_of(const LoadedSample<Dim>& of, int axis, std::optional<Phase> phase);

/// Writes the tables and pictures whose files are named in the arguments. Each file is either complete or not written.
template <int Dim>
void write_lattice_files(const LatticeArguments& arguments, const LatticeRow& row, const LoadedSample<Dim>& of);

/// Writes the table of the broken elements and the picture of the cracks, if their files are named in the arguments.
template <int Dim>
void write_fracture_files(const LatticeArguments& arguments, const LatticeRow& row,
                          const LoadedSample<Dim>& of);

/// Checks the options of the pictures before the solution is computed: the extensions of the file names, the value of
/// --cut, and whether the cell can be drawn.
/// @throws InputError that names the invalid option
template <int Dim>
void check_lattice_pictures(const LatticeArguments& arguments, const Cell<Dim>& cell);

}  // namespace floc
