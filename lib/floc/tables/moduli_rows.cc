#include "floc/tables/moduli_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/base/free_memory.h"
#include "floc/base/parse_number.h"
#include "floc/base/processor_seconds.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/modes.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/law/named_stiffness.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/coordination.h"
#include "floc/tables/equilibrium_warning.h"

namespace floc {
namespace {

/// Returns a row of the table of `floc moduli` with all properties of a state except its moduli.
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
  row.driven_stress = stress_on_driven_axis<Dim>(state, static_stress(packing).diagonal());
  row.reduced_driven_stress = reduced_pressure(packing, row.driven_stress);
  row.wall_pressure = mean_wall_pressure(packing);
  return row;
}

/// Beginning of the message of require_elastic() for a state of rigid grains if --kn and --kt are not given.
const std::string kNeedsStiffness = "without named stiffnesses --kn and --kt, moduli are computed";

NamedStiffness named_stiffness(const ModuliTableOptions& options) {
  return {options.kn.value_or(0.0), options.kt.value_or(0.0), options.stiffness_per};
}

/// Checks that the contacts of a state have stiffnesses: their own, or the stiffnesses --kn and --kt.
/// @throws InputError if they have none, or if the stiffnesses cannot be given to them
template <int Dim>
void require_stiffnesses(const std::string& file, const State<Dim>& state, const ModuliTableOptions& options) {
  if (!options.kn && !options.kt) {
    require_elastic(state.packing, kNeedsStiffness, file);
    return;
  }
  if (state.motion)
    throw InputError(
        file, "this state is in motion, so its forces do not balance: moduli are computed for states at rest");
  Packing<Dim> without_grains;
  without_grains.law = state.packing.law;
  try {
    (void)with_named_stiffness(std::move(without_grains), named_stiffness(options));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

/// Returns a state of rigid grains whose contacts are springs with the stiffnesses --kn and --kt. Warns that these
/// stiffnesses are not a property of the grains.
template <int Dim>
State<Dim> with_named_stiffness(const std::string& file, State<Dim> state, const ModuliTableOptions& options,
                                const Remarks& remarks) {
  state.packing = with_named_stiffness(std::move(state.packing), named_stiffness(options));
  remarks.warn(
      file,
      "the grains are rigid: these moduli are those of springs with the stiffnesses --kn and --kt at the "
      "contacts, and are not a property of the grains");
  return state;
}

/// Sets the columns of the stiffnesses that the user gave, if any.
void set_named_stiffness(ModuliRow& row, const ModuliTableOptions& options) {
  if (!options.kn) return;
  row.kn_named = options.kn, row.kt_named = options.kt;
  row.stiffness_per = options.stiffness_per;
}

/// Warns if the rounding of the grain positions causes residual forces or stresses that reach the tolerances of
/// equilibrium.
template <int Dim>
void warn_of_rounding(const std::string& file, const State<Dim>& state, const Remarks& remarks) {
  const RoundingFloor floor = rounding_floor(state.packing, state.target_stress);
  if (floor.force >= state.tolerance.force || floor.stress >= state.tolerance.stress)
    remarks.warn(file,
                 fmt::format("rounding of the positions in this state causes net forces of {:.1e} F1 and a "
                             "stress error of {:.1e} F1/a^(d-1) (F1: larger of the "
                             "pull-off force and P a^(d-1), P: pressure, a: largest diameter, d: dimension), "
                             "which reach the tolerances of equilibrium, {:.1e} and {:.1e}",
                             floor.force, floor.stress, state.tolerance.force, state.tolerance.stress),
                 std::max(floor.force / state.tolerance.force, floor.stress / state.tolerance.stress));
}

/// Warns if the contact stiffnesses that are stored in a state differ from the stiffnesses of its contact law. The
/// moduli are computed from the stored stiffnesses.
template <int Dim>
void warn_of_stiffnesses(const std::string& file, const State<Dim>& state, const Remarks& remarks) {
  const std::string differences = stiffness_differences(state.packing);
  if (!differences.empty()) remarks.warn(file, differences, first_number(differences));
}

/// Adds the mechanics of the contact network to a row that already contains the moduli. If `increments` is not null,
/// also adds a row for each contact to this table.
template <int Dim>
void add_network(const State<Dim>& state, ModuliOptions options, ModuliRow& row, Table* increments,
                 const Remarks& remarks) {
  const Packing<Dim>& packing = state.packing;
  // The mechanics have to belong to the network from which the moduli in the row were computed. This network has the
  // rolling stiffness of the row.
  if (row.rolling_stiffness) options.rolling_stiffness = row.rolling_stiffness;
  const ContactNetwork<Dim> network = options.loaded_network(packing);
  const ContactMechanics<Dim> contacts = contact_mechanics(network, row.moduli);
  row.network = network_mechanics(packing, network, row.moduli, contacts);
  row.budget = error_budget(state, network, row.moduli, contacts.isotropic ? &*contacts.isotropic : nullptr);
  if (increments != nullptr) add_increments(row.file, packing, network, contacts, *increments);
  const ElasticResponse& response = row.moduli.response;
  const auto vanishing = strain_mechanisms<Dim>(response, affine_stiffness(network, options.strains)).vanishing;
  if (!vanishing.empty())
    remarks.warn(
        row.file,
        fmt::format(
            "mechanisms let the cell change its shape without elastic energy, so these moduli are zero: {}",
            fmt::join(vanishing, ", ")));
  row.n_near_mechanisms = count_near_mechanisms(network, response, options.largest_factor);
  const bool has_near_mechanisms = row.n_near_mechanisms.value_or(0) > 0;
  // Prestress changes the eigenvalues of the stiffness matrix by about F_N/r (F_N: normal force, r: distance between
  // centres). Near-mechanisms have eigenvalues of this size or smaller. Prestress may therefore change the moduli
  // strongly, and the moduli with prestress are computed, too.
  if (options.prestress || has_near_mechanisms) {
    ModuliOptions geometric = options;
    geometric.prestress = true;
    const Moduli with =
        options.prestress ? row.moduli
                          : prestressed_moduli(geometric.loaded_network(packing),
                                               network_load(packing, options.unloaded), geometric, row.moduli);
    if (with.failure.empty()) row.B_prestress = with.B, row.G_prestress = with.G;
  }
  // frees the memory of the response: all rows are kept until they are printed, and their responses would need much
  // memory
  row.moduli.response = {};
}

/// Returns the options. If `rolling_stiffness` is present, it replaces the rolling stiffness of the state.
ModuliOptions with_rolling(ModuliOptions options, std::optional<double> rolling_stiffness) {
  if (rolling_stiffness) options.rolling_stiffness = rolling_stiffness;
  return options;
}

std::vector<std::optional<double>> rolling_of(const ModuliTableOptions& options) {
  if (options.rolling_stiffness.empty()) return {std::nullopt};
  return {options.rolling_stiffness.begin(), options.rolling_stiffness.end()};
}

/// Checks that the moduli of a state could be computed.
/// @throws InputError if the method `bounds` cannot be applied to the state
/// @throws NoResult if the state has no moduli for another reason
void require_moduli(const std::string& file, const Moduli& moduli) {
  if (moduli.failure.empty()) return;
  if (moduli.method == ModuliMethod::bounds)
    throw InputError(file,
                     fmt::format("--method bounds cannot be applied to this state: {}; give another method",
                                 moduli.failure));
  throw NoResult("no moduli: " + moduli.failure);
}

bool by_factor(const ModuliTableOptions& options) {
  return options.moduli.method == ModuliMethod::factor && !options.accuracy;
}

/// Sets the largest memory for a Cholesky factor of the stiffness matrix: the value in the options or, if there is
/// none, 70 % of the free memory. The rest of the memory is needed for the matrix itself and for workspace.
ModuliTableOptions with_largest_factor(ModuliTableOptions options) {
  constexpr double kShare = 0.7;
  if (options.solver == ModuliSolver::automatic && by_factor(options))
    options.moduli.largest_factor = options.memory.value_or(kShare * free_memory());
  return options;
}

/// Computes the moduli of a packing with the iterative solver of PETSc.
template <int Dim>
Moduli by_petsc(const Packing<Dim>& packing, const ModuliOptions& options, ParallelSolver& solver) {
  return elastic_moduli(options.loaded_network(packing), packing.grains.position,
                        network_load(packing, options.unloaded), options, solver);
}

}  // namespace

ModuliRows::ModuliRows(const ModuliTableOptions& options)
    : options_(with_largest_factor(options)),
      plane_(options_.moduli),
      space_(options_.moduli),
      last_row_(processor_seconds()) {}

/// Computes the moduli of a packing if the Cholesky factor of the stiffness matrix is predicted to be too large for the
/// memory. PETSc is used, because it needs no factor. If floc was built without PETSc, the function tries to compute
/// the factor nevertheless.
/// @param bytes  predicted size of the factor (bytes)
template <int Dim>
std::vector<Moduli> ModuliRows::without_factor(const std::string& file, const Packing<Dim>& packing,
                                               double bytes, const ModuliOptions& options,
                                               const Remarks& remarks) {
  const std::string size = fmt::format(
      "the Cholesky factor of the stiffness matrix would take {:.3g} GB of memory, but it may take only {:.3g} "
      "GB",
      bytes / 1e9, options.largest_factor / 1e9);
  if (options_.increments)
    throw InputError(file,
                     size +
                         ", and the increments of the forces need it: give a larger --memory, or leave out "
                         "--increments");
  std::vector<Moduli> all;
  if (!has_parallel_solver()) {
    remarks.warn(file,
                 size +
                     "; this floc was built without PETSc, which needs no factor, so it tries to compute the "
                     "factor nevertheless",
                 bytes);
    ModuliOptions unlimited = options;
    unlimited.largest_factor = std::numeric_limits<double>::infinity();
    for (const auto& rolling : rolling_of(options_))
      all.push_back(elastic_moduli(packing, with_rolling(unlimited, rolling)));
    return all;
  }
  remarks.remark(file, size + "; the moduli are computed by PETSc, which needs no factor (--solver petsc)",
                 bytes);
  if (!solver_) solver_ = load_parallel_solver();
  for (const auto& rolling : rolling_of(options_))
    all.push_back(by_petsc(packing, with_rolling(options, rolling), *solver_));
  return all;
}

template <int Dim>
std::vector<Moduli> ModuliRows::compute(const std::string& file, const State<Dim>& state,
                                        ModuliOptions& options, const Remarks& remarks) {
  options.unloaded = state.target_stress.isZero(0.0);
  std::vector<Moduli> all;
  if (options_.accuracy)
    all = {moduli_within(state.packing, options, *options_.accuracy)};
  else if (!options_.rolling_stiffness.empty())
    all = elastic_moduli(state.packing, options, options_.rolling_stiffness);
  else if constexpr (Dim == 2)
    all = {plane_.next(state.packing, options.unloaded)};
  else
    all = {space_.next(state.packing, options.unloaded)};
  if (all.front().factor_bytes > 0.0)
    all = without_factor(file, state.packing, all.front().factor_bytes, options, remarks);
  for (const Moduli& moduli : all) require_moduli(file, moduli);
  return all;
}

template <int Dim>
std::vector<ModuliRow> ModuliRows::of(const std::string& file, const State<Dim>& state, Table* increments,
                                      const Remarks& remarks) {
  require_stiffnesses(file, state, options_);
  if (!options_.kn && !options_.kt) return of_elastic(file, state, increments, remarks);
  std::vector<ModuliRow> rows =
      of_elastic(file, with_named_stiffness(file, state, options_, remarks), increments, remarks);
  for (ModuliRow& row : rows) set_named_stiffness(row, options_);
  return rows;
}

/// Computes the rows of one state of elastic contacts.
template <int Dim>
std::vector<ModuliRow> ModuliRows::of_elastic(const std::string& file, const State<Dim>& state,
                                              Table* increments, const Remarks& remarks) {
  const ModuliRow description = described(file, state);
  warn_of_rounding(file, state, remarks);
  if (!options_.kn) warn_of_stiffnesses(file, state, remarks);
  ModuliOptions options = options_.moduli;
  const double start = processor_seconds();
  const std::vector<Moduli> moduli = compute(file, state, options, remarks);
  const double seconds = processor_seconds() - start;
  std::vector<ModuliRow> rows(moduli.size(), description);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].moduli = moduli[k];
    rows[k].rolling_stiffness = rolling_of(options_)[k];
    rows[k].mean_field =
        mean_field_estimates(with_rolling(options, rows[k].rolling_stiffness).loaded_network(state.packing),
                             description.z, description.solid_fraction);
    rows[k].seconds = seconds / static_cast<double>(rows.size());
    if (by_factor(options_) && moduli[k].method != ModuliMethod::petsc)
      add_network(state, options, rows[k], increments, remarks);
    for (const std::string& warning : moduli[k].warnings) remarks.warn(file, warning, first_number(warning));
  }
  const double since_last_row = processor_seconds() - last_row_;
  for (ModuliRow& row : rows) row.seconds_row = since_last_row / static_cast<double>(rows.size());
  last_row_ += since_last_row;
  return rows;
}

