#include "floc/elasticity/modes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <utility>

#include "columns.h"
#include "command.h"
#include "equilibrium_check.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/require_periodic.h"
#include "output.h"
#include "repeated_warnings.h"

namespace floc {
namespace {

struct ModesCommand {
  std::vector<std::string> files;
  std::optional<int> count;
  std::string format;
};

/// One row: motions that are free by structure (a kind and their number), a strain that costs nothing, or a
/// mode.
struct ModeRow {
  std::string file;
  std::string kind;
  std::int64_t count = 1;
  std::optional<double> eigenvalue, with_prestress, participation, softens_B, softens_G;
  Eigen::VectorXd coupling;  // volume times stress per unit amplitude; empty: none
  Eigen::VectorXd strain;    // of a mechanism that strains the cell
  std::vector<std::int64_t> grains;
};

void print_message(const std::string& file, const std::string& message) {
  std::cerr << "floc: " << file << ": " << message << '\n';
}

void add_free_motions(const std::string& file, const FreeMotions& free, std::vector<ModeRow>& rows) {
  using Kind = std::pair<FreeMotionKind, const char*>;
  for (const auto& [kind, name] : std::array<Kind, 5>{{{FreeMotionKind::rattler, "rattler"},
                                                       {FreeMotionKind::translation, "translation"},
                                                       {FreeMotionKind::rotation, "rotation"},
                                                       {FreeMotionKind::roll, "roll"},
                                                       {FreeMotionKind::spin, "spin"}}}) {
    ModeRow row;
    row.file = file;
    row.kind = name;
    row.count = free.count(kind);
    if (row.count > 0) rows.push_back(row);
  }
}

void add_strain_mechanisms(const std::string& file, const StrainMechanisms& found, std::vector<ModeRow>& rows) {
  for (Eigen::Index m = 0; m < found.strains.cols(); ++m) {
    ModeRow row;
    row.file = file;
    row.kind = "strain mechanism";
    row.eigenvalue = 0.0;
    row.strain = found.strains.col(m);
    rows.push_back(row);
  }
  if (!found.vanishing.empty())
    warn(file, fmt::format("mechanisms strain the cell at no cost; moduli that vanish: {}",
                           fmt::join(found.vanishing, ", ")));
}

template <int Dim>
void add_modes(const std::string& file, const Grains<Dim>& grains, const SoftModes<Dim>& soft,
               std::vector<ModeRow>& rows) {
  for (const Mode<Dim>& mode : soft.modes) {
    ModeRow row;
    row.file = file;
    row.kind = name_of(mode.kind);
    row.eigenvalue = mode.eigenvalue;
    row.with_prestress = mode.with_prestress;
    row.participation = mode.participation;
    row.softens_B = mode.softens_B;
    row.softens_G = mode.softens_G;
    row.coupling = mode.coupling;
    for (const int i : mode.grains) row.grains.push_back(grains.name(i));
    rows.push_back(row);
  }
}

template <int Dim>
void report_soft_modes(const std::string& file, const ContactNetwork<Dim>& network, const Moduli& moduli,
                       const SoftModes<Dim>& soft) {
  if (moduli.response.n_mechanisms > 0)
    print_message(file, fmt::format("{} mechanism(s) of the grains, {} of them due to how the contacts are "
                                    "connected, the others due to where the grains are",
                                    moduli.response.n_mechanisms,
                                    structural_mechanisms(network, StrainSet::diagonal).n_mechanisms));
  const int listed = static_cast<int>(std::count_if(soft.modes.begin(), soft.modes.end(),
                                                    [](const auto& m) { return m.kind != ModeKind::elastic; }));
  if (soft.n_below_near_bound > 0)
    print_message(file,
                  fmt::format("{} mode(s) below max |F_N|/r = {:.3g}, {} listed: prestress may matter; without "
                              "it B = {:.6g}, G = {:.6g}, with it {:.6g}, {:.6g}",
                              soft.n_below_near_bound, soft.near_bound, listed, *moduli.B_without_prestress,
                              *moduli.G_without_prestress, moduli.B, moduli.G));
  if (!soft.complete) warn(file, "copies of multiple eigenvalues are missing among the modes");
}

template <int Dim>
void add_state(const std::string& file, const State<Dim>& state, const ModesCommand& command,
               std::vector<ModeRow>& rows) {
  const Packing<Dim>& packing = state.packing;
  if (const std::string faults = equilibrium_faults(state); !faults.empty())
    warn(file, "this state is not in equilibrium: " + faults, equilibrium_excess(state));
  ModuliOptions options;
  options.prestress = true;
  const ContactNetwork<Dim> network = options.loaded_network(packing);
  const Moduli moduli = elastic_moduli(packing, options);
  ModeOptions mode_options;
  mode_options.count = command.count;
  const SoftModes<Dim> soft = soft_modes(network, mode_options);
  add_free_motions(file, soft.free, rows);
  add_strain_mechanisms(
      file, strain_mechanisms<Dim>(moduli.response, affine_stiffness(network, StrainSet::diagonal)), rows);
  add_modes(file, packing.grains, soft, rows);
  report_soft_modes(file, network, moduli, soft);
}

TableValue entry(const Eigen::VectorXd& values, int a) {
  if (a >= values.size()) return {};
  return values[a];
}

TableValue list(const std::vector<std::int64_t>& grains) {
  if (grains.empty()) return {};
  return fmt::format("{}", fmt::join(grains, " "));
}

std::vector<Column<ModeRow>> columns_for(const std::vector<ModeRow>& rows) {
  int dimension = 2;
  for (const ModeRow& r : rows)
    dimension = std::max({dimension, static_cast<int>(r.coupling.size()), static_cast<int>(r.strain.size())});
  std::vector<Column<ModeRow>> columns{
      {"file", [](const ModeRow& r) { return r.file; }},
      {"kind", [](const ModeRow& r) { return r.kind; }},
      {"count", [](const ModeRow& r) { return r.count; }},
      {"eigenvalue", [](const ModeRow& r) { return or_undefined(r.eigenvalue); }},
      {"eigenvalue_prestress", [](const ModeRow& r) { return or_undefined(r.with_prestress); }},
      {"participation", [](const ModeRow& r) { return or_undefined(r.participation); }},
      {"softens_B", [](const ModeRow& r) { return or_undefined(r.softens_B); }},
      {"softens_G", [](const ModeRow& r) { return or_undefined(r.softens_G); }}};
  for (int a = 0; a < dimension; ++a)
    columns.emplace_back(fmt::format("coupling{}", a + 1),
                         [a](const ModeRow& r) { return entry(r.coupling, a); });
  for (int a = 0; a < dimension; ++a)
    columns.emplace_back(fmt::format("strain{}", a + 1), [a](const ModeRow& r) { return entry(r.strain, a); });
  columns.emplace_back("grains", [](const ModeRow& r) { return list(r.grains); });
  return columns;
}

int run_modes(const ModesCommand& command) {
  std::vector<ModeRow> rows;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    std::visit([&](const auto& state) { require_periodic(state.packing, "modes are found", file); }, any);
    std::visit([&](const auto& state) { add_state(file, state, command, rows); }, any);
    return int{kDone};
  });
  print_table(to_table(columns_for(rows), rows), command.format);
  return code;
}

}  // namespace

Command add_modes(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "modes",
      "Find the softest modes and mechanisms of saved states: eigenvalue, participation, coupling to strain");
  const auto command = std::make_shared<ModesCommand>();
  add_states_argument(app, command->files);
  app.add_option("--count", command->count,
                 "number of modes [all below max |F_N|/r, no fewer than 10 and no more than 100]")
      .positive();
  add_format_option(app, command->format);
  return {app, [command] { return run_modes(*command); }};
}

}  // namespace floc
