#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/io/law_text.h"
#include "floc/packing/balance.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/coordination.h"
#include "process/command.h"
#include "process/finish_output.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct InfoArguments {
  std::vector<std::string> files;
  Printing printing;
  bool scene = false;
};

struct Entry {
  const char* name;
  TableValue value;
};

template <int Dim>
std::string cell_text(const Cell<Dim>& cell) {
  std::vector<std::string> vectors;
  for (int a = 0; a < Dim; ++a)
    vectors.push_back(fmt::format("{}", fmt::join(cell.matrix.row(a).begin(), cell.matrix.row(a).end(), ",")));
  return fmt::format("{}", fmt::join(vectors, ";"));
}

template <int Dim>
void add_packing(const State<Dim>& state, std::vector<Entry>& entries) {
  const Packing<Dim>& packing = state.packing;
  const Coordination counted = coordination(packing, 0.0);
  const double pressure = static_stress(packing).diagonal().mean();
  const int n = packing.grains.size();
  entries.push_back({"dimension", std::int64_t{Dim}});
  entries.push_back({"units", state.units});
  entries.push_back({"n_grains", std::int64_t{n}});
  entries.push_back({"n_contacts", std::int64_t{counted.n_contacts}});
  entries.push_back({"n_distant", std::int64_t{counted.n_distant}});
  entries.push_back({"phi", solid_fraction(packing)});
  entries.push_back({"z", counted.z});
  entries.push_back({"P", pressure});
  entries.push_back({"P_star", reduced_pressure(packing, pressure)});
  entries.push_back(
      {"target", fmt::format("{}", fmt::join(state.target_stress.begin(), state.target_stress.end(), ","))});
  entries.push_back({"cell", cell_text(packing.cell)});
  entries.push_back({"law", law_text(packing.law)});
}

template <int Dim>
void add_history(const State<Dim>& state, std::vector<Entry>& entries) {
  entries.push_back({"residual_force", state.residuals.force});
  entries.push_back({"residual_moment", state.residuals.moment});
  entries.push_back({"residual_stress", state.residuals.stress});
  entries.push_back({"kinetic_energy", state.residuals.energy});
  entries.push_back(
      {"n_negative", state.n_negative < 0 ? TableValue{} : TableValue{std::int64_t{state.n_negative}}});
  entries.push_back({"step", std::int64_t{state.path.step}});
  entries.push_back({"branch", or_undefined(state.path.branch)});
  entries.push_back({"time", state.path.time});
  entries.push_back({"n_steps", state.path.n_steps});
  entries.push_back({"ending", or_undefined(state.path.ending)});
  entries.push_back({"program", or_undefined(state.provenance.program)});
  entries.push_back({"commit", or_undefined(state.provenance.commit)});
  entries.push_back({"compiler", or_undefined(state.provenance.compiler)});
  // As text: a table's integers are signed, and json readers round numbers this large.
  entries.push_back({"seed", fmt::format("{}", state.provenance.seed)});
  entries.push_back({"source", or_undefined(state.provenance.source)});
  entries.push_back({"parent_sha256", or_undefined(state.provenance.parent_sha256)});
  entries.push_back({"scene_sha256", state.scene.empty() ? TableValue{} : TableValue{sha256(state.scene)}});
}

std::vector<Entry> describe(const std::string& file, const AnyState& any) {
  std::vector<Entry> entries = {{"file", file}};
  std::visit(
      [&](const auto& state) {
        add_packing(state, entries);
        add_history(state, entries);
      },
      any);
  entries.push_back({"sha256", sha256_of_file(file)});
  entries.push_back(
      {"p_wall",
       std::visit([](const auto& state) { return or_undefined(mean_wall_pressure(state.packing)); }, any)});
  return entries;
}

/// For reading: one line an entry. For scripts: one row a state.
void print(const std::vector<std::vector<Entry>>& states, const Printing& printing) {
  Table table;
  for (const Entry& entry : states.front()) table.columns.emplace_back(entry.name);
  for (const auto& entries : states) {
    auto& row = table.rows.emplace_back();
    for (const Entry& entry : entries) row.push_back(entry.value);
  }
  if (chosen_format(printing.format) != TableFormat::table) return print_table(table, printing);
  const Table shown = with_chosen_columns(table, printing, false);
  for (const auto& row : shown.rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto* number = std::get_if<double>(&row[k]);
      const auto* integer = std::get_if<std::int64_t>(&row[k]);
      const auto* text = std::get_if<std::string>(&row[k]);
      std::cout << fmt::format("{:<16}{}\n", shown.columns[k],
                               number    ? fmt::format("{:.6g}", *number)
                               : integer ? fmt::format("{}", *integer)
                               : text    ? *text
                                         : "-");
    }
  finish_output();
}

int info(const InfoArguments& arguments) {
  std::vector<std::vector<Entry>> states;
  const int code =
      for_each_state(arguments.files, [&](const std::string& file, const AnyState& state, const Remarks&) {
        if (arguments.scene)
          std::visit([](const auto& s) { std::cout << s.scene; }, state);
        else
          states.push_back(describe(file, state));
        return int{kDone};
      });
  if (!states.empty()) print(states, arguments.printing);
  finish_output();
  return code;
}

}  // namespace

Command add_info(CommandLine program) {
  CommandLine app = program.add_subcommand("info", "Print what a state file holds, its history and provenance");
  const auto arguments = std::make_shared<InfoArguments>();
  add_states_argument(app, arguments->files);
  add_printing_options(app, arguments->printing);
  app.add_flag("--scene", arguments->scene, "print the scene the state was made from, and nothing else");
  return {app, [arguments] { return info(*arguments); }};
}

}  // namespace floc
