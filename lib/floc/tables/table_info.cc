#include "floc/tables/table_info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <map>

#include "floc/base/error.h"
#include "floc/io/listed_columns.h"
#include "floc/io/table_cells.h"
#include "floc/tables/column.h"
#include "floc/tables/fit_tables.h"
#include "floc/tables/path_density.h"

namespace floc {
namespace {

/// A kind of table that floc can read.
struct TableKind {
  const char* words;
  std::vector<std::string> names;  ///< names of quantities that such a table may contain
  /// names of quantities; a table that contains all of them is recognised as a table of this kind
  std::vector<std::string> required;
};

std::vector<std::string> path_quantities() {
  std::vector<std::string> names = {"P_star", "P"};
  for (const std::string& name : density_names()) names.push_back(name);
  names.emplace_back("branch");
  return names;
}

const std::vector<TableKind>& kinds() {
  static const std::vector<TableKind> all = {{"grains", grain_names(), {"x", "y"}},
                                             {"contacts", contact_names(), {"id1", "id2"}},
                                             {"compacted samples", {"e", "p", "sc", "se"}, {"sc", "se"}},
                                             {"forces", {"normal_force"}, {"normal_force"}}};
  return all;
}

/// Returns the names of the quantities in a table; the key is the index of the column.
std::map<int, std::string> quantities_of(const NamedColumns& columns, const std::vector<std::string>& names) {
  std::map<int, std::string> quantities;
  for (const std::string& name : names)
    if (!columns.given_number(name))
      if (const auto found = columns.find(name)) quantities.emplace(found->index, name);
  return quantities;
}

bool is_path(const NamedColumns& columns) {
  const auto has = [&](const std::string& name) { return !columns.given_number(name) && columns.has(name); };
  const std::vector<std::string> densities = density_names();
  return (has("P_star") || has("P")) && std::any_of(densities.begin(), densities.end(), has);
}

/// One row of the table of `floc info` for a table file. It describes one column of the file.
struct ColumnInfo {
  std::string file;
  int number;
  std::string header, quantity, unit;
  int n_numbers = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

ColumnInfo column_info(const NamedColumns& columns, int index, const std::string& quantity) {
  const CsvTable& table = columns.table();
  ColumnInfo info{table.place(), index + 1, table.columns()[static_cast<std::size_t>(index)], quantity, ""};
  info.unit = quantity.empty() ? columns.unit_of(index) : columns.unit_column(quantity).unit;
  for (int row = 0; row < table.n_rows(); ++row) {
    if (!is_number(table.number_text(row, index), false)) continue;
    const double value = table.number(row, index);
    ++info.n_numbers;
    info.low = std::min(info.low, value);
    info.high = std::max(info.high, value);
  }
  return info;
}

const std::vector<Column<ColumnInfo>>& columns_of_info() {
  static const std::vector<Column<ColumnInfo>> columns = {
      {"file", [](const ColumnInfo& c) { return c.file; }},
      {"number", [](const ColumnInfo& c) { return count(c.number); }},
      {"header", [](const ColumnInfo& c) { return or_undefined(c.header); }},
      {"quantity", [](const ColumnInfo& c) { return or_undefined(c.quantity); }},
      {"unit", [](const ColumnInfo& c) { return or_undefined(c.unit); }},
      {"n_numbers", [](const ColumnInfo& c) { return count(c.n_numbers); }},
      {"low", [](const ColumnInfo& c) { return TableValue(c.low); }},
      {"high", [](const ColumnInfo& c) { return TableValue(c.high); }}};
  return columns;
}

std::string reading_of(const CsvTable& table, const char* kind, const std::map<int, std::string>& quantities) {
  std::vector<std::string> names;
  for (const auto& [index, name] : quantities) names.push_back(name);
  const std::string description = table.description();
  const std::string what =
      names.empty()
          ? "no header names a quantity that floc reads; give --columns NAME=COLUMN for each column to read"
          : fmt::format("{} with {}", kind, fmt::join(names, ", "));
  return fmt::format("read {}: {}{}{}", table.rows_in_words(), what, description.empty() ? "" : "; ",
                     description);
}

}  // namespace

std::vector<std::string> names_of_quantities() {
  std::vector<std::string> names = path_quantities();
  for (const TableKind& kind : kinds()) names.insert(names.end(), kind.names.begin(), kind.names.end());
  return names;
}

TableInfo add_table_info(const std::string& file, const ColumnNames& names, double phi_limit, Table& table) {
  const CsvTable read = CsvTable::read(file, wanted_names(names_of_quantities(), names));
  const NamedColumns columns(read, names);
  TableInfo info;
  // The exception is thrown only after the columns were added to the table, because the user may have to choose a
  // column from the table.
  std::exception_ptr refusal;
  std::map<int, std::string> quantities;
  if (is_path(columns)) {
    quantities = quantities_of(columns, path_quantities());
    try {
      const PathTable path = read_path(file, names, {"P_star"}, OedometerPressure::driven, phi_limit);
      info = {path.reading, path.notes};
    } catch (const InputError&) {
      refusal = std::current_exception();
    }
  } else {
    const auto is_kind = [&](const TableKind& kind) {
      return std::all_of(kind.required.begin(), kind.required.end(),
                         [&](const std::string& name) { return columns.has(name); });
    };
    const auto kind = std::find_if(kinds().begin(), kinds().end(), is_kind);
    if (kind != kinds().end()) quantities = quantities_of(columns, kind->names);
    info.reading = reading_of(read, kind == kinds().end() ? "" : kind->words, quantities);
  }
  std::vector<ColumnInfo> rows;
  for (int index = 0; index < static_cast<int>(read.columns().size()); ++index) {
    const auto found = quantities.find(index);
    rows.push_back(column_info(columns, index, found == quantities.end() ? "" : found->second));
  }
  Table added = to_table(columns_of_info(), rows);
  table.columns = added.columns;
  for (auto& row : added.rows) table.rows.push_back(std::move(row));
  if (refusal) std::rethrow_exception(refusal);
  return info;
}

}  // namespace floc
