#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Columns of a dump of LAMMPS, as the user names them with the option `--columns`: columns of the grains, and, for
/// each wall, the fix whose columns contain the forces of this wall on the grains.
struct DumpColumns {
  explicit DumpColumns(const std::map<std::string, std::string>& given);

  std::map<std::string, std::string> grains;
  std::vector<std::pair<WallSide, std::string>> walls;
};

/// Reads contacts with walls from the columns of a dump. If a fix `wall/gran ... contacts` of LAMMPS has the name W in
/// the input script, the dump has eight columns for it, f_W[1] to f_W[8]: whether the grain touches the wall, the force
/// on the grain (3 numbers), the contact point (3 numbers) and the radius. If one fix describes both walls of an axis,
/// the position of the contact point determines which wall the grain touches.
/// @param walls  walls, and the name of the columns of the fix of each wall, such as f_W
/// @param grains  grain of each row of the table, in the order of the rows
/// @throws InputError if a column is missing, or if the first column contains a number other than 0 or 1
std::vector<ListedContact> wall_contacts_of(const CsvTable& table,
                                            const std::vector<std::pair<WallSide, std::string>>& walls,
                                            const std::vector<ListedGrain>& grains);

}  // namespace floc
