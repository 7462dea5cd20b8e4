#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Reads the contacts in the file Vloc_Rloc.INI of LMGC90. LMGC90 lists all neighbouring pairs; pairs with a gap and
/// without force are left out. If there is no such file, the result is empty.
/// @param walls  walls among the bodies; the key is the number of the body
/// @throws InputError naming the line of a contact without bodies, normal or force, or of a contact that is cut by the
/// end of the file
std::vector<ListedContact> read_lmgc90_contacts(const std::string& path,
                                                const std::map<std::int64_t, WallSide>& walls);

}  // namespace floc
