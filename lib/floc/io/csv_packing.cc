#include "floc/io/csv_packing.h"

#include <fmt/format.h>

#include "floc/base/error.h"
#include "floc/io/listed_columns.h"

namespace floc {

Imported read_csv_packing(const std::string& path, const ImportOptions& options) {
  if (options.index.value_or(0) != 0)
    throw InputError(
        path,
        fmt::format("index = {}, but the file contains only one packing, whose index is 0: leave out --index",
                    *options.index));
  check_grain_columns("--columns", options.columns);
  ListedPacking listed = listed_packing(path, options);
  const CsvTable table = CsvTable::read(path, wanted_names(grain_names(), options.columns));
  if (!table.description().empty())
    listed.remarks.push_back(fmt::format("read {}: {}", table.rows_in_words(), table.description()));
  const NamedColumns columns(table, options.columns);
  std::vector<std::string> read = grain_names();
  read.emplace_back("r");  // another name of the radius
  add_unread_columns(columns, read, listed.remarks);
  listed.grains = read_grains(columns, options.units);
  listed.space.place = path;
  return assemble(std::move(listed), options);
}

}  // namespace floc