template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliTableOptions& asked, ParallelSolver& solver,
                                            const Remarks& remarks) {
  const double began = processor_seconds();
  require_stiffnesses(file, state, asked);
  if (asked.kn || asked.kt)
    state = with_named_stiffness(file, std::move(state), asked, solver.rank() == 0 ? remarks : Remarks{});
  ModuliOptions options = asked.moduli;
  options.unloaded = state.target_stress.isZero(0.0);
  const bool speaks = solver.rank() == 0;
  if (speaks) {
    warn_of_rounding(file, state, remarks);
    if (!asked.kn) warn_of_stiffnesses(file, state, remarks);
  }
  Packing<Dim>& packing = state.packing;
  const ModuliRow description = described(file, state);
  const NetworkLoad<Dim> load = network_load(packing, options.unloaded);
  std::vector<ModuliRow> rows;
  for (const auto& rolling : rolling_of(asked)) {
    const ModuliOptions chosen = with_rolling(options, rolling);
    const ContactNetwork<Dim> network = chosen.loaded_network(packing);
    if (rows.size() + 1 == rolling_of(asked).size()) packing.contacts = {};
    const double start = processor_seconds();
    ModuliRow& row = rows.emplace_back(description);
    row.moduli = elastic_moduli(network, packing.grains.position, load, chosen, solver);
    require_moduli(file, row.moduli);
    row.seconds = processor_seconds() - start;
    row.rolling_stiffness = rolling;
    set_named_stiffness(row, asked);
    row.mean_field = mean_field_estimates(network, description.z, description.solid_fraction);
    if (speaks)
      for (const std::string& warning : row.moduli.warnings) remarks.warn(file, warning, first_number(warning));
  }
  for (ModuliRow& row : rows)
    row.seconds_row = (processor_seconds() - began) / static_cast<double>(rows.size());
  return rows;
}

