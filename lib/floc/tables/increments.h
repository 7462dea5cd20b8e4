#pragma once

#include <string>

#include "floc/elasticity/network_mechanics.h"
#include "floc/io/table.h"

namespace floc {

/// Adds a row for each contact of a state to the table of `floc moduli --increments`. The row contains the increments
/// of the contact forces under two increments of stress, each of size 1: an isotropic and a deviatoric one. For both
/// stress increments, the row also contains the elastic energy of the force increments and the rank of the contact by
/// this energy. Two further cells tell whether the contact is a dead end and whether it is part of a backbone. If the
/// contact belongs to a rattler, its force increments are zero.
/// @throws InputError if the table already contains a state of another dimension
template <int Dim>
void add_increments(const std::string& file, const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                    const ContactMechanics<Dim>& mechanics, Table& table);

}  // namespace floc
