#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "arguments.h"
#include "floc/base/infinity.h"
#include "floc/tables/compression_fits.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/elastic_fits.h"
#include "floc/tables/modulus_fits.h"
#include "floc/tables/strength_fits.h"
#include "floc/tables/table_fits.h"

namespace floc::python {
namespace {

/// Samples to fit: names of files and directories, as for the commands, and load paths given as arrays.
struct Inputs {
  std::vector<std::string> files;
  std::vector<PathArrays> arrays;
  ColumnNames columns;
};

/// Returns the samples as tables of load paths: first the tables of the files, then the tables of the arrays.
std::vector<PathTable> tables_of(const Inputs& inputs, const std::vector<std::string>& pressures,
                                 OedometerPressure oedometer, double phi_limit) {
  std::vector<PathTable> paths;
  for (const std::string& input : inputs.files)
    for (const std::string& file : floc::tables_of(input))
      paths.push_back(read_path(file, inputs.columns, pressures, oedometer, phi_limit));
  for (const PathArrays& arrays : inputs.arrays) paths.push_back(path_of_arrays(arrays, phi_limit));
  return paths;
}

/// Divides the samples in a Python list into files and arrays.
/// @param samples  list of two kinds of items: names of files, and tuples (name, pressures, densities, flag, branches).
/// The flag is true if the densities are void ratios
Inputs inputs_of(const py::list& samples, const ColumnNames& columns) {
  Inputs inputs;
  inputs.columns = columns;
  for (const py::handle& sample : samples) {
    if (py::isinstance<py::str>(sample)) {
      inputs.files.push_back(sample.cast<std::string>());
      continue;
    }
    const auto parts = sample.cast<py::tuple>();
    inputs.arrays.push_back({parts[0].cast<std::string>(), parts[1].cast<std::vector<double>>(),
                             parts[2].cast<std::vector<double>>(), parts[3].cast<bool>(),
                             parts[4].cast<std::vector<std::string>>()});
  }
  return inputs;
}

/// Converts the argument `phi_limit`, where None means no bound.
double phi_limit_of(const py::object& given) {
  return number_if_any("phi_limit", given, kPositiveNumber).value_or(kInfinity);
}

/// Converts the argument `bootstrap`, the number of resampled fits; 0 means no resampling.
int bootstrap_of(const py::object& given) {
  constexpr WholeRange kWithNone{.least = 0, .most = ConsolidationOptions::kBootstrap.most};
  const int n = whole_of("bootstrap", given, kWithNone);
  if (n != 0 && !ConsolidationOptions::kBootstrap.holds(n))
    throw InputError(
        "bootstrap",
        fmt::format("this argument is {}: expected 2 or more resampled fits, or 0 for no resampling", n));
  return n;
}

std::vector<double> window_of(const py::object& given) {
  if (given.is_none()) return {};
  std::vector<double> window = numbers_of("window", given, kPositiveNumber);
  if (window.size() != 2)
    throw InputError("", "window = " + py::repr(given).cast<std::string>() +
                             ": expected two pressures, the lowest and the highest");
  return window;
}

py::object consolidation(const py::list& samples, const ColumnNames& columns, const py::object& law,
                         const py::object& window, const py::object& P0, const py::object& protocol,
                         const py::object& loading, const py::object& weights, const py::object& loss,
                         const py::object& bootstrap, const py::object& seed, const py::object& stress,
                         const py::object& phi_limit) {
  ConsolidationFitOptions arguments;
  arguments.law = word_of("law", law, {"auto", "full", "log", "power"});
  arguments.protocol = word_of("protocol", protocol, {"", "published"});
  arguments.window = window_of(window);
  arguments.P0 = number_if_any("P0", P0, kPositiveNumber).value_or(0.0);
  // The argument P0 also determines a window: fit_of() would replace the window of the user without a message.
  if (!P0.is_none() && !window.is_none())
    throw InputError("P0",
                     "this argument cannot be combined with the argument window: expected only one of them");
  arguments.loading = word_of("loading", loading, {"", "first", "virgin"});
  arguments.weights = word_of("weights", weights, {"", "uniform", "relative", "scatter"});
  arguments.loss = word_of("loss", loss, {"squared", "huber", "cauchy"});
  arguments.n_bootstrap = bootstrap_of(bootstrap);
  arguments.seed = seed_of("seed", seed);
  arguments.stress = word_of("stress", stress, {"driven", "mean"});
  arguments.phi_limit = phi_limit_of(phi_limit);
  // Only a thread that holds the global interpreter lock may use Python objects. All arguments are therefore converted
  // before without_gil() releases the lock.
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    const ConsolidationOptions options = consolidation_options(arguments);
    const OedometerPressure oedometer =
        arguments.stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven;
    std::vector<ConsolidationSample> read;
    std::vector<PathTable> paths = tables_of(inputs, {"P_star"}, oedometer, arguments.phi_limit);
    for (PathTable& path : paths) {
      convert_pressures(paths.front(), path);
      read.push_back(consolidation_sample(path, arguments));
    }
    Json array = Json::array();
    for (const ConsolidationSample& sample : with_pooled(std::move(read), options.hold_P0))
      array.push_back(as_json(sample, fit_of(sample, arguments, options), arguments));
    return array;
  }));
}

