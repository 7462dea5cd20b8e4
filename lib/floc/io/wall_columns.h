#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Columns of a dump of LAMMPS that the option `--columns` names: those of the grains, and for walls the names of the fixes
/// whose columns have the forces of the wall on the grains.
struct DumpColumns {
  explicit DumpColumns(const std::map<std::string, std::string>& given);

  std::map<std::string, std::string> grains;
  std::vector<std::pair<WallSide, std::string>> walls;
};

/// Reads contacts with walls from the columns of a dump. The fix `wall/gran ... contacts` of LAMMPS, with the name W in the
/// input script, has eight numbers for each grain, the columns f_W[1] to f_W[8]: whether the grain touches the wall, the
/// force on the grain, the contact point and the radius. A fix that has both walls of an axis names the wall by this point.
/// @param walls  walls and the columns of their fixes, such as f_W
/// @param grains  grains of the rows of the table, in the same order
/// @throws InputError for a missing column, or a column of a flag with another number than 0 or 1
std::vector<ListedContact> wall_contacts_of(const CsvTable& table,
                                            const std::vector<std::pair<WallSide, std::string>>& walls,
                                            const std::vector<ListedGrain>& grains);

}  // namespace floc
