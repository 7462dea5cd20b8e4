#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/path_density.h"
#include "floc/tables/table_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct DynamicCompactionArguments {
  std::vector<std::string> inputs;
  CompactionReference reference;
  std::string plateau = "p";
  std::string columns;
  Printing printing;
};

std::vector<CompactedSample> read_samples(const CsvTable& table, const ColumnNames& columns) {
  const NamedColumns named(table, columns);
  const auto column = [&](const char* name) { return named.unit_column(name); };
  const UnitColumn e = column("e"), p = column("p"), sc = column("sc"), se = column("se");
  const auto to_unit_of_p = [&](const UnitColumn& of, const char* name) {
    return unit_factor(fmt::format("{}, column {}", table.place(), name), of.unit, "column p", p.unit);
  };
  const double of_sc = to_unit_of_p(sc, "sc"), of_se = to_unit_of_p(se, "se");
  const double of_e = factor_of_share(named, "e");
  std::vector<CompactedSample> samples;
  for (int i = 0; i < table.n_rows(); ++i)
    samples.push_back(compacted_sample(table.place(i), of_e * table.number(i, e.index),
                                       table.number(i, p.index), of_sc * table.number(i, sc.index),
                                       of_se * table.number(i, se.index)));
  return samples;
}

/// Prints on stderr which samples were fitted, and for each parameter the parts of its standard error.
void log_fit(const std::string& name, const CompactionFit& fit) {
  // The warnings precede the reason of a failure: they may tell that samples are left out, and these samples may be the
  // reason why too few samples remain for a fit.
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", name, warning);
  if (!fit.found()) {
    spdlog::warn("{}: the law of dynamic compaction cannot be fitted: {}", name, fit.failure_reason);
    return;
  }
  const std::string flagged =
      fit.beside_plateau.empty()
          ? ""
          : fmt::format("; rows that are not fitted because their void ratio does not lie on the plateau: {}",
                        ranges(fit.beside_plateau));
  spdlog::info(
      "{}: the law of dynamic compaction was fitted to {} samples, rows {}{}; r.m.s. residual of the void "
      "ratio e {:.3g}",
      name, fit.used.size(), ranges(fit.used), flagged, fit.rms);
  std::vector<std::string> budget;
  // The standard error s of a parameter has three parts with s^2 = s_scatter^2 + s_law^2 + s_plateau^2. limit_of()
  // names the largest part, because s decreases much only if this part decreases.
  for (const CompactionErrorParts& parts : fit.error_parts)
    budget.push_back(fmt::format(
        "{}: {:.2g} from the scatter, {:.2g} from the law and {:.2g} from the choice of the samples "
        "(mainly due to the {})",
        parts.name, parts.scatter, parts.law, parts.plateau, limit_of(parts)));
  spdlog::info(
      "{}: standard errors of the parameters, from {}, from the misfit of the law and from the choice of the "
      "samples that do not lie on the plateau: {}",
      name, fit.errors_from_runs ? "the scatter between repeated runs" : "the residuals",
      fmt::join(budget, "; "));
}

int fit_tables(const DynamicCompactionArguments& arguments) {
  Printing printing = arguments.printing;
  const ColumnNames columns = parse_column_names(arguments.columns, {"e", "p", "sc", "se"}, printing);
  Json array = Json::array();
  Table table = compaction_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const std::string name = file == "-" ? "stdin" : file;
    const CsvTable samples = CsvTable::read(file, wanted_names({"e", "p", "sc", "se"}, columns));
    log_description(samples);
    const CompactionFit fit = fit_dynamic_compaction(read_samples(samples, columns), arguments.reference);
    array.push_back(as_json(name, fit, arguments.reference));
    log_fit(name, fit);
    if (!fit.found()) return static_cast<int>(kNotConverged);
    add_rows(name, fit, table);
    return static_cast<int>(kDone);
  });
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_dynamic_compaction(CommandLine fit) {
  auto arguments = std::make_shared<DynamicCompactionArguments>();
  CommandLine app = fit.add_subcommand("dynamic-compaction",
                                       "fit the law of dynamic compaction: void ratio of compacted samples as "
                                       "a function of pressure and cohesion");
  app.add_option("TABLE", arguments->inputs,
                 "tables with the columns e (void ratio), p (pressure), sc (cohesion f_c/d^2) and se "
                 "(stiffness k_n/d), where p, sc and se are in the same unit or have their units in the "
                 "headers; - for a table on stdin")
      .required();
  CompactionReference& reference = arguments->reference;
  app.add_option("--p-D", reference.p_D,
                 "reference pressure p_D, in the unit of p; the plateau of the void ratio has the value e_min "
                 "+ De at p_D, where e_min and De are fitted parameters [0.01]")
      .positive();
  app.add_option("--eta-m", reference.eta_m,
                 "reference value eta_m of the ratio eta* = sc/sqrt(p se); the fitted parameter s_m is the "
                 "value of (1 - e_r)/e_r at eta_m, where e_r = (e - e_min)/(e_max - e_min) [0.045]")
      .positive();
  app.add_option("--plateau", arguments->plateau,
                 "pressure at which the plateau e_max of the void ratio is evaluated: p (pressure of the "
                 "sample) or p_crit = sc^2/se (as in the published law; dense samples then have no plateau, "
                 "and the parameters A and a are not identified) [p]")
      .one_of({"p", "p_crit"});
  app.add_option("--p-0", reference.p_0,
                 "smallest pressure at which the plateau of a sample may be evaluated; samples with a smaller "
                 "pressure are not fitted [no limit; with --plateau p_crit the value of --p-D]")
      .positive();
  add_columns_option(app, arguments->columns, "e, p, sc, se");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] {
            // The keyword given to --plateau is converted here, because it is known only after the command line has
            // been parsed.
            arguments->reference.plateau =
                arguments->plateau == "p" ? PlateauPressure::own : PlateauPressure::critical;
            return fit_tables(*arguments);
          }};
}

}  // namespace floc
