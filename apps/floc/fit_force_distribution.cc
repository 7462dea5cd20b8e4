#include <spdlog/spdlog.h>

#include <memory>

#include "fit_commands.h"
#include "floc/io/state_file.h"
#include "output.h"
#include "table_fits.h"

namespace floc {
namespace {

/// Normal forces of a table, or of the contacts of a state.
std::vector<double> read_forces(const std::string& file, const ColumnNames& columns) {
  std::vector<double> forces;
  if (file.ends_with(".h5")) {
    std::visit(
        [&forces](const auto& state) {
          for (const auto& contact : state.packing.contacts) forces.push_back(contact.normal_force);
        },
        read_state(file));
    return forces;
  }
  const CsvTable table = CsvTable::read(file);
  const int column = find_column(table, columns, "normal_force").index;
  for (int i = 0; i < table.n_rows(); ++i) forces.push_back(table.number(i, column));
  return forces;
}

int fit_inputs(const ForceDistributionArguments& arguments) {
  const ColumnNames columns = parse_column_names(arguments.columns, {"normal_force"});
  Json array = Json::array();
  Table table{{"sample", "form", "parameter", "value", "stderr", "low95", "high95", "identified", "n_points",
               "unit_force", "log_likelihood", "ks", "p_value"},
              {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const std::string name = file == "-" ? "stdin" : file;
    const std::vector<double> forces = read_forces(file, columns);
    const std::vector<ForceFit> fits = fit_forms(forces, arguments);
    int worst = kDone;
    for (const ForceFit& fit : fits) {
      array.push_back(as_json(name, forces, fit));
      if (!fit.found()) {
        spdlog::warn("{}: {}: no fit: {}", name, fit.form, fit.refusal);
        worst = worse(worst, kNotConverged);
        continue;
      }
      if (fit.p_value < 0.05)
        spdlog::warn("{}: {}: warning: these forces do not follow this form (p = {:.3g})", name, fit.form,
                     fit.p_value);
      for (const FittedParameter& p : fit.parameters) {
        std::vector<TableValue> row = {name, fit.form, p.name};
        for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
        for (const TableValue& cell : std::vector<TableValue>{std::int64_t{fit.n}, fit.mean, fit.log_likelihood,
                                                              fit.distance, fit.p_value})
          row.push_back(cell);
        table.rows.push_back(std::move(row));
      }
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), arguments.format);
  return code;
}

}  // namespace

Command add_fit_force_distribution(CommandLine fit) {
  auto arguments = std::make_shared<ForceDistributionArguments>();
  CommandLine app = fit.add_subcommand(
      "force-distribution", "distributions of normal forces, by maximum likelihood, with goodness of fit");
  app.add_option("INPUT", arguments->inputs,
                 "tables with a column normal_force, or state files (.h5); - is stdin")
      .required();
  app.add_option(
         "--form", arguments->form,
         "tails (exponential, of both signs), power-exponential, quadratic-exponential (of the compressive "
         "forces) or all [all]")
      .one_of({"all", "tails", "power-exponential", "quadratic-exponential"});
  const Option threshold =
      app.add_option("--threshold", arguments->threshold,
                     "magnitude of the force at which the tails begin [the mean of the forces of that sign]")
          .non_negative();
  app.add_option("--draws", arguments->options.n_draws, "samples drawn from the fit for its p-value [200]")
      .within(ForceFitOptions::kDraws);
  app.add_option("--seed", arguments->options.seed, "seed of these draws [1]");
  add_columns_option(app, arguments->columns, "normal_force");
  add_format_option(app, arguments->format);
  return {app, [arguments, threshold] {
            arguments->has_threshold = threshold.count() > 0;
            return fit_inputs(*arguments);
          }};
}

}  // namespace floc
