#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "binding.h"
#include "consolidation_fits.h"
#include "elastic_fits.h"
#include "table_fits.h"

namespace floc::python {
namespace {

/// What a fit reads: files and directories as commands take them, and paths in memory.
struct Inputs {
  std::vector<std::string> files;
  std::vector<PathArrays> arrays;
  ColumnNames columns;
};

/// Files, then arrays, as tables.
std::vector<PathTable> tables_of(const Inputs& inputs, const std::vector<std::string>& pressures,
                                 OedometerPressure oedometer = OedometerPressure::driven) {
  std::vector<PathTable> paths;
  for (const std::string& input : inputs.files)
    for (const std::string& file : floc::tables_of(input))
      paths.push_back(read_path(file, inputs.columns, pressures, oedometer));
  for (const PathArrays& arrays : inputs.arrays) paths.push_back(path_of_arrays(arrays));
  return paths;
}

/// @param samples  a path of a file, or (name, pressures, densities, whether these are void ratios, branches)
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

py::object consolidation(const py::list& samples, const ColumnNames& columns, const std::string& law,
                         const std::optional<std::pair<double, double>>& window, std::optional<double> P0,
                         const std::string& protocol, const std::string& loading, const std::string& weights,
                         const std::string& loss, int bootstrap, std::uint64_t seed,
                         const std::string& stress) {
  require_one_of("law", law, {"full", "log", "power"});
  require_one_of("protocol", protocol, {"", "published"});
  require_one_of("loading", loading, {"first", "virgin"});
  require_one_of("weights", weights, {"", "uniform", "relative", "scatter"});
  require_one_of("loss", loss, {"squared", "huber", "cauchy"});
  require_one_of("stress", stress, {"driven", "mean"});
  if (bootstrap != 0 && bootstrap < 2)
    throw InputError("bootstrap", fmt::format("is {}, expected 2 or more, or 0 for none", bootstrap));
  if (P0 && !(*P0 > 0.0)) throw InputError("P0", fmt::format("is {}, expected a positive pressure", *P0));
  if (P0 && window) throw InputError("P0", "cannot be combined with window: expected one of them");
  ConsolidationArguments arguments;
  arguments.law = law;
  arguments.protocol = protocol;
  if (window) arguments.window = {window->first, window->second};
  arguments.P0 = P0.value_or(0.0);
  arguments.loading = loading;
  arguments.weights = weights;
  arguments.loss = loss;
  arguments.n_bootstrap = bootstrap;
  arguments.seed = seed;
  arguments.stress = stress;
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    const ConsolidationOptions options = consolidation_options(arguments);
    const OedometerPressure oedometer = stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven;
    std::vector<ConsolidationSample> read;
    for (const PathTable& path : tables_of(inputs, {"P_star"}, oedometer))
      read.push_back(consolidation_sample(path, arguments));
    Json array = Json::array();
    for (const ConsolidationSample& sample : with_pooled(std::move(read), options.hold_P0))
      array.push_back(as_json(sample, fit_of(sample, arguments, options), arguments));
    return array;
  }));
}

py::object preconsolidation(const py::list& samples, const ColumnNames& columns) {
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    Json array = Json::array();
    for (const PathTable& path : tables_of(inputs, {"P_star"}))
      for (const ReloadingFit& reloading : preconsolidation_fits(path))
        array.push_back(as_json(path, reloading));
    return array;
  }));
}

py::object elastic(const py::list& samples, const ColumnNames& columns, const std::string& state) {
  const Inputs inputs = inputs_of(samples, columns);
  return to_python(without_gil([&] {
    Json array = Json::array();
    for (const PathTable& path : tables_of(inputs, {"P", "P_star"}))
      for (const ElasticBranch& branch : elastic_branches(path, state)) array.push_back(as_json(path, branch));
    return array;
  }));
}

py::dict cycle(const py::list& samples, const ColumnNames& columns) {
  const Inputs inputs = inputs_of(samples, columns);
  return columns_to_python(without_gil([&] {
    Table table = cycle_table();
    for (const PathTable& path : tables_of(inputs, {"P", "P_star"})) add_cycles(path, table);
    return table;
  }));
}

py::object dynamic_compaction(const std::vector<double>& e, const std::vector<double>& p,
                              const std::vector<double>& sc, const std::vector<double>& se,
                              std::optional<double> p_D, std::optional<double> eta_m,
                              const std::string& plateau, std::optional<double> p_0) {
  require_one_of("plateau", plateau, {"p", "p_crit"});
  for (const auto& [name, array] : {std::pair{"p", &p}, {"sc", &sc}, {"se", &se}})
    if (array->size() != e.size())
      throw InputError(name, fmt::format("has {} values, and e has {}", array->size(), e.size()));
  CompactionReference reference;
  if (p_D) reference.p_D = *p_D;
  if (eta_m) reference.eta_m = *eta_m;
  if (p_0) reference.p_0 = *p_0;
  reference.plateau = plateau == "p" ? PlateauPressure::own : PlateauPressure::critical;
  std::vector<CompactedSample> samples;
  for (std::size_t i = 0; i < e.size(); ++i)
    samples.push_back(compacted_sample(fmt::format("sample {}", i), e[i], p[i], sc[i], se[i]));
  return to_python(
      without_gil([&] { return as_json("arrays", fit_dynamic_compaction(samples, reference), reference); }));
}

py::object force_distribution(const std::string& name, const std::vector<double>& forces,
                              const std::string& form, std::optional<double> threshold,
                              std::optional<int> draws, std::optional<std::uint64_t> seed) {
  require_one_of("form", form, {"all", "tails", "power-exponential", "quadratic-exponential"});
  ForceDistributionArguments arguments;
  arguments.form = form;
  arguments.has_threshold = threshold.has_value();
  arguments.threshold = threshold.value_or(0.0);
  if (draws) arguments.options.n_draws = *draws;
  if (seed) arguments.options.seed = *seed;
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
             py::arg("weights"), py::arg("loss"), py::arg("bootstrap"), py::arg("seed"), py::arg("stress"));
  module.def("fit_preconsolidation", &preconsolidation, py::arg("samples"), py::kw_only(), py::arg("columns"));
  module.def("fit_elastic", &elastic, py::arg("samples"), py::kw_only(), py::arg("columns"), py::arg("state"));
  module.def("fit_cycle", &cycle, py::arg("samples"), py::kw_only(), py::arg("columns"));
  module.def("fit_dynamic_compaction", &dynamic_compaction, py::arg("e"), py::arg("p"), py::arg("sc"),
             py::arg("se"), py::kw_only(), py::arg("p_D"), py::arg("eta_m"), py::arg("plateau"),
             py::arg("p_0"));
  module.def("fit_force_distribution", &force_distribution, py::arg("name"), py::arg("forces"), py::kw_only(),
             py::arg("form"), py::arg("threshold"), py::arg("draws"), py::arg("seed"));
}

}  // namespace floc::python
