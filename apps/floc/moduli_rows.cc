#include "moduli_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "fault.h"
#include "floc/base/error.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/modes.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/stiffness_check.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/coordination.h"
#include "floc/study/deadline.h"
#include "repeated_warnings.h"

namespace floc {
namespace {

/// What a state is, beside its moduli.
template <int Dim>
ModuliRow described(const std::string& file, const State<Dim>& state) {
  const Packing<Dim>& packing = state.packing;
  ModuliRow row;
  row.file = file;
  row.units = state.units;
  row.dimension = Dim;
  row.n_grains = packing.grains.size();
  const Coordination counted = coordination(packing, 0.0);
  row.n_contacts = counted.n_contacts;
  row.n_distant = counted.n_distant;
  row.z = counted.z;
  row.solid_fraction = solid_fraction(packing);
  row.pressure = static_stress(packing).trace() / Dim;
  row.reduced_pressure = reduced_pressure(packing, row.pressure);
  row.wall_pressure = mean_wall_pressure(packing);
  return row;
}

/// A state may have been asked for an equilibrium that its numbers cannot hold.
template <int Dim>
void warn_of_rounding(const std::string& file, const State<Dim>& state) {
  const RoundingFloor floor = rounding_floor(state.packing, state.target_stress);
  if (floor.force >= state.tolerance.force || floor.stress >= state.tolerance.stress)
    warn(
        file,
        fmt::format("rounding of its positions leaves net forces of {:.1e} F1 and a stress of {:.1e} F1/a, not "
                    "below the tolerances of {:.1e} and {:.1e}",
                    floor.force, floor.stress, state.tolerance.force, state.tolerance.stress),
        std::max(floor.force / state.tolerance.force, floor.stress / state.tolerance.stress));
}

/// Moduli are those of the stiffnesses that the state has, also where its law gives others.
template <int Dim>
void warn_of_stiffnesses(const std::string& file, const State<Dim>& state) {
  const std::string differences = stiffness_differences(state.packing);
  if (!differences.empty()) warn(file, differences, first_number(differences));
}

/// What the contact network says beside the moduli of a row; increments of its contacts where they are asked
/// for.
template <int Dim>
void add_network(const State<Dim>& state, ModuliOptions options, ModuliRow& row, Table* increments) {
  const Packing<Dim>& packing = state.packing;
  if (row.rolling_stiffness) options.rolling_stiffness = row.rolling_stiffness;
  const ContactNetwork<Dim> network = options.loaded_network(packing);
  const ContactMechanics<Dim> contacts = contact_mechanics(network, row.moduli);
  row.network = network_mechanics(packing, network, row.moduli, contacts);
  row.budget = error_budget(state, network, row.moduli, contacts.isotropic ? &*contacts.isotropic : nullptr);
  if (increments != nullptr) add_increments(row.file, packing, network, contacts, *increments);
  const ElasticResponse& response = row.moduli.response;
  const auto vanishing = strain_mechanisms<Dim>(response, affine_stiffness(network, options.strains)).vanishing;
  if (!vanishing.empty()) warn(row.file, fmt::format("moduli that vanish: {}", fmt::join(vanishing, ", ")));
  row.n_near_mechanisms = count_near_mechanisms(network, response, options.largest_factor);
  if (options.prestress || row.n_near_mechanisms.value_or(0) > 0) {
    const Moduli with = options.prestress ? row.moduli
                                          : prestressed_moduli(network, network_load(packing, options.unloaded),
                                                               options, row.moduli);
    if (with.failure.empty()) row.B_prestress = with.B, row.G_prestress = with.G;
  }
  row.moduli.response = {};  // rows are kept until all are printed
}

/// The options with one of the rolling stiffnesses asked for, or with none.
ModuliOptions with_rolling(ModuliOptions options, std::optional<double> rolling_stiffness) {
  if (rolling_stiffness) options.rolling_stiffness = rolling_stiffness;
  return options;
}

std::vector<std::optional<double>> rolling_of(const ModuliRequest& request) {
  if (request.rolling_stiffness.empty()) return {std::nullopt};
  return {request.rolling_stiffness.begin(), request.rolling_stiffness.end()};
}

/// @throws InputError where the state has no bounds to take the moduli from, NoResult where there are none for
/// another reason
void require_moduli(const std::string& file, const Moduli& moduli) {
  if (moduli.failure.empty()) return;
  if (moduli.method == ModuliMethod::bounds)
    throw InputError(file, fmt::format("--method bounds: expected another method, because {}", moduli.failure));
  throw NoResult("no moduli: " + moduli.failure);
}

/// Moduli of a packing by PETSc.
template <int Dim>
Moduli by_petsc(const Packing<Dim>& packing, const ModuliOptions& options, ParallelSolver& solver) {
  return elastic_moduli(options.loaded_network(packing), packing.grains.position,
                        network_load(packing, options.unloaded), options, solver);
}

}  // namespace

ModuliRows::ModuliRows(const ModuliRequest& request)
    : request_(request), plane_(request.options), space_(request.options), last_row_(processor_seconds()) {}

/// Where the factor is predicted to be too large.
template <int Dim>
std::vector<Moduli> ModuliRows::without_factor(const std::string& file, const Packing<Dim>& packing,
                                               double bytes, const ModuliOptions& options) {
  const std::string size = fmt::format("a factor would take {:.3g} GB, more than the {:.3g} GB it may take",
                                       bytes / 1e9, options.largest_factor / 1e9);
  std::vector<Moduli> all;
  if (!has_parallel_solver()) {
    warn(file, size + ", and this floc was built without PETSc, which needs none: trying anyway", bytes);
    ModuliOptions unlimited = options;
    unlimited.largest_factor = std::numeric_limits<double>::infinity();
    for (const auto& rolling : rolling_of(request_))
      all.push_back(elastic_moduli(packing, with_rolling(unlimited, rolling)));
    return all;
  }
  remark(file, size + ": solved without one (--solver petsc)", bytes);
  if (!solver_) solver_ = load_parallel_solver();
  for (const auto& rolling : rolling_of(request_))
    all.push_back(by_petsc(packing, with_rolling(options, rolling), *solver_));
  return all;
}

template <int Dim>
std::vector<Moduli> ModuliRows::compute(const std::string& file, const State<Dim>& state,
                                        ModuliOptions& options) {
  options.unloaded = state.target_stress.isZero(0.0);
  std::vector<Moduli> all;
  if (request_.accuracy)
    all = {moduli_within(state.packing, options, *request_.accuracy)};
  else if (!request_.rolling_stiffness.empty())
    all = elastic_moduli(state.packing, options, request_.rolling_stiffness);
  else if constexpr (Dim == 2)
    all = {plane_.next(state.packing, options.unloaded)};
  else
    all = {space_.next(state.packing, options.unloaded)};
  if (all.front().factor_bytes > 0.0)
    all = without_factor(file, state.packing, all.front().factor_bytes, options);
  for (const Moduli& moduli : all) require_moduli(file, moduli);
  return all;
}

template <int Dim>
std::vector<ModuliRow> ModuliRows::of(const std::string& file, const State<Dim>& state, Table* increments) {
  const ModuliRow description = described(file, state);
  warn_of_rounding(file, state);
  warn_of_stiffnesses(file, state);
  ModuliOptions options = request_.options;
  const double start = processor_seconds();
  const std::vector<Moduli> moduli = compute(file, state, options);
  const double seconds = processor_seconds() - start;
  std::vector<ModuliRow> rows(moduli.size(), description);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].moduli = moduli[k];
    rows[k].rolling_stiffness = rolling_of(request_)[k];
    rows[k].mean_field =
        mean_field_estimates(with_rolling(options, rows[k].rolling_stiffness).loaded_network(state.packing),
                             description.z, description.solid_fraction);
    rows[k].seconds = seconds / static_cast<double>(rows.size());
    if (options.method == ModuliMethod::factor && !request_.accuracy && moduli[k].method != ModuliMethod::petsc)
      add_network(state, options, rows[k], increments);
    for (const std::string& warning : moduli[k].warnings) warn(file, warning, first_number(warning));
  }
  const double since_last_row = processor_seconds() - last_row_;
  for (ModuliRow& row : rows) row.seconds_row = since_last_row / static_cast<double>(rows.size());
  last_row_ += since_last_row;
  return rows;
}