py::object compression(const py::list& samples, const ColumnNames& columns, const py::object& law,
                       const py::object& density, const py::object& D0, const py::object& phi_limit) {
  CompressionFitOptions arguments;
  arguments.law =
      word_of("law", law, {"all", "heckel", "kawakita", "cooper-eaton", "walker", "gurnham", "adams"});
  arguments.density = word_of("density", density, {"out-of-die", "in-die"});
  arguments.fit.D0 = number_if_any("D0", D0, kPositiveNumber).value_or(0.0);
  arguments.fit.phi_limit = phi_limit_of(phi_limit);
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    Json array = Json::array();
    // phi_limit() differs from the member fit.phi_limit: it is infinite for densities measured in the die, where
    // elastic strain may take the solid fraction beyond 1.
    for (const PathTable& path :
         tables_of(inputs, {"P_star", "P"}, OedometerPressure::driven, arguments.phi_limit())) {
      const CompressedPath compressed = compression_fits(path, arguments);
      for (const CompressionFit& fit : compressed.fits)
        array.push_back(as_json(path, compressed, fit, arguments));
    }
    return array;
  }));
}

py::object preconsolidation(const py::list& samples, const ColumnNames& columns, const py::object& branches,
                            const py::object& phi_limit) {
  const std::string which = word_of("branches", branches, {"", "reloading", "first", "all"});
  const double limit = phi_limit_of(phi_limit);
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    Json array = Json::array();
    for (const PathTable& path : tables_of(inputs, {"P_star"}, OedometerPressure::driven, limit))
      for (const ReloadingFit& reloading : preconsolidation_fits(path, which))
        array.push_back(as_json(path, reloading));
    return array;
  }));
}

py::object elastic(const py::list& samples, const ColumnNames& columns, const std::string& state,
                   const py::object& phi_limit) {
  const double limit = phi_limit_of(phi_limit);
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    Json array = Json::array();
    for (const PathTable& path : tables_of(inputs, {"P", "P_star"}, OedometerPressure::mean, limit))
      for (const ElasticBranch& branch : elastic_branches(path, state)) array.push_back(as_json(path, branch));
    return array;
  }));
}

