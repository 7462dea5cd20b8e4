#include "floc/elasticity/moduli.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>

#include "columns.h"
#include "command.h"
#include "equilibrium_check.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/elasticity/error_budget.h"
#include "floc/elasticity/mean_field.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/modes.h"
#include "floc/elasticity/moduli_within.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/packing/equilibrium.h"
#include "floc/structure/coordination.h"
#include "increments.h"
#include "output.h"
#include "repeated_warnings.h"

namespace floc {
namespace {

const std::map<std::string, ModuliMethod> kMethods = {{"factor", ModuliMethod::factor},
                                                      {"single-factor", ModuliMethod::single_factor},
                                                      {"iterative", ModuliMethod::iterative},
                                                      {"bounds", ModuliMethod::bounds}};

const char* name_of(ModuliMethod method) {
  return std::ranges::find(kMethods, method, &std::pair<const std::string, ModuliMethod>::second)
      ->first.c_str();
}

/// Near-mechanisms are counted up to this number of grains: it takes a factor that is slow for large packings.
constexpr int kLargestCounted = 20000;

struct ModuliCommand {
  std::vector<std::string> files;
  std::string strains = "diagonal";
  bool prestress = false;
  bool force = false;
  ModuliOptions options;
  std::string method = "factor";
  std::vector<std::string> accuracy;  ///< "X", or "B=X", "G=X"; empty: the method says what is spent
  std::vector<double> rolling_stiffness;
  std::string increments;  ///< file for the increments of every contact; empty: none
  std::string format;
};

/// One row: what a state is and its moduli.
struct ModuliRow {
  std::string file;
  std::string units;
  int dimension;
  std::int64_t n_grains;
  std::int64_t n_contacts;
  std::int64_t n_distant;
  double z;
  double reduced_pressure;
  double solid_fraction;
  Moduli moduli;
  std::optional<NetworkMechanics> network;  ///< where moduli are solved for in full
  std::optional<ErrorBudget> budget;        ///< likewise
  std::optional<int> n_near_mechanisms;
  std::optional<double> B_prestress;  ///< where near-mechanisms make it count
  std::optional<double> G_prestress;
  std::optional<double> rolling_stiffness;
  MeanFieldEstimates mean_field;
  double seconds;
};

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
  const ElasticResponse response = std::move(row.moduli.response);
  const auto vanishing = strain_mechanisms<Dim>(response, affine_stiffness(network, options.strains)).vanishing;
  if (!vanishing.empty()) warn(row.file, fmt::format("moduli that vanish: {}", fmt::join(vanishing, ", ")));
  if (network.n_grains > kLargestCounted) return;
  row.n_near_mechanisms = count_near_mechanisms(network, response);
  if (*row.n_near_mechanisms == 0 && !options.prestress) return;
  options.prestress = true;
  const Moduli with = row.moduli.B_without_prestress ? row.moduli : elastic_moduli(packing, options);
  row.B_prestress = with.B;
  row.G_prestress = with.G;
}

/// Moduli of the states of the call so far, which an iterative method goes on from.
struct ModuliSequences {
  ModuliSequence<2> plane;
  ModuliSequence<3> space;

  Moduli next(const Packing<2>& packing, bool unloaded) { return plane.next(packing, unloaded); }
  Moduli next(const Packing<3>& packing, bool unloaded) { return space.next(packing, unloaded); }
};

/// How moduli are asked for.
struct ModuliRequest {
  ModuliOptions options;
  std::optional<ModuliAccuracy> accuracy;  ///< instead of a method
  const std::vector<double>& rolling_stiffness;
};

/// One for each rolling stiffness asked for, or one with the state's own.
template <int Dim>
std::vector<Moduli> compute_moduli(const Packing<Dim>& packing, const ModuliRequest& request,
                                   ModuliSequences& sequences) {
  if (request.accuracy) return {moduli_within(packing, request.options, *request.accuracy)};
  if (request.rolling_stiffness.empty()) return {sequences.next(packing, request.options.unloaded)};
  return elastic_moduli(packing, request.options, request.rolling_stiffness);
}

/// A row for each of them.
template <int Dim>
std::vector<ModuliRow> compute_rows(const std::string& file, const State<Dim>& state, ModuliRequest request,
                                    ModuliSequences& sequences, Table* increments) {
  request.options.unloaded = state.target_stress.isZero(0.0);
  const ModuliRow description = described(file, state);
  warn_of_rounding(file, state);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Moduli> moduli = compute_moduli(state.packing, request, sequences);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::vector<ModuliRow> rows(moduli.size(), description);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].moduli = moduli[k];
    rows[k].reduced_pressure = reduced_pressure<Dim>(state.packing, moduli[k].pressure);
    if (!request.rolling_stiffness.empty()) rows[k].rolling_stiffness = request.rolling_stiffness[k];
    ModuliOptions options = request.options;
    if (rows[k].rolling_stiffness) options.rolling_stiffness = rows[k].rolling_stiffness;
    rows[k].mean_field =
        mean_field_estimates(options.loaded_network(state.packing), description.z, description.solid_fraction);
    rows[k].seconds = seconds / static_cast<double>(rows.size());
    if (request.options.method == ModuliMethod::factor && !request.accuracy)
      add_network(state, request.options, rows[k], increments);
    for (const std::string& warning : moduli[k].warnings) warn(file, warning, first_number(warning));
  }
  return rows;
}

