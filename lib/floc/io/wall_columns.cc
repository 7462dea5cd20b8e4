#include "floc/io/wall_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Returns the indices of the columns f_W[1] to f_W[7] of a fix with the name W.
std::array<int, 7> columns_of_fix(const CsvTable& table, const WallSide& wall, const std::string& fix) {
  std::array<int, 7> columns{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string name = fmt::format("{}[{}]", fix, k + 1);
    if (!table.has(name))
      throw InputError(
          table.place(),
          fmt::format("the dump has no column {}, which --columns {}={} needs: expected the columns "
                      "{}[1] to {}[7] of a fix wall/gran with the keyword contacts",
                      name, wall.name(), fix, fix, fix));
    columns[k] = table.column(name);
  }
  return columns;
}

}  // namespace

DumpColumns::DumpColumns(const std::map<std::string, std::string>& given) {
  for (const auto& [name, column] : given)
    if (const auto side = wall_side(name))
      walls.emplace_back(*side, column);
    else
      grains.emplace(name, column);
}

std::vector<ListedContact> wall_contacts_of(const CsvTable& table,
                                            const std::vector<std::pair<WallSide, std::string>>& walls,
                                            const std::vector<ListedGrain>& grains) {
  std::vector<ListedContact> contacts;
  for (const auto& [wall, fix] : walls) {
    const std::array<int, 7> columns = columns_of_fix(table, wall, fix);
    for (int row = 0; row < table.n_rows(); ++row) {
      const double touches = table.number(row, columns[0]);
      if (touches != 0.0 && touches != 1.0)
        throw InputError(table.place(row), fmt::format("{}[1] = {}, expected 0 or 1", fix, touches));
      const ListedGrain& grain = grains[static_cast<std::size_t>(row)];
      const double point = table.number(row, columns[static_cast<std::size_t>(4 + wall.axis)]);
      if (touches == 0.0 || (point < grain.position[wall.axis]) != (wall.side < 0)) continue;
      ListedContact& c = contacts.emplace_back();
      c.place = grain.place;
      c.id1 = grain.id;
      c.wall = wall;
      c.force = Eigen::Vector3d(table.number(row, columns[1]), table.number(row, columns[2]),
                                table.number(row, columns[3]));
    }
  }
  return contacts;
}

}  // namespace floc
