#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/io/state_file.h"
#include "floc/tables/table_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ForceDistributionArguments {
  std::vector<std::string> inputs;
  ForceDistributionOptions fit;
  std::string columns;
  Printing printing;
};

/// Reads normal forces: from the column normal_force of a table, or from the contacts of a state file (.h5).
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
  const CsvTable table = CsvTable::read(file, wanted_names({"normal_force"}, columns));
  log_description(table);
  const int column = NamedColumns(table, columns).column("normal_force");
  for (int i = 0; i < table.n_rows(); ++i) forces.push_back(table.number(i, column));
  return forces;
}

int fit_inputs(const ForceDistributionArguments& arguments) {
  Printing printing = arguments.printing;
  const ColumnNames columns = parse_column_names(arguments.columns, {"normal_force"}, printing);
  Json array = Json::array();
  Table table = force_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const std::string name = file == "-" ? "stdin" : file;
    const std::vector<double> forces = read_forces(file, columns);
    const std::vector<ForceFit> fits = fit_forms(forces, arguments.fit);
    int worst = kDone;
    for (const ForceFit& fit : fits) {
      array.push_back(as_json(name, forces, fit));
      if (!fit.found()) {
        spdlog::warn("{}: the distribution {} cannot be fitted to the forces: {}", name, fit.form,
                     fit.failure_reason);
        worst = worse(worst, kNotConverged);
        continue;
      }
      // A distribution that the goodness-of-fit test rejects at the significance level of 5 % is a row of the table
      // like any other. Only this warning tells the user.
      if (fit.p_value < 0.05)
        spdlog::warn(
            "{}: distribution {}: warning: the forces do not follow this distribution (p-value {:.3g})", name,
            fit.form, fit.p_value);
      add_rows(name, fit, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_force_distribution(CommandLine fit) {
  auto arguments = std::make_shared<ForceDistributionArguments>();
  CommandLine app = fit.add_subcommand(
      "force-distribution",
      "fit distributions to normal forces by maximum likelihood, and test the goodness of fit");
  app.add_option("INPUT", arguments->inputs,
                 "tables with the column normal_force, or state files (.h5); - for a table on stdin")
      .required();
  app.add_option("--form", arguments->fit.form,
                 "distribution to fit: tails (exponential tails of the forces of each sign), "
                 "power-exponential or quadratic-exponential (both for the compressive forces), or all [all]")
      .one_of({"all", "tails", "power-exponential", "quadratic-exponential"});
  app.add_option("--threshold", arguments->fit.threshold,
                 "magnitude of the force above which the exponential tails are fitted (force) [the mean of the "
                 "forces of each sign]")
      .non_negative();
  app.add_option("--draws", arguments->fit.fit.n_draws,
                 "number of random samples drawn from the fitted distribution to compute its p-value [200]")
      .within(ForceFitOptions::kDraws);
  app.add_option("--seed", arguments->fit.fit.seed, "seed of the random samples [1]");
  add_columns_option(app, arguments->columns, "normal_force");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_inputs(*arguments); }};
}

}  // namespace floc