/// Name of an entry of C, "C12"; indices from 0.
std::string entry_name(int a, int b) {
  return fmt::format("C{}{}", a + 1, b + 1);
}

/// Entries of the upper triangle beyond C11, C22, C12: diagonal first, then row by row.
std::vector<std::pair<int, int>> further_entries(int size) {
  std::vector<std::pair<int, int>> entries;
  for (int a = 2; a < size; ++a) entries.emplace_back(a, a);
  for (int a = 0; a < size; ++a)
    for (int b = std::max(a + 1, 2); b < size; ++b) entries.emplace_back(a, b);
  return entries;
}

TableValue entry(const Eigen::MatrixXd& c, int a, int b) {
  if (a >= c.rows() || b >= c.rows()) return {};
  return c(a, b);
}

/// Mean of the shear entries of C, C33 of disks, C44, C55 and C66 of spheres; empty where shear is clamped.
TableValue shear_strain_modulus(const ModuliRow& r) {
  const Eigen::Index n_shear = r.moduli.C.rows() - r.dimension;
  if (n_shear <= 0) return {};
  return r.moduli.C.diagonal().tail(n_shear).mean();
}

/// Compliances of the normal strains, shear clamped (or relaxed, where the strains are full).
std::optional<Eigen::MatrixXd> compliance(const ModuliRow& r) {
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(r.moduli.C);
  if (!r.moduli.C.allFinite() || !factor.isInvertible()) return std::nullopt;
  return Eigen::MatrixXd(factor.inverse());
}

/// A column of the table: its name and how a row fills it.
using ModuliColumn = Column<ModuliRow>;

std::vector<ModuliColumn> contract_columns() {
  const auto counted = [](const ModuliRow& r, int n) {
    return r.moduli.method == ModuliMethod::factor ? TableValue{std::int64_t{n}} : TableValue{};
  };
  return {{"file", [](const ModuliRow& r) { return r.file; }},
          {"dimension", [](const ModuliRow& r) { return count(r.dimension); }},
          {"n_grains", [](const ModuliRow& r) { return r.n_grains; }},
          {"n_contacts", [](const ModuliRow& r) { return r.n_contacts; }},
          {"n_distant", [](const ModuliRow& r) { return r.n_distant; }},
          {"P", [](const ModuliRow& r) { return r.moduli.pressure; }},
          {"P_star", [](const ModuliRow& r) { return r.reduced_pressure; }},
          {"phi", [](const ModuliRow& r) { return r.solid_fraction; }},
          {"z", [](const ModuliRow& r) { return r.z; }},
          {"C11", [](const ModuliRow& r) { return r.moduli.C(0, 0); }},
          {"C22", [](const ModuliRow& r) { return r.moduli.C(1, 1); }},
          {"C12", [](const ModuliRow& r) { return r.moduli.C(0, 1); }},
          {"B", [](const ModuliRow& r) { return r.moduli.B; }},
          {"B_S", [](const ModuliRow& r) { return r.moduli.B_S; }},
          {"G", [](const ModuliRow& r) { return r.moduli.G; }},
          {"isotropy_defect", [](const ModuliRow& r) { return r.moduli.isotropy_defect; }},
          {"B_voigt", [](const ModuliRow& r) { return r.moduli.bounds.B_voigt; }},
          {"G_voigt", [](const ModuliRow& r) { return r.moduli.bounds.G_voigt; }},
          {"B_reuss", [](const ModuliRow& r) { return r.moduli.bounds.B_reuss; }},
          {"B_voigt_printed", [](const ModuliRow& r) { return r.moduli.bounds.B_voigt_printed; }},
          {"G_voigt_printed", [](const ModuliRow& r) { return r.moduli.bounds.G_voigt_printed; }},
          {"B_reuss_printed", [](const ModuliRow& r) { return r.moduli.bounds.B_reuss_printed; }},
          {"Z2", [](const ModuliRow& r) { return r.moduli.bounds.Z2; }},
          {"n_negative", [counted](const ModuliRow& r) { return counted(r, r.moduli.n_negative); }},
          {"n_mechanisms", [counted](const ModuliRow& r) { return counted(r, r.moduli.n_mechanisms); }},
          {"n_coupled_mechanisms",
           [counted](const ModuliRow& r) { return counted(r, r.moduli.n_coupled_mechanisms); }},
          {"residual", [](const ModuliRow& r) { return r.moduli.residual; }},
          {"condition", [](const ModuliRow& r) { return r.moduli.condition; }},
          {"seconds", [](const ModuliRow& r) { return r.seconds; }},
          {"units", [](const ModuliRow& r) { return r.units; }},
          {"n_rattlers", [](const ModuliRow& r) { return count(r.moduli.n_rattlers); }},
          {"n_free_rollers", [](const ModuliRow& r) { return count(r.moduli.n_free_rollers); }},
          {"n_at_cap", [](const ModuliRow& r) { return count(r.moduli.n_mobilised); }},
          {"error_C", [](const ModuliRow& r) { return r.moduli.C_error.maxCoeff(); }},
          {"error_B", [](const ModuliRow& r) { return r.moduli.B_error; }},
          {"error_B_S", [](const ModuliRow& r) { return r.moduli.B_S_error; }},
          {"error_G", [](const ModuliRow& r) { return r.moduli.G_error; }}};
}

