#include "help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <memory>

#include "column_reference.h"
#include "output.h"

namespace floc {
namespace {

struct HelpArguments {
  std::vector<std::string> table;  ///< words of its name
  std::string format;
};

}  // namespace

Command add_help(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "help", "Explain a command (floc help moduli) or the columns of tables (floc help columns)");
  CommandLine columns =
      app.add_subcommand("columns", "name, unit and meaning of the columns of all tables, or of TABLE");
  app.require_one_subcommand();
  auto arguments = std::make_shared<HelpArguments>();
  columns.add_option("TABLE", arguments->table, "moduli, fit consolidation, path.csv, ... [all]");
  columns.add_option("--format", arguments->format, "table, csv or json [table on a terminal, csv otherwise]")
      .one_of({"table", "csv", "json"});
  return {app, [arguments] {
            print_column_reference(fmt::format("{}", fmt::join(arguments->table, " ")), arguments->format);
            return int{kDone};
          }};
}

std::vector<char*> arguments_of_help(int argc, char** argv) {
  static char help[] = "--help";
  std::vector<char*> arguments(argv, argv + argc);
  const bool asks = argc > 1 && std::strcmp(argv[1], "help") == 0;
  if (!asks || (argc > 2 && (std::strcmp(argv[2], "columns") == 0 || argv[2][0] == '-'))) return arguments;
  arguments.erase(arguments.begin() + 1);
  arguments.push_back(help);
  return arguments;
}

}  // namespace floc
