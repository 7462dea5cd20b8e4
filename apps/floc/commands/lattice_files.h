#pragma once

#include <string>
#include <vector>

#include "commands/lattice_arguments.h"
#include "floc/lattice/node_stress.h"
#include "floc/tables/lattice_row.h"

namespace floc {

/// A loaded sample, for what is written of it.
template <int Dim>
struct LoadedSample {
  const CementedSample<Dim>& sample;
  const LatticeNetwork<Dim>& network;
  const LatticeSolution<Dim>& solution;
  std::vector<Mat<Dim>> stress;    ///< of each node
  std::vector<double> pair_force;  ///< normal, of each pair of grains
};

/// A component of the stress of the nodes that have an element, all of them or those of a phase.
template <int Dim>
std::vector<double> stresses_of(const LoadedSample<Dim>& of, int axis, std::optional<Phase> phase);

/// Writes the tables and pictures that are asked for, each whole or not at all.
template <int Dim>
void write_lattice_files(const LatticeArguments& arguments, const LatticeRow& row, const LoadedSample<Dim>& of);

/// The breakages as a table and as a picture.
template <int Dim>
void write_fracture_files(const LatticeArguments& arguments, const LatticeRow& row,
                          const LoadedSample<Dim>& of);

/// Checks names of pictures, the section, and that the cell can be drawn, before any work. @throws InputError
template <int Dim>
void check_lattice_pictures(const LatticeArguments& arguments, const Cell<Dim>& cell);

}  // namespace floc
