#pragma once

#include <string>

#include "floc/elasticity/network_mechanics.h"
#include "floc/io/table.h"

namespace floc {

/// Adds a row for each contact of a state to the table of `floc moduli --increments`: what a unit of isotropic
/// and of deviatoric stress changes in it, its energy and rank, dead end and backbones. Contacts of rattlers
/// carry nothing.
/// @throws InputError if the table holds states of another dimension.
template <int Dim>
void add_increments(const std::string& file, const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                    const ContactMechanics<Dim>& mechanics, Table& table);

}  // namespace floc
