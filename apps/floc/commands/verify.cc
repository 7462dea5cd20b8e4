#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "floc/tables/verification_row.h"
#include "floc/verification/verify_state.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct VerifyArguments {
  std::vector<std::string> files;
  Printing printing;
};

/// Adds the row of a state to the table. Prints each violated criterion on stderr, with the grains or contacts that
/// violate it.
/// @param criteria  result of verify_state()
/// @return exit code for this state
int report(const std::string& file, const std::vector<Criterion>& criteria, Table& table) {
  for (const Criterion& c : criteria) {
    if (c.holds && !c.where.empty()) spdlog::info("{}: criterion {}: {}", file, c.name, c.where);
    if (c.holds) continue;
    const std::string measured =
        c.by_value ? fmt::format("value {:.3g}, limit {:.3g}: ", *c.value, c.limit) : "";
    spdlog::error("{}: criterion {} does not hold: {}{}", file, c.name, measured, c.where);
  }
  add_verification_row(file, criteria, table);
  return std::ranges::all_of(criteria, &Criterion::holds) ? kDone : kVerificationFailed;
}

int verify(const VerifyArguments& arguments) {
  Table table;
  const int code =
      for_each_state(arguments.files, [&](const std::string& file, const AnyState& any, const Remarks&) {
        return report(file, verify_state(any, file), table);
      });
  if (!table.rows.empty()) print_table(table, arguments.printing);
  return code;
}

}  // namespace

Command add_verify(CommandLine program) {
  CommandLine app = program.add_subcommand("verify",
                                           "Check whether a saved state is in equilibrium, by recomputing all "
                                           "forces from the positions and the contact law in the file");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_states_argument(app, arguments->files);
  add_printing_options(app, arguments->printing);
  app.footer(
      "Prints one row per state; floc help columns verify explains the columns. The exit code is 5 if "
      "a\ncriterion does not hold.");
  return {app, [arguments] { return verify(*arguments); }};
}

}  // namespace floc