std::vector<ModuliColumn> network_columns() {
  using Value = std::function<TableValue(const NetworkMechanics&)>;
  const auto count = [](int NetworkMechanics::*member) -> Value {
    return [member](const NetworkMechanics& m) { return TableValue{std::int64_t{m.*member}}; };
  };
  const auto number = [](double NetworkMechanics::*member) -> Value {
    return [member](const NetworkMechanics& m) { return TableValue{m.*member}; };
  };
  const auto maybe = [](std::optional<double> NetworkMechanics::*member) -> Value {
    return [member](const NetworkMechanics& m) { return or_undefined(m.*member); };
  };
  const auto column = [](const char* name, Value value) -> ModuliColumn {
    return {name, [value](const ModuliRow& r) { return r.network ? value(*r.network) : TableValue{}; }};
  };
  using N = NetworkMechanics;
  return {column("n_dead_ends", count(&N::n_dead_ends)),
          column("n_components", count(&N::n_components)),
          column("n_percolating", count(&N::n_percolating)),
          {"n_near_mechanisms",
           [](const ModuliRow& r) {
             return r.n_near_mechanisms ? TableValue{std::int64_t{*r.n_near_mechanisms}} : TableValue{};
           }},
          {"B_prestress", [](const ModuliRow& r) { return or_undefined(r.B_prestress); }},
          {"G_prestress", [](const ModuliRow& r) { return or_undefined(r.G_prestress); }},
          column("x0", number(&N::rattler_fraction)),
          column("z_star", number(&N::z_star)),
          column("G_star", maybe(&N::G_star)),
          column("indeterminacy", [](const N& m) { return TableValue{std::int64_t{m.indeterminacy.degree}}; }),
          column("energy_share_95", maybe(&N::energy_share_95)),
          column("energy_share_95_deviatoric", maybe(&N::energy_share_95_deviatoric)),
          column("backbone_share", maybe(&N::backbone_share)),
          column("scalar_backbone_share", maybe(&N::scalar_backbone_share))};
}

std::vector<ModuliColumn> budget_columns() {
  using Value = std::function<TableValue(const ErrorBudget&)>;
  const auto column = [](const char* name, Value value) -> ModuliColumn {
    return {name, [value](const ModuliRow& r) { return r.budget ? value(*r.budget) : TableValue{}; }};
  };
  return {column("rounding_floor", [](const ErrorBudget& b) { return b.floor.force; }),
          column("residual_force", [](const ErrorBudget& b) { return b.residual; }),
          column("n_undecided", [](const ErrorBudget& b) { return TableValue{std::int64_t{b.n_undecided}}; }),
          column("error_B_equilibrium", [](const ErrorBudget& b) { return or_undefined(b.equilibrium); }),
          column("error_B_sampling", [](const ErrorBudget& b) { return b.sampling; }),
          column("limited_by", [](const ErrorBudget& b) { return std::string(b.limit()); })};
}

