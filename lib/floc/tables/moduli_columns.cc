#include "floc/tables/moduli_columns.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <iterator>
#include <map>

namespace floc {
namespace {

const std::map<std::string, ModuliMethod> kMethods = {{"factor", ModuliMethod::factor},
                                                      {"single-factor", ModuliMethod::single_factor},
                                                      {"iterative", ModuliMethod::iterative},
                                                      {"bounds", ModuliMethod::bounds},
                                                      {"petsc", ModuliMethod::petsc}};

const char* name_of(ModuliMethod method) {
  return std::ranges::find(kMethods, method, &std::pair<const std::string, ModuliMethod>::second)
      ->first.c_str();
}

/// Returns the name of an entry of the stiffness matrix C, such as "C12". @param a, b  indices from 0
std::string entry_name(int a, int b) {
  return fmt::format("C{}{}", a + 1, b + 1);
}

/// Returns the indices of the entries of the stiffness matrix C that follow C11, C22 and C12 in the table. These are
/// the remaining entries of the upper triangle of C: first the entries on the diagonal, then the off-diagonal entries
/// row by row.
/// @param size  number of rows of C
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

/// Returns the mean of those diagonal entries of the stiffness matrix C that belong to shear strains: C33 for disks;
/// C44, C55 and C66 for spheres. The cell is empty if C was computed without shear strains.
TableValue shear_strain_modulus(const ModuliRow& r) {
  const Eigen::Index n_shear = r.moduli.C.rows() - r.dimension;
  if (n_shear <= 0) return {};
  return r.moduli.C.diagonal().tail(n_shear).mean();
}

/// Returns the compliance matrix, that is, the inverse of the stiffness matrix C; nothing if C cannot be inverted. If C
/// was computed without shear strains, the compliance describes a cell whose shear strains are zero; otherwise it
/// describes a cell whose shear stresses are zero.
std::optional<Eigen::MatrixXd> compliance(const ModuliRow& r) {
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(r.moduli.C);
  if (!r.moduli.C.allFinite() || !factor.isInvertible()) return std::nullopt;
  return Eigen::MatrixXd(factor.inverse());
}

/// A column of the table of `floc moduli`: its name, and a function that computes its cell from a row.
using ModuliColumn = Column<ModuliRow>;

std::vector<ModuliColumn> contract_columns() {
  // Only the method "factor" counts negative eigenvalues and mechanisms. With other methods the cells are empty; a zero
  // would wrongly mean that there are no negative eigenvalues or mechanisms.
  const auto counted = [](const ModuliRow& r, int n) {
    return r.moduli.method == ModuliMethod::factor ? TableValue{std::int64_t{n}} : TableValue{};
  };
  return {{"file", [](const ModuliRow& r) { return r.file; }},
          {"dimension", [](const ModuliRow& r) { return count(r.dimension); }},
          {"n_grains", [](const ModuliRow& r) { return r.n_grains; }},
          {"n_contacts", [](const ModuliRow& r) { return r.n_contacts; }},
          {"n_distant", [](const ModuliRow& r) { return r.n_distant; }},
          {"P", [](const ModuliRow& r) { return r.pressure; }},
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
  // These columns describe the mechanics of the contact network, which only --method factor computes. They are empty in
  // rows that were computed by another method.
  const auto column = [](const char* name, const Value& value) -> ModuliColumn {
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
  const auto column = [](const char* name, const Value& value) -> ModuliColumn {
    return {name, [value](const ModuliRow& r) { return r.budget ? value(*r.budget) : TableValue{}; }};
  };
  return {column("rounding_floor", [](const ErrorBudget& b) { return b.floor.force; }),
          column("residual_force", [](const ErrorBudget& b) { return b.residual; }),
          column("n_undecided", [](const ErrorBudget& b) { return TableValue{std::int64_t{b.n_undecided}}; }),
          column("error_B_equilibrium", [](const ErrorBudget& b) { return or_undefined(b.equilibrium); }),
          column("error_B_sampling", [](const ErrorBudget& b) { return b.sampling; }),
          column("limited_by", [](const ErrorBudget& b) { return std::string(b.limit()); })};
}

/// Returns the columns of Young's modulus E_a along each axis a, and of Poisson's ratio nu_ab for each pair of axes a
/// and b. These columns are needed for anisotropic states, because B and G are only means over the axes.
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

}  // namespace

ModuliMethod moduli_method(const std::string& keyword) {
  return kMethods.at(keyword);
}

StrainSet strain_set(const std::string& keyword) {
  return keyword == "full" ? StrainSet::full : StrainSet::diagonal;
}

std::vector<Column<ModuliRow>> moduli_columns(const ModuliColumnChoice& choice,
                                              const std::vector<ModuliRow>& rows) {
  std::vector<ModuliColumn> columns = contract_columns();
  std::ranges::move(network_columns(), std::back_inserter(columns));
  std::ranges::move(budget_columns(), std::back_inserter(columns));
  int size = 2;
  for (const ModuliRow& r : rows) size = std::max(size, static_cast<int>(r.moduli.C.rows()));
  for (const auto& [a, b] : further_entries(size))
    columns.emplace_back(entry_name(a, b),
                         [a = a, b = b](const ModuliRow& r) { return entry(r.moduli.C, a, b); });
  if (choice.rolling_stiffness)
    columns.emplace_back("rolling_stiffness",
                         [](const ModuliRow& r) { return or_undefined(r.rolling_stiffness); });
  if (choice.prestress) {
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
  columns.emplace_back("p_wall", [](const ModuliRow& r) { return or_undefined(r.wall_pressure); });
  columns.emplace_back("bounds_hold", [](const ModuliRow& r) { return r.moduli.bounds_hold(); });
  columns.emplace_back("bounds_hold_B_S", [](const ModuliRow& r) { return r.moduli.bounds_hold_B_S(); });
  columns.emplace_back("seconds_row", [](const ModuliRow& r) { return r.seconds_row; });
  columns.emplace_back("P_driven", [](const ModuliRow& r) { return r.driven_stress; });
  columns.emplace_back("P_driven_star", [](const ModuliRow& r) { return r.reduced_driven_stress; });
  columns.emplace_back("kn_named", [](const ModuliRow& r) { return or_undefined(r.kn_named); });
  columns.emplace_back("kt_named", [](const ModuliRow& r) { return or_undefined(r.kt_named); });
  columns.emplace_back("stiffness_per", [](const ModuliRow& r) {
    if (!r.stiffness_per) return TableValue{};
    return TableValue{*r.stiffness_per == StiffnessPer::contact ? "contact" : "point"};
  });
  return columns;
}

}  // namespace floc
