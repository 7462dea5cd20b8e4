#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "command.h"
#include "floc/run/verification.h"
#include "output.h"

namespace floc {
namespace {

struct VerifyArguments {
  std::vector<std::string> files;
  std::string format;
};

/// Appends one row and says on stderr which criteria do not hold, and where.
int report(const std::string& file, const std::vector<Criterion>& criteria, Table& table) {
  std::string failed;
  for (const Criterion& c : criteria) {
    if (c.holds) continue;
    if (!failed.empty()) failed += ' ';
    failed += c.name;
    spdlog::error("{}: {} does not hold: {:.3g}, limit {:.3g}: {}", file, c.name, c.value, c.limit, c.where);
  }
  if (table.columns.empty()) {
    table.columns = {"file", "equilibrium", "failed"};
    for (const Criterion& c : criteria) table.columns.emplace_back(c.name);
  }
  auto& row = table.rows.emplace_back();
  row.emplace_back(file);
  row.emplace_back(failed.empty());
  row.push_back(failed.empty() ? TableValue{} : TableValue{failed});
  for (const Criterion& c : criteria) row.emplace_back(c.value);
  return failed.empty() ? kDone : kVerificationFailed;
}

int verify(const VerifyArguments& arguments) {
  Table table;
  const int code = for_each_state(arguments.files, [&](const std::string& file, const AnyState& any) {
    return std::visit([&](const auto& state) { return report(file, verify_equilibrium(state), table); }, any);
  });
  if (!table.rows.empty()) print_table(table, arguments.format);
  return code;
}

}  // namespace

Command add_verify(CommandLine program) {
  CommandLine app =
      program.add_subcommand("verify", "recompute from the file alone whether a state is an equilibrium");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_states_argument(app, arguments->files);
  add_format_option(app, arguments->format);
  app.footer(
      "Prints for each state what was found: geometry and law (largest disagreement of the contacts stored),\n"
      "list (contacts missing or too many), force, moment, stress, energy (residuals, see the README),\n"
      "mean_stress (the stress recorded, relative), stability (negative eigenvalues), boundary_balance\n"
      "(forces across the cell's faces against the stress). Exit 5 if one is no equilibrium.");
  return {app, [arguments] { return verify(*arguments); }};
}

}  // namespace floc
