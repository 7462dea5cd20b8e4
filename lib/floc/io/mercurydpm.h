#pragma once

#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether a file is probably a restart file of MercuryDPM: it begins with "MercuryDPM" or "restart_version".
bool is_mercurydpm(const std::string& path);

/// Reads a packing from a restart file of MercuryDPM: particles, interactions with their forces, walls that are planes
/// perpendicular to an axis (InfiniteWall), periodic and Lees-Edwards boundaries, and gravity. A Lees-Edwards cell
/// becomes a skewed cell: its second lattice vector is displaced along x by the shift of the boundary, modulo the
/// length of the cell. A boundary at which grains are rotated when they cross it (AngledPeriodicBoundary) cannot be
/// represented by a cell. A packing with such a boundary is read as a packing with open ends and with the listed
/// contacts. The forces in the file include the forces of dashpots. `options.law` is required; the species in the file
/// are not read. `options.contacts` may name the .fstat file of the run, in which the grains are numbered in the order
/// of the restart file.
/// @throws InputError naming file and line if the file is malformed, or if it contains walls of other kinds and the
/// option `walls` is not given
Imported read_mercurydpm(const std::string& path, const ImportOptions& options);

/// Whether a file is probably an .fstat file of MercuryDPM: rows of 16 numbers, after lines that begin with #.
bool is_mercurydpm_fstat(const std::string& path);

/// Reads contacts from the file `options.contacts`, an .fstat file of MercuryDPM: the contacts at the time of the
/// grains or, if the grains have no time, at the last time in the file. Each row contains time, i, j, contact point
/// (3 numbers), overlap, tangential overlap, normal force f_n, tangential force f_t, unit normal n (3 numbers), unit
/// tangent t (3 numbers). A negative j is wall number -j - 1. The force on i is f_n n + f_t t; for a contact with a
/// wall it is -(f_n n + f_t t), because MercuryDPM writes n and t of these contacts with the opposite sign.
/// @param listed  packing with the grains. If they come from a restart file, i and j are their numbers in the order of
/// this file; if they come from another file, i and j are their identifiers
/// @throws InputError naming file and line, or if the file has no contacts at the time of the grains
std::vector<ListedContact> read_mercurydpm_contacts(const ImportOptions& options, int dimension,
                                                    const ListedPacking& listed);

}  // namespace floc