std::vector<std::string> ModuliTableOptions::validate() const {
  std::vector<std::string> faults = moduli.validate();
  for (const double kr : rolling_stiffness)
    for (const std::string& fault : with_rolling(moduli, kr).validate()) faults.push_back(fault);
  if (increments && moduli.method != ModuliMethod::factor)
    faults.push_back(
        "increments: needs --method factor, because other methods compute only approximate forces");
  if (increments && rolling_stiffness.size() > 1)
    faults.push_back(
        "increments: expected at most one value of --rolling-stiffness, because the file contains only one set "
        "of forces for each "
        "contact");
  for (const auto& [name, value] : {std::pair{"kn", kn}, {"kt", kt}})
    if (value && !(*value > 0.0 && std::isfinite(*value)))
      faults.push_back(fmt::format("{} = {}: expected a positive stiffness (force/length)", name, *value));
  if (kt && !kn) faults.push_back("kt: expected a normal stiffness too; give --kn");
  if (stiffness_per == StiffnessPer::contact && !kn)
    faults.push_back(
        "stiffness-per contact: expected the stiffnesses of rigid grains too; give --kn. The springs of "
        "elastic "
        "grains always belong to contact points");
  if (accuracy)
    for (const std::string& fault : accuracy->validate()) faults.push_back(fault);
  // The test of moduli.method above does not find this fault. If an accuracy is required, floc chooses the method, and
  // moduli.method may still have its default value `factor`.
  if (increments && accuracy)
    faults.push_back("increments: needs --method factor; give it instead of --accuracy");
  // If an accuracy is required, floc chooses the method and its tolerance, and all of its methods have the rolling
  // stiffness of the state.
  if (accuracy && !rolling_stiffness.empty())
    faults.push_back("accuracy: cannot be combined with --rolling-stiffness; give one of them");
  if (accuracy && moduli.method != ModuliMethod::factor)
    faults.push_back("accuracy: chooses the method itself; give --accuracy or --method");
  if (accuracy && moduli.tolerance != ModuliOptions{}.tolerance)
    faults.push_back("accuracy: chooses the tolerance itself; give --accuracy or --tolerance");
  if (memory && !(solver == ModuliSolver::automatic && by_factor(*this)))
    faults.push_back(
        "memory: is the limit from which --solver automatic computes the moduli of --method factor by PETSc; "
        "other solvers and methods do not use it");
  if (solver != ModuliSolver::petsc) return faults;
  // PETSc always uses an iterative method of its own. The options --method and --accuracy would choose another method.
  if (!by_factor(*this))
    faults.push_back(
        "solver petsc: cannot be combined with --method or --accuracy; give the required accuracy with "
        "--tolerance");
  if (increments)
    faults.push_back(
        "increments: needs --solver cholmod, because other solvers compute only approximate forces");
  return faults;
}

