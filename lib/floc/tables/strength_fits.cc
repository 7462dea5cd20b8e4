#include "floc/tables/strength_fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "floc/fitting/correlated_mean.h"
#include "floc/fitting/mohr_coulomb.h"
#include "floc/fitting/oedometer_test.h"

namespace floc {
namespace {

/// Stresses at failure and parameters of all tests of one kind, from which common parameters are fitted.
struct Pool {
  int n_tests = 0;
  std::vector<FailureStress> peak, critical;
  std::vector<PlaneStress> peak_planes, critical_planes;  ///< stresses in tests on planes
  /// Lateral stress at the beginning of each test or, in tests on planes, normal stress on the planes.
  std::vector<double> imposed;
  std::map<std::string, std::vector<double>> values;  ///< values of each parameter; the key is its name
  std::vector<std::string> names;  ///< names of the parameters, in the order in which they were added

  void add(const std::vector<FittedParameter>& parameters) {
    for (const FittedParameter& p : parameters) {
      if (!p.value) continue;
      if (!values.contains(p.name)) names.push_back(p.name);
      values[p.name].push_back(*p.value);
    }
  }
};

/// Converts the stresses of `test` to the unit of the stresses of `to`.
void convert_stresses(const StrengthTest& to, StrengthTest& test) {
  const double factor = unit_factor(test.sample, test.unit, to.sample, to.unit);
  test.unit = to.unit;
  for (ShearPoint& p : test.points) {
    p.axial_stress *= factor;
    p.lateral_stress *= factor;
  }
  for (PlaneShearPoint& p : test.planes) {
    p.normal_stress *= factor;
    p.shear_stress *= factor;
  }
}

/// Adds the states of a table to a pool. Each row of the table is the state of one sample at failure.
void add_failures(const StrengthTest& test, Pool& pool) {
  for (const ShearPoint& p : test.points) {
    ++pool.n_tests;
    pool.peak.push_back(p.failure());
    pool.imposed.push_back(p.failure().minor);
    pool.add({held_at("secant_angle_peak", secant_angle(p.failure()))});
  }
  for (const PlaneShearPoint& p : test.planes) {
    ++pool.n_tests;
    pool.peak_planes.push_back(p.stress());
    pool.imposed.push_back(p.normal_stress);
    pool.add({angle_of_tangent(held_at("secant_angle_peak", p.mobilised()))});
  }
}

StrengthFit evaluate_shear(const StrengthTest& test, const StrengthOptions& options, Pool& pool) {
  StrengthFit fit;
  const ShearTest result =
      evaluate_shear_test(test.points, {options.critical_from, test.kind == TestKind::undrained});
  fit.failure_reason = result.failure_reason;
  fit.parameters = result.parameters;
  fit.warnings = result.warnings;
  if (!result.found()) return fit;
  ++pool.n_tests;
  pool.peak.push_back(result.peak_stress);
  if (result.critical_stress) pool.critical.push_back(*result.critical_stress);
  pool.imposed.push_back(test.points.front().lateral_stress);
  pool.add(result.parameters);
  return fit;
}

StrengthFit evaluate_simple_shear(const StrengthTest& test, const StrengthOptions& options, Pool& pool) {
  StrengthFit fit;
  const SimpleShearTest result = evaluate_simple_shear_test(test.planes, options.critical_from);
  fit.failure_reason = result.failure_reason;
  fit.parameters = result.parameters;
  fit.warnings = result.warnings;
  if (!result.found()) return fit;
  ++pool.n_tests;
  pool.peak_planes.push_back(result.peak_stress);
  if (result.critical_stress) pool.critical_planes.push_back(*result.critical_stress);
  pool.imposed.push_back(test.planes.front().normal_stress);
  pool.add(result.parameters);
  return fit;
}

StrengthFit evaluate_oedometer(const StrengthTest& test, const StrengthOptions& options, Pool& pool) {
  StrengthFit fit;
  const OedometerTest result = evaluate_oedometer_test(test.points, options.modulus_range);
  fit.failure_reason = result.failure_reason;
  fit.parameters = result.parameters;
  if (!result.found()) return fit;
  ++pool.n_tests;
  pool.add(result.parameters);
  return fit;
}

StrengthFit evaluate(const StrengthTest& test, const StrengthOptions& options, Pool& pool) {
  if (test.kind == TestKind::oedometer) return evaluate_oedometer(test, options, pool);
  if (test.kind == TestKind::simple_shear) return evaluate_simple_shear(test, options, pool);
  return evaluate_shear(test, options, pool);
}

/// Returns whether the stresses at the beginning of all tests are equal, to 5 % of the largest.
bool have_one_stress(const std::vector<double>& imposed) {
  constexpr double kSame = 0.05;
  const auto [least, most] = std::ranges::minmax(imposed);
  return most - least <= kSame * std::abs(most);
}

void add_line(const MohrCoulombFit& line, const std::string& suffix, StrengthFit& fit) {
  if (!line.found()) {
    fit.warnings.push_back(fmt::format("no Mohr-Coulomb line was fitted to the states of the {}: {}",
                                       suffix == "_peak" ? "peak" : "critical state", line.failure_reason));
    return;
  }
  fit.parameters.insert(fit.parameters.end(), {line.angle, line.cohesion});
  fit.warnings.insert(fit.warnings.end(), line.warnings.begin(), line.warnings.end());
}

StrengthFit pooled(TestKind kind, const Pool& pool) {
  StrengthFit fit;
  fit.sample = "pooled";
  fit.kind = kind;
  fit.n = pool.n_tests;
  if (pool.imposed.empty() || have_one_stress(pool.imposed)) {
    for (const std::string& name : pool.names)
      fit.parameters.push_back(mean_of_samples(name, pool.values.at(name)));
    return fit;
  }
  const auto add_lines = [&](const auto& fit_line, const auto& peak, const auto& critical) {
    for (const auto& [stresses, suffix] : {std::pair(&peak, "_peak"), std::pair(&critical, "_critical")})
      if (!stresses->empty()) add_line(fit_line(*stresses, suffix), suffix, fit);
  };
  add_lines(fit_mohr_coulomb, pool.peak, pool.critical);
  add_lines(fit_mohr_coulomb_planes, pool.peak_planes, pool.critical_planes);
  return fit;
}

TableValue unit_of(const std::string& parameter, const std::string& stress_unit) {
  if (parameter.find("angle") != std::string::npos) return std::string("degree");
  const bool is_stress = parameter.starts_with("cohesion") || parameter.starts_with("undrained_strength") ||
                         parameter == "constrained_modulus";
  return is_stress ? or_undefined(stress_unit) : TableValue{};
}

}  // namespace

std::vector<StrengthFit> strength_fits(std::vector<StrengthTest> tests, const StrengthOptions& options) {
  std::vector<StrengthFit> fits;
  std::map<TestKind, Pool> pools;
  for (StrengthTest& test : tests) {
    convert_stresses(tests.front(), test);
    Pool& pool = pools[test.kind];
    if (test.kind == TestKind::failure) {
      add_failures(test, pool);
      continue;
    }
    Pool left_out;
    StrengthFit fit = evaluate(test, options, test.is_reversal ? left_out : pool);
    fit.sample = test.sample;
    fit.rows = ranges(test.rows);
    fit.kind = test.kind;
    fit.n = static_cast<int>(test.n_states());
    fits.push_back(std::move(fit));
  }
  // Rows of samples at failure have no results of their own, so that they are pooled even if there is only one.
  for (const auto& [kind, pool] : pools)
    if (pool.n_tests > 1 || kind == TestKind::failure) fits.push_back(pooled(kind, pool));
  for (StrengthFit& fit : fits) fit.unit = tests.front().unit;
  return fits;
}

Table strength_table(const std::vector<StrengthFit>& fits) {
  Table table{
      {"sample", "rows", "test", "parameter", "value", "stderr", "low95", "high95", "identified", "unit", "n"},
      {}};
  for (const StrengthFit& fit : fits)
    for (const FittedParameter& p : fit.parameters) {
      std::vector<TableValue> row = {fit.sample, or_undefined(fit.rows), std::string(name_of(fit.kind)),
                                     p.name};
      for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
      row.push_back(unit_of(p.name, fit.unit));
      row.emplace_back(std::int64_t{fit.n});
      table.rows.push_back(std::move(row));
    }
  return table;
}

Json as_json(const StrengthFit& fit) {
  Json object;
  object["sample"] = fit.sample;
  object["rows"] = fit.rows.empty() ? Json(nullptr) : Json(fit.rows);
  object["test"] = name_of(fit.kind);
  object["refusal"] = fit.failure_reason.empty() ? Json(nullptr) : Json(fit.failure_reason);
  object["n"] = fit.n;
  object["stress_unit"] = fit.unit.empty() ? Json(nullptr) : Json(fit.unit);
  object["parameters"] = parameters_as_json(fit.parameters);
  object["warnings"] = fit.warnings;
  return object;
}

}  // namespace floc
