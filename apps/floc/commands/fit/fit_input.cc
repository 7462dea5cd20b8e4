#include "commands/fit/fit_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/tables/path_density.h"
#include "process/command.h"
#include "process/finish_output.h"
#include "process/output.h"

namespace floc {

void add_columns_option(CommandLine app, std::string& text, const std::string& names) {
  app.add_option("--columns", text,
                 "NAME=COLUMN,...: columns of the input table to use for " + names +
                     " [columns with these names or other usual names]; add a unit if the table has none, "
                     "as in \"e [%]\"; items without = are names or patterns of columns to print [all "
                     "columns; on a terminal those that fit its width]")
      .joined(',');
}

void add_phi_limit_option(CommandLine app, std::string& text) {
  app.add_option(
      "--phi-limit", text,
      "largest solid fraction that the rows may have, or none for no bound, as for densities measured in a "
      "die under load [1]");
}

ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names,
                               Printing& printing) {
  ColumnNames columns;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::string_view item = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t equals = item.find('=');
    const std::string name(trimmed(item.substr(0, equals)));
    if (equals == std::string_view::npos && !name.empty()) {
      printing.choose(name);
      continue;
    }
    if (name.empty() || trimmed(item.substr(equals + 1)).empty() ||
        std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("--columns",
                       fmt::format("\"{}\" is not valid: expected NAME=COLUMN, where NAME is one of {}", item,
                                   fmt::join(names, ", ")));
    if (!columns.emplace(name, trimmed(item.substr(equals + 1))).second)
      throw InputError("--columns",
                       fmt::format("the name {} is given twice: expected one column for each name", name));
  }
  return columns;
}

std::vector<std::string> names_with_densities(std::vector<std::string> names) {
  for (const std::string& name : density_names()) names.push_back(name);
  return names;
}

void log_notes(const PathTable& path) {
  if (!path.is_of_run) spdlog::info("{}: {}", path.name, path.reading);
  for (const std::string& note : path.notes) spdlog::info("{}: {}", path.name, note);
}

void log_description(const CsvTable& table) {
  if (const std::string words = table.description(); !words.empty())
    spdlog::info("{}: read {}: {}", table.place(), table.rows_in_words(), words);
}

int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work,
                   const std::function<std::vector<std::string>(const std::string& input)>& tables) {
  int code = kDone;
  for (const std::string& input : inputs) {
    try {
      for (const std::string& table : tables(input)) code = worse(code, work(table));
    } catch (const InputError& error) {
      std::cerr << "floc: " << error.what() << '\n';
      code = worse(code, kBadInput);
    }
  }
  return code;
}

void print_fit(const Json& json, Table table, std::size_t n_short, const Printing& printing) {
  if (printing.format == "json") {
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    finish_output();
    return;
  }
  if (chosen_format(printing.format) == TableFormat::table && printing.columns.empty()) {
    table.columns.resize(std::min(n_short, table.columns.size()));
    for (auto& row : table.rows) row.resize(table.columns.size());
  }
  print_table(table, printing);
}

}  // namespace floc
