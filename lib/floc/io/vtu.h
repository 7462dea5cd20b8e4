#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is XML of VTK with the type UnstructuredGrid.
bool is_vtu(const std::string& path);

/// Reads grains from the points of a VTU file (VTK's XML format, unstructured grid). The point arrays are radius (or
/// r, or diameter) and, if present, mass and id; `options.columns` renames them. If some cells are vertices, only
/// their points are grains. Arrays are ASCII, base64 or appended raw data, little endian, not compressed. The cell is
/// the field array "cell" (lattice vectors, as vtu_text() writes them) or `options.cell`. The dimension is the field
/// array "dimension", or settle_space() decides it. A field array "walls" is an error without `options.cell`.
/// `options.law` is required; `options.contacts` may name a csv file, as in read_csv_packing().
/// @throws InputError naming file and array
Imported read_vtu(const std::string& path, const ImportOptions& options);

/// Returns a VTU file in ASCII, with every digit. Points are the grains, each a vertex, with radius, mass and id.
/// Lines are the contacts, with normal_force, shear_force (on the grain of lower index), gap, kn, kt, kr, distant
/// and, if the law resists twisting, ktw. A contact across a side of the cell is cut: from each of its grains a line
/// covers half its length, up to an auxiliary point with radius 0 and id -1. In 2D z = 0.
std::string vtu_text(const AnyState& state);

}  // namespace floc
