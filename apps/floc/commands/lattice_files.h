#pragma once

#include <string>
#include <vector>

#include "commands/lattice_arguments.h"
#include "floc/lattice/node_stress.h"
#include "floc/tables/lattice_row.h"

namespace floc {

/// A loaded sample and the solution of its lattice, with stresses and forces computed from this solution for
/// the output files.
template <int Dim>
struct LoadedSample {
  const CementedSample<Dim>& sample;
  const LatticeNetwork<Dim>& network;
  const LatticeSolution<Dim>& solution;
  std::vector<Mat<Dim>> stress;    ///< stress of each node
  std::vector<double> pair_force;  ///< normal force of each pair of grains that exert forces on each other
};

/// Returns, for each node that belongs to an element, the normal stress along an axis.
/// @param axis   index of the axis, from 0
/// @param phase  phase of the nodes to include (grain or matrix); if absent, nodes of all phases
template <int Dim>
std::vector<double> stresses_of(const LoadedSample<Dim>& of, int axis, std::optional<Phase> phase);

/// Writes the tables of --stress and --pdf, the plot of --plot and the pictures of --map and --phases, if the arguments
/// name files for them. If a file cannot be written completely, it is not written at all.
template <int Dim>
void write_lattice_files(const LatticeArguments& arguments, const LatticeRow& row, const LoadedSample<Dim>& of);

/// Writes the table of the broken elements (--curve) and the picture of the cracks (--cracks), if the arguments name
/// files for them.
template <int Dim>
void write_fracture_files(const LatticeArguments& arguments, const LatticeRow& row,
                          const LoadedSample<Dim>& of);

/// Checks the options of the pictures before the solution is computed: the extensions of the file names, the value of
/// --cut, and whether the cell has a shape that can be drawn.
/// @throws InputError that names the invalid option
template <int Dim>
void check_lattice_pictures(const LatticeArguments& arguments, const Cell<Dim>& cell);

}  // namespace floc