template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliRequest& request, ParallelSolver& solver) {
  const double began = processor_seconds();
  ModuliOptions options = request.options;
  options.unloaded = state.target_stress.isZero(0.0);
  const bool speaks = solver.rank() == 0;
  if (speaks) {
    warn_of_rounding(file, state);
    warn_of_stiffnesses(file, state);
  }
  Packing<Dim>& packing = state.packing;
  const ModuliRow description = described(file, state);
  const NetworkLoad<Dim> load = network_load(packing, options.unloaded);
  std::vector<ModuliRow> rows;
  for (const auto& rolling : rolling_of(request)) {
    const ModuliOptions chosen = with_rolling(options, rolling);
    const ContactNetwork<Dim> network = chosen.loaded_network(packing);
    if (rows.size() + 1 == rolling_of(request).size()) packing.contacts = {};
    const double start = processor_seconds();
    ModuliRow& row = rows.emplace_back(description);
    row.moduli = elastic_moduli(network, packing.grains.position, load, chosen, solver);
    require_moduli(file, row.moduli);
    row.seconds = processor_seconds() - start;
    row.rolling_stiffness = rolling;
    row.mean_field = mean_field_estimates(network, description.z, description.solid_fraction);
    if (speaks)
      for (const std::string& warning : row.moduli.warnings) warn(file, warning, first_number(warning));
  }
  for (ModuliRow& row : rows)
    row.seconds_row = (processor_seconds() - began) / static_cast<double>(rows.size());
  return rows;
}

template std::vector<ModuliRow> ModuliRows::of(const std::string&, const State<2>&, Table*);
template std::vector<ModuliRow> ModuliRows::of(const std::string&, const State<3>&, Table*);
template std::vector<ModuliRow> parallel_moduli_rows(const std::string&, State<2>, const ModuliRequest&,
                                                     ParallelSolver&);
template std::vector<ModuliRow> parallel_moduli_rows(const std::string&, State<3>, const ModuliRequest&,
                                                     ParallelSolver&);

}  // namespace floc