py::object fit_moduli(const std::vector<std::string>& files, const ColumnNames& columns,
                      const py::object& moduli, const py::object& branch, const py::object& phi_limit) {
  ModulusFitOptions options;
  if (!moduli.is_none()) options.moduli = texts_of("moduli", moduli);
  options.branch = word_of("branch", branch, {"first", "all"});
  options.phi_limit = phi_limit_of(phi_limit);
  return to_python(without_gil([&] {
    std::vector<ModulusFit> fits;
    for (const std::string& file : files)
      for (ModulusFit& fit : modulus_fits(file, columns, options).fits) fits.push_back(std::move(fit));
    // The means are computed after all files have been fitted, because a mean is taken over the samples of all files.
    for (ModulusFit& mean : pooled_over_samples(fits)) fits.push_back(std::move(mean));
    Json array = Json::array();
    for (const ModulusFit& fit : fits) array.push_back(as_json(fit));
    return array;
  }));
}

py::object strength(const std::vector<std::string>& inputs, const ColumnNames& columns, const py::object& kind,
                    const py::object& critical_from, const py::object& modulus) {
  StrengthOptions options;
  options.critical_from = number_if_any("critical_from", critical_from, kPositiveNumber);
  if (!modulus.is_none()) {
    const std::vector<double> range = numbers_of("modulus", modulus, kPositiveNumber);
    if (range.size() != 2 || range[0] >= range[1])
      throw InputError("modulus", "expected two axial stresses, the lower one first");
    options.modulus_range = std::pair(range[0], range[1]);
  }
  const TestKind of_tables =
      kind_of_test(word_of("kind", kind, {"drained", "undrained", "oedometer", "simple-shear"}));
  return to_python(without_gil([&] {
    // The tests of all tables are collected first, because strength_fits() also evaluates all tests of one kind
    // together, for example to fit a Mohr-Coulomb line to tests under different lateral stresses.
    std::vector<StrengthTest> tests;
    for (const std::string& input : inputs)
      for (const std::string& table : tables_of_tests(input))
        for (StrengthTest& test : read_strength_tests(table, columns, of_tables))
          tests.push_back(std::move(test));
    Json array = Json::array();
    if (tests.empty()) return array;
    for (const StrengthFit& fit : strength_fits(std::move(tests), options)) array.push_back(as_json(fit));
    return array;
  }));
}

py::dict read_table(const std::string& file, const ColumnNames& columns, const py::object& phi_limit) {
  const double limit = phi_limit_of(phi_limit);
  const PathTable path = without_gil([&] {
    return read_path(file, columns, {"P_star", "P"}, OedometerPressure::driven, limit);
  });
  std::vector<double> pressure, phi;
  std::vector<std::string> branch;
  for (const PathRow& row : path.rows) {
    pressure.push_back(row.P_star);
    phi.push_back(row.phi);
    branch.push_back(row.branch);
  }
  py::dict read;
  read["name"] = path.name;
  read["reading"] = path.reading;
  read["notes"] = path.notes;
  read["unit"] = path.unit.empty() ? py::object(py::none()) : py::object(py::str(path.unit));
  read["pressure"] = py::array_t<double>(static_cast<py::ssize_t>(pressure.size()), pressure.data());
  read["solid_fraction"] = py::array_t<double>(static_cast<py::ssize_t>(phi.size()), phi.data());
  read["branch"] = branch;
  return read;
}

py::dict cycle(const py::list& samples, const ColumnNames& columns, const py::object& phi_limit) {
  const double limit = phi_limit_of(phi_limit);
  const Inputs inputs = inputs_of(samples, columns);
  return columns_to_python(without_gil([&] {
    Table table = cycle_table();
    for (const PathTable& path : tables_of(inputs, {"P", "P_star"}, OedometerPressure::driven, limit))
      add_cycles(path, table);
    return table;
  }));
}

