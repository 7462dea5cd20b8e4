#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

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

/// Appends one row and says on stderr which criteria do not hold, and where.
int report(const std::string& file, const std::vector<Criterion>& criteria, Table& table) {
  std::string failed;
  for (const Criterion& c : criteria) {
    if (c.holds && !c.where.empty()) spdlog::info("{}: {}: {}", file, c.name, c.where);
    if (c.holds) continue;
    if (!failed.empty()) failed += ' ';
    failed += c.name;
    const std::string measured = c.by_value ? fmt::format("{:.3g}, limit {:.3g}: ", *c.value, c.limit) : "";
    spdlog::error("{}: {} does not hold: {}{}", file, c.name, measured, c.where);
  }
  if (table.columns.empty()) {
    table.columns = {"file", "equilibrium", "failed"};
    for (const Criterion& c : criteria) table.columns.emplace_back(c.name);
  }
  auto& row = table.rows.emplace_back();
  row.emplace_back(file);
  row.emplace_back(failed.empty());
  row.push_back(failed.empty() ? TableValue{} : TableValue{failed});
  for (const Criterion& c : criteria) row.push_back(or_undefined(c.value));
  return failed.empty() ? kDone : kVerificationFailed;
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
  CommandLine app =
      program.add_subcommand("verify", "Recompute from the file alone whether a state is in equilibrium");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_states_argument(app, arguments->files);
  add_printing_options(app, arguments->printing);
  app.footer(
      "Prints what was found for each state; floc help columns verify explains the columns. The exit code is 5 "
      "if\na criterion does not hold.");
  return {app, [arguments] { return verify(*arguments); }};
}

}  // namespace floc
