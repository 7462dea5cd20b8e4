#pragma once

#include <cstdint>
#include <map>

#include "floc/io/listed_packing.h"

namespace floc {

/// Reverses the forces, the moments and the image of a listed contact. This is necessary if the two bodies of the
/// contact are exchanged.
void reverse_actions(ListedContact& contact);

/// If one body of a contact is a wall, makes the grain the first and the wall the second body of the contact.
/// @param walls  walls among the bodies of the file; the key is the identifier of the body
/// @throws InputError naming the place of the contact if both bodies are walls
void name_wall(const std::map<std::int64_t, WallSide>& walls, ListedContact& contact);

}  // namespace floc