/// Young's modulus along each axis, and what the axes b shorten by when a lengthens: of states whose axes
/// differ, which B and G are means of.
std::vector<ModuliColumn> axis_columns(int dimension) {
  std::vector<ModuliColumn> columns;
  for (int a = 0; a < dimension; ++a)
    columns.emplace_back(fmt::format("E_{}", a + 1), [a](const ModuliRow& r) {
      const auto S = compliance(r);
      return S && a < r.dimension ? TableValue{1.0 / (*S)(a, a)} : TableValue{};
    });
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b) {
      if (a == b) continue;
      columns.emplace_back(fmt::format("nu_{}{}", a + 1, b + 1), [a, b](const ModuliRow& r) {
        const auto S = compliance(r);
        return S && std::max(a, b) < r.dimension ? TableValue{-(*S)(b, a) / (*S)(a, a)} : TableValue{};
      });
    }
  return columns;
}

std::vector<ModuliColumn> columns_for(const ModuliCommand& command, const std::vector<ModuliRow>& rows) {
  std::vector<ModuliColumn> columns = contract_columns();
  std::ranges::move(network_columns(), std::back_inserter(columns));
  std::ranges::move(budget_columns(), std::back_inserter(columns));
  int size = 2;
  for (const ModuliRow& r : rows) size = std::max(size, static_cast<int>(r.moduli.C.rows()));
  for (const auto& [a, b] : further_entries(size))
    columns.emplace_back(entry_name(a, b), [a, b](const ModuliRow& r) { return entry(r.moduli.C, a, b); });
  if (!command.rolling_stiffness.empty())
    columns.emplace_back("rolling_stiffness",
                         [](const ModuliRow& r) { return or_undefined(r.rolling_stiffness); });
  if (command.prestress) {
    columns.emplace_back("B_without_prestress",
                         [](const ModuliRow& r) { return or_undefined(r.moduli.B_without_prestress); });
    columns.emplace_back("G_without_prestress",
                         [](const ModuliRow& r) { return or_undefined(r.moduli.G_without_prestress); });
  }
  columns.emplace_back("method", [](const ModuliRow& r) { return std::string(name_of(r.moduli.method)); });
  columns.emplace_back("G_voigt_smooth_mean_field",
                       [](const ModuliRow& r) { return r.mean_field.G_voigt_smooth; });
  columns.emplace_back("B_reuss_mean_field", [](const ModuliRow& r) { return r.mean_field.B_reuss; });
  columns.emplace_back("Z_hat", [](const ModuliRow& r) { return r.mean_field.Z_hat; });
  columns.emplace_back("G_shear", [](const ModuliRow& r) { return shear_strain_modulus(r); });
  int dimension = 2;
  for (const ModuliRow& r : rows) dimension = std::max(dimension, r.dimension);
  std::ranges::move(axis_columns(dimension), std::back_inserter(columns));
  return columns;
}

ModuliOptions options_of(const ModuliCommand& command) {
  ModuliOptions options = command.options;
  options.strains = command.strains == "full" ? StrainSet::full : StrainSet::diagonal;
  options.prestress = command.prestress;
  options.method = kMethods.at(command.method);
  std::vector<std::string> faults = options.validate();
  if (options.method != ModuliMethod::factor && !command.increments.empty())
    faults.push_back("increments: expects --method factor, the forces of the others being approximate");
  for (const double kr : command.rolling_stiffness) {
    ModuliOptions with = command.options;
    with.rolling_stiffness = kr;
    for (const std::string& fault : with.validate()) faults.push_back(fault);
  }
  if (!command.increments.empty() && command.rolling_stiffness.size() > 1)
    faults.push_back("increments: expects one rolling stiffness at most, for one set of forces a contact");
  for (const std::string& fault : faults) throw InputError("floc moduli", "--" + fault);
  return options;
}

