#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>

#include "command.h"
#include "floc/run/verification.h"
#include "floc/scene/scene_mass.h"
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

/// The masses stored against radii and the density that the scene gives: the largest relative difference.
template <int Dim>
Criterion check_mass(const std::string& file, const State<Dim>& state) {
  constexpr double kRelative = 1e-12;
  Criterion result{"mass", 0.0, kRelative, true, ""};
  const auto per_cube = mass_per_cubed_diameter(state.scene, Dim, file + ": scene");
  if (!per_cube) return result;
  const Grains<Dim>& g = state.packing.grains;
  for (int i = 0; i < g.size(); ++i) {
    const double expected = *per_cube * std::pow(2.0 * g.radius[i], Dim);
    const double error = std::abs(g.mass[i] - expected) / expected;
    if (error <= result.value) continue;
    result.value = error;
    result.where = fmt::format(
        "mass {:.6g} of grain {}, whose radius is {:.6g}, is not the {:.6g} that follows from the scene's "
        "density",
        g.mass[i], i, g.radius[i], expected);
  }
  result.holds = result.value <= kRelative;
  return result;
}

template <int Dim>
std::vector<Criterion> verified(const std::string& file, const State<Dim>& state) {
  std::vector<Criterion> criteria = verify_equilibrium(state);
  criteria.push_back(check_mass(file, state));
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