std::optional<ModuliAccuracy> moduli_accuracy(const std::vector<std::string>& texts) {
  if (texts.empty()) return std::nullopt;
  ModuliAccuracy accuracy;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto error = parse_number<double>(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!error || (!name.empty() && name != "B" && name != "G"))
      throw InputError(
          "floc moduli",
          fmt::format("--accuracy {}: expected X, B=X or G=X, where X is a relative error such as 1e-3", text));
    if (name != "G") accuracy.B = *error;
    if (name != "B") accuracy.G = *error;
  }
  return accuracy;
}

namespace {

template <int Dim>
bool is_free_along_every_axis(const std::vector<Wall<Dim>>& walls) {
  for (int a = 0; a < Dim; ++a)
    if (!is_open_along(walls, a)) return false;
  return true;
}

}  // namespace

void require_moduli_of(const std::string& file, const AnyState& any, const ModuliTableOptions& options) {
  std::visit([&](const auto& state) { require_stiffnesses(file, state, options); }, any);
  const StrainSet strains = options.moduli.strains;
  if (std::visit([](const auto& state) { return is_free_along_every_axis(state.packing.walls); }, any))
    throw InputError(file,
                     "this packing ends in free space along every axis, so it resists no strain and has no "
                     "moduli; its coordination is computed by floc network, its contact forces by floc forces");
  if (strains == StrainSet::full &&
      std::visit([](const auto& state) { return !state.packing.walls.empty(); }, any))
    throw InputError(file, "this state has walls, which cannot shear the grains: give --strains diagonal");
}

