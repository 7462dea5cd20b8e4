#pragma once

#include <string>

namespace floc {

/// Whether the header of a column, without its unit, is a usual name of a quantity: a symbol such as sigma'v or e, or a
/// word of some language such as "Porenzahl". Blanks, hyphens, underscores and accents are ignored. In words of more
/// than two letters, the case of the letters is ignored, too. A header may consist of a word and a symbol, as in "Void
/// ratio (e)" and "Porenzahl e"; both must then be names of the quantity.
/// @param quantity  name that floc uses: P or P_star (both stand for any pressure), phi, void_ratio, porosity, ...
bool is_usual_name(const std::string& quantity, const std::string& header);

}  // namespace floc
