#pragma once

#include <cstdint>
#include <map>

#include "floc/io/listed_packing.h"

namespace floc {

/// Reverses the forces and moments of a listed contact, and its image, because its two bodies change places.
void reverse_actions(ListedContact& contact);

/// Makes a contact between a grain and a wall of a contact of which one body is a wall.
/// @param walls  the walls among the bodies of the file, by their identifiers
/// @throws InputError naming the place of the contact if both bodies are walls
void name_wall(const std::map<std::int64_t, WallSide>& walls, ListedContact& contact);

}  // namespace floc