std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy) {
  if (!accuracy || accuracy->met_by(row.moduli)) return "";
  return fmt::format(
      "no method computes B and G with the accuracy that --accuracy requires: even with --method factor the "
      "error bounds are {:.1e} for B = {:.6g} and {:.1e} for G = {:.6g}",
      row.moduli.B_error, row.moduli.B, row.moduli.G_error, row.moduli.G);
}

Table moduli_table(const ModuliTableOptions& options, const std::vector<ModuliRow>& rows) {
  return to_table(moduli_columns({!options.rolling_stiffness.empty(), options.moduli.prestress}, rows), rows);
}

Table moduli_table(const AnyState& state, const ModuliTableOptions& options, const std::string& file,
                   const Remarks& remarks) {
  for (const std::string& fault : options.validate()) throw InputError("floc moduli", "--" + fault);
  require_moduli_of(file, state, options);
  std::visit([&](const auto& s) { warn_unless_in_equilibrium(file, s, remarks); }, state);
  ModuliRows computation(options);
  return moduli_table(
      options, std::visit([&](const auto& s) { return computation.of(file, s, nullptr, remarks); }, state));
}

template std::vector<ModuliRow> ModuliRows::of(const std::string&, const State<2>&, Table*, const Remarks&);
template std::vector<ModuliRow> ModuliRows::of(const std::string&, const State<3>&, Table*, const Remarks&);
template std::vector<ModuliRow> parallel_moduli_rows(const std::string&, State<2>, const ModuliTableOptions&,
                                                     ParallelSolver&, const Remarks&);
template std::vector<ModuliRow> parallel_moduli_rows(const std::string&, State<3>, const ModuliTableOptions&,
                                                     ParallelSolver&, const Remarks&);

}  // namespace floc
