#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "command.h"
#include "floc/run/boundary_verification.h"
#include "floc/run/verification.h"
#include "output.h"
#include "scene_check.h"

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

template <int Dim>
std::vector<Criterion> verified(const std::string& file, const State<Dim>& state) {
  std::vector<Criterion> criteria = verify_equilibrium(state);
  for (Criterion& c : check_against_scene(file, state)) criteria.push_back(std::move(c));
  criteria.push_back(verify_boundary_motion(state));
  return criteria;
}

int verify(const VerifyArguments& arguments) {
  Table table;
  const int code = for_each_state(arguments.files, [&](const std::string& file, const AnyState& any) {
    return std::visit([&](const auto& state) { return report(file, verified(file, state), table); }, any);
  });
  if (!table.rows.empty()) print_table(table, arguments.format);
  return code;
}

}  // namespace

Command add_verify(CommandLine program) {
  CommandLine app =
      program.add_subcommand("verify", "Recompute from the file alone whether a state is in equilibrium");
  const auto arguments = std::make_shared<VerifyArguments>();
  add_states_argument(app, arguments->files);
  add_format_option(app, arguments->format);
  app.footer(
      "Prints what was found for each state; floc help columns verify explains the columns. The exit code is 5 "
      "if\na criterion does not hold.");
  return {app, [arguments] { return verify(*arguments); }};
}

}  // namespace floc
