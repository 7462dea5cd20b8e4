#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is in VTK's XML format, with an unstructured grid.
bool is_vtu(const std::string& path);

/// Whether a file is in VTK's XML format, with polygonal data.
bool is_vtp(const std::string& path);

/// Reads grains from the points of a VTU or VTP file (VTK's XML format, unstructured grid or polygonal data). The
/// arrays of point data are radius (or r, or diameter) and, optionally, mass and id; `options.columns` renames them. If
/// the grid has cells of VTK's type vertex, only the points of these cells are grains. Arrays are ASCII text, base64
/// text or appended data, little endian, and uncompressed or compressed by zlib.
///
/// The periodic cell of the packing is `options.cell` or, without this option, the field array "cell", which contains
/// the lattice vectors as vtu_text() writes them. The field array "dimension" gives the dimension; without it,
/// settle_space() decides. The field arrays "walls" and "periodic" give the walls and the open ends, unless
/// `options.cell` is given. `options.law` is required. `options.contacts` may name a file of contacts: see
/// read_contact_file().
/// @throws InputError naming file and array
Imported read_vtu(const std::string& path, const ImportOptions& options);

/// Returns a state as the text of an ASCII VTU file (VTK's XML format, unstructured grid). Numbers are printed with all
/// digits that are needed to read them back exactly. Each grain is a point and a vertex, with radius, mass and id. Each
/// contact is a line, with normal_force, shear_force (on the grain with the lower index), gap, kn, kt, kr, distant and,
/// if the law resists twisting, ktw. A contact across a side of the periodic cell is drawn as two lines, one from each
/// grain. The length of each line is half the distance of the centres. Each line ends at an auxiliary point with radius
/// 0 and id -1. In 2D z = 0.
std::string vtu_text(const AnyState& state);

}  // namespace floc