/// Reads --accuracy: "X" for both moduli, "B=X", "G=X"; nothing where it is not given.
std::optional<ModuliAccuracy> accuracy_of(const ModuliCommand& command) {
  if (command.accuracy.empty()) return std::nullopt;
  ModuliAccuracy accuracy;
  for (const std::string& text : command.accuracy) {
    const std::size_t equals = text.find('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto error = parse_number<double>(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!error || (name != "" && name != "B" && name != "G"))
      throw InputError("floc moduli",
                       fmt::format("--accuracy {}: expected X, B=X or G=X with X a relative error", text));
    if (name != "G") accuracy.B = *error;
    if (name != "B") accuracy.G = *error;
  }
  for (const std::string& fault : accuracy.validate()) throw InputError("floc moduli", "--" + fault);
  if (!command.increments.empty())
    throw InputError("floc moduli", "--increments: expects --method factor in place of --accuracy");
  return accuracy;
}

/// Whether rows keep what was asked for; if not, says so on stderr.
bool accuracy_met(const std::vector<ModuliRow>& rows, const std::optional<ModuliAccuracy>& accuracy) {
  if (!accuracy) return true;
  return std::ranges::all_of(rows, [&](const ModuliRow& row) {
    if (accuracy->met_by(row.moduli)) return true;
    std::cerr << fmt::format(
        "floc: {}: no method tells B and G as accurately as asked: the error bounds of the factor are {:.1e} "
        "of "
        "{:.6g} and {:.1e} of {:.6g}\n",
        row.file, row.moduli.B_error, row.moduli.B, row.moduli.G_error, row.moduli.G);
    return false;
  });
}

/// Whether a state is an equilibrium; if not, says so on stderr. A state not refused with `force` is warned
/// about.
bool check_equilibrium(const std::string& file, const AnyState& any, bool force) {
  const std::string faults = std::visit([](const auto& state) { return equilibrium_faults(state); }, any);
  if (faults.empty()) return true;
  if (force)
    warn(file, "this state is not in equilibrium: " + faults,
         std::visit([](const auto& s) { return equilibrium_excess(s); }, any));
  else
    std::cerr << "floc: " << file << ": this state is not in equilibrium: " << faults
              << "; --force computes moduli all the same\n";
  return false;
}

int run_moduli(const ModuliCommand& command) {
  const ModuliRequest request{options_of(command), accuracy_of(command), command.rolling_stiffness};
  std::vector<ModuliRow> rows;
  ModuliSequences sequences{ModuliSequence<2>(request.options), ModuliSequence<3>(request.options)};
  Table increments;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    if (!check_equilibrium(file, any, command.force) && !command.force) return int{kVerificationFailed};
    if (request.options.strains == StrainSet::full &&
        std::visit([](const auto& state) { return !state.packing.walls.empty(); }, any))
      throw InputError(file, "has walls, which shear no grains: expected --strains diagonal");
    std::vector<ModuliRow> computed = std::visit(
        [&](const auto& state) {
          return compute_rows(file, state, request, sequences,
                              command.increments.empty() ? nullptr : &increments);
        },
        any);
    const int outcome = accuracy_met(computed, request.accuracy) ? kDone : kNotConverged;
    std::ranges::move(computed, std::back_inserter(rows));
    return outcome;
  });
  if (!command.increments.empty()) write_csv(command.increments, increments);
  print_table(to_table(columns_for(command, rows), rows), command.format);
  return code;
}

}  // namespace

Command add_moduli(CommandLine program) {
  CommandLine app = program.add_subcommand("moduli", "Elastic moduli, bounds and stability of saved states");
  const auto command = std::make_shared<ModuliCommand>();
  add_states_argument(app, command->files);
  app.add_option("--strains", command->strains,
                 "diagonal: shear strains clamped; full: every component, which adds the shear moduli")
      .one_of({"diagonal", "full"})
      .show_default();
  app.add_flag("--prestress", command->prestress,
               "add the geometric terms of the forces (those of F_T left out); stress is the Cauchy stress");
  const Option tolerance =
      app.add_option(
             "--tolerance", command->options.tolerance,
             "relative error wanted of B and G; what is reached is printed, and said where it falls short")
          .show_default();
  const Option method =
      app.add_option(
             "--method", command->method,
             "factor; single-factor: in single precision, refined; iterative: from the state before, to "
             "--tolerance; bounds: the middle between them. Errors of the last three are printed too")
          .one_of({"factor", "single-factor", "iterative", "bounds"})
          .show_default();
  const Option accuracy =
      app.add_option(
             "--accuracy", command->accuracy,
             "X, or B=X, G=X: relative errors that are good enough; takes the cheapest method that keeps them "
             "and names it in the column method")
          .delimiter(',')
          .excludes(method)
          .excludes(tolerance)
          .one_argument_each();
  app.add_option("--force-tolerance", command->options.force_tolerance,
                 "cohesionless: a contact below this force carries nothing, in max(F0, P a^(d-1))")
      .show_default();
  app.add_option("--rolling-stiffness", command->rolling_stiffness,
                 "K_R of every touching contact, in the state's units; a row for each value")
      .delimiter(',')
      .excludes(method)
      .excludes(accuracy)
      .one_argument_each();
  app.add_option(
      "--increments", command->increments,
      "file for a row a contact: what a unit of isotropic and of deviatoric stress adds to its forces, "
      "energy and rank, dead end, backbones");
  app.add_flag("--force", command->force,
               "also of states that are not in equilibrium, which are refused otherwise");
  add_format_option(app, command->format);
  return {app, [command] { return run_moduli(*command); }};
}

}  // namespace floc
