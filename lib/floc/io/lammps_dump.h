#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether a file begins with "ITEM: ".
bool is_lammps_dump(const std::string& path);

/// Reads grains from a file of LAMMPS' `dump custom`. The columns are x y [z] (or xu yu zu; or scaled, xs or xsu),
/// radius or diameter and, if present, id and mass; `options.columns` renames them. The box may be triclinic; it has
/// to be periodic (pp) unless `options.cell` replaces it. Of several frames, `options.index` (from 0) is read, by
/// default the last. In 2D, which settle_space() decides, x, y and their part of the box are taken.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). Of a `dump local`, the frame with the
/// same time step is read. Its columns are named after computes, and `options.contact_columns` translates the names:
///
///   compute pair all property/local patom1 patom2 cutoff radius
///   compute force all pair/local fx fy fz p1 p2 p3 cutoff radius
///   dump contacts all local 1 FILE c_pair[1] c_pair[2] c_force[1] ... c_force[6]
///
/// translates to id1=c_pair[1], id2=c_pair[2], force1=c_force[1], .. force3, shear_force1=c_force[4], ..
/// shear_force3: the normal and the tangential force of pair/local for granular pair styles, both on the first atom.
/// `options.law` is required.
/// @throws InputError naming file and line
Imported read_lammps_dump(const std::string& path, const ImportOptions& options);

/// Reads contacts from the `dump local` named by `options.contacts`: from its last frame with the given time step or,
/// without one, from its last frame.
/// @throws InputError naming file and line
std::vector<ListedContact> read_dump_contacts(const ImportOptions& options, int dimension,
                                              std::optional<std::int64_t> timestep);

}  // namespace floc
