#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
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
  const auto column = [&](const char* name) { return find_column(table, columns, name); };
  const UnitColumn e = column("e"), p = column("p"), sc = column("sc"), se = column("se");
  const auto to_unit_of_p = [&](const UnitColumn& of, const char* name) {
    return unit_factor(fmt::format("{}, column {}", table.place(), name), of.unit, "column p", p.unit);
  };
  const double of_sc = to_unit_of_p(sc, "sc"), of_se = to_unit_of_p(se, "se");
  std::vector<CompactedSample> samples;
  for (int i = 0; i < table.n_rows(); ++i)
    samples.push_back(compacted_sample(table.place(i), table.number(i, e.index), table.number(i, p.index),
                                       of_sc * table.number(i, sc.index), of_se * table.number(i, se.index)));
  return samples;
}

/// Prints on stderr which samples were fitted and the parts of the errors.
void log_fit(const std::string& name, const CompactionFit& fit) {
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", name, warning);
  if (!fit.found()) {
    spdlog::warn("{}: no fit: {}", name, fit.failure_reason);
    return;
  }
  const std::string flagged = fit.beside_plateau.empty()
                                  ? ""
                                  : fmt::format("; beside the plateau: rows {}", ranges(fit.beside_plateau));
  spdlog::info("{}: fitted {} samples, rows {}{}; r.m.s. residual of e {:.3g}", name, fit.used.size(),
               ranges(fit.used), flagged, fit.rms);
  std::vector<std::string> budget;
  for (const CompactionErrorParts& parts : fit.error_parts)
    budget.push_back(fmt::format("{} {:.2g}, {:.2g} and {:.2g} ({})", parts.name, parts.scatter, parts.law,
                                 parts.plateau, limit_of(parts)));
  spdlog::info(
      "{}: errors from {}, from the misfit of the law and from the choice of the samples beside the plateau "
      "(and what limits each): {}",
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
    const CompactionFit fit =
        fit_dynamic_compaction(read_samples(CsvTable::read(file), columns), arguments.reference);
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
  CommandLine app = fit.add_subcommand(
      "dynamic-compaction", "void ratio of dynamically compacted samples against pressure and cohesion");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns e (void ratio), p, sc = f_c/d^2, se = k_n/d, in one unit or with units in their "
         "headers; - is stdin")
      .required();
  CompactionReference& reference = arguments->reference;
  app.add_option("--p-D", reference.p_D, "pressure at which the plateau is e_min + De, in the unit of p [0.01]")
      .positive();
  app.add_option("--eta-m", reference.eta_m, "eta* at which (1 - e_r)/e_r = s_m [0.045]").positive();
  app.add_option("--plateau", arguments->plateau,
                 "pressure at which the plateau e_max is evaluated: p of the sample, or p_crit = sc^2/se, as "
                 "the law is printed; no dense sample then has a plateau, and A and a are not identified [p]")
      .one_of({"p", "p_crit"});
  app.add_option(
         "--p-0", reference.p_0,
         "smallest pressure at which the plateau is fitted [no limit; with --plateau p_crit that of --p-D]")
      .positive();
  add_columns_option(app, arguments->columns, "e, p, sc, se");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] {
            // The keyword is translated here because its variable has a value only after parsing.
            arguments->reference.plateau =
                arguments->plateau == "p" ? PlateauPressure::own : PlateauPressure::critical;
            return fit_tables(*arguments);
          }};
}

}  // namespace floc
