#pragma once

#include <cstdint>
#include <map>

#include "floc/io/listed_packing.h"

namespace floc {

/// Reverses the forces, the moments and the image of a listed contact. This is needed if its two bodies are exchanged.
void reverse_actions(ListedContact& contact);

/// If one body of a contact is a wall, changes the contact to one between a grain and this wall.
/// @param walls  walls among the bodies of the file; the key is the identifier of the body
/// @throws InputError naming the place of the contact if both bodies are walls
void name_wall(const std::map<std::int64_t, WallSide>& walls, ListedContact& contact);

}  // namespace floc