py::object dynamic_compaction(const std::vector<double>& e, const std::vector<double>& p,
                              const std::vector<double>& sc, const std::vector<double>& se,
                              const py::object& p_D, const py::object& eta_m, const py::object& plateau,
                              const py::object& p_0) {
  for (const auto& [name, array] : {std::pair{"p", &p}, {"sc", &sc}, {"se", &se}})
    if (array->size() != e.size())
      throw InputError(
          name, fmt::format("this array has {} values, but the array e has {}: expected arrays of equal length",
                            array->size(), e.size()));
  CompactionReference reference;
  if (const auto given = number_if_any("p_D", p_D, kPositiveNumber)) reference.p_D = *given;
  if (const auto given = number_if_any("eta_m", eta_m, kPositiveNumber)) reference.eta_m = *given;
  if (const auto given = number_if_any("p_0", p_0, kPositiveNumber)) reference.p_0 = *given;
  reference.plateau =
      word_of("plateau", plateau, {"p", "p_crit"}) == "p" ? PlateauPressure::own : PlateauPressure::critical;
  std::vector<CompactedSample> samples;
  for (std::size_t i = 0; i < e.size(); ++i)
    samples.push_back(compacted_sample(fmt::format("sample {}", i), e[i], p[i], sc[i], se[i]));
  return to_python(
      without_gil([&] { return as_json("arrays", fit_dynamic_compaction(samples, reference), reference); }));
}

py::object force_distribution(const std::string& name, const std::vector<double>& forces,
                              const py::object& form, const py::object& threshold, const py::object& draws,
                              const py::object& seed) {
  ForceDistributionOptions arguments;
  arguments.form = word_of("form", form, {"all", "tails", "power-exponential", "quadratic-exponential"});
  arguments.threshold = number_if_any("threshold", threshold, kNotNegativeNumber);
  if (const auto given = whole_if_any("draws", draws, ForceFitOptions::kDraws)) arguments.fit.n_draws = *given;
  if (!seed.is_none()) arguments.fit.seed = seed_of("seed", seed);
  return to_python(without_gil([&] {
    Json array = Json::array();
    for (const ForceFit& fit : fit_forms(forces, arguments)) array.push_back(as_json(name, forces, fit));
    return array;
  }));
}

}  // namespace

void bind_fits(py::module_& module) {
  module.def("fit_consolidation", &consolidation, py::arg("samples"), py::kw_only(), py::arg("columns"),
             py::arg("law"), py::arg("window"), py::arg("P0"), py::arg("protocol"), py::arg("loading"),
             py::arg("weights"), py::arg("loss"), py::arg("bootstrap"), py::arg("seed"), py::arg("stress"),
             py::arg("phi_limit"));
  module.def("fit_compression", &compression, py::arg("samples"), py::kw_only(), py::arg("columns"),
             py::arg("law"), py::arg("density"), py::arg("D0"), py::arg("phi_limit"));
  module.def("fit_preconsolidation", &preconsolidation, py::arg("samples"), py::kw_only(), py::arg("columns"),
             py::arg("branches"), py::arg("phi_limit"));
  module.def("fit_elastic", &elastic, py::arg("samples"), py::kw_only(), py::arg("columns"), py::arg("state"),
             py::arg("phi_limit"));
  module.def("fit_cycle", &cycle, py::arg("samples"), py::kw_only(), py::arg("columns"), py::arg("phi_limit"));
  module.def("fit_moduli", &fit_moduli, py::arg("files"), py::kw_only(), py::arg("columns"), py::arg("moduli"),
             py::arg("branch"), py::arg("phi_limit"));
  module.def("fit_strength", &strength, py::arg("inputs"), py::kw_only(), py::arg("columns"), py::arg("kind"),
             py::arg("critical_from"), py::arg("modulus"));
  module.def("read_table", &read_table, py::arg("file"), py::kw_only(), py::arg("columns"),
             py::arg("phi_limit"));
  module.def("fit_dynamic_compaction", &dynamic_compaction, py::arg("e"), py::arg("p"), py::arg("sc"),
             py::arg("se"), py::kw_only(), py::arg("p_D"), py::arg("eta_m"), py::arg("plateau"),
             py::arg("p_0"));
  module.def("fit_force_distribution", &force_distribution, py::arg("name"), py::arg("forces"), py::kw_only(),
             py::arg("form"), py::arg("threshold"), py::arg("draws"), py::arg("seed"));
}

}  // namespace floc::python
