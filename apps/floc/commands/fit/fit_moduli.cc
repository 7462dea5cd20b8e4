#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iterator>
#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/modulus_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ModuliArguments {
  std::vector<std::string> inputs;
  ModulusFitOptions fit;
  std::string phi_limit = "1";
  std::string columns;
  Printing printing;
};

/// Prints on stderr why some laws could not be fitted, and the warnings about the fits. @return exit code
int log_laws(const std::vector<ModulusFit>& fits) {
  int code = kDone;
  for (const ModulusFit& fit : fits) {
    const std::string what = fmt::format("{}: {} against {}", fit.sample, fit.modulus,
                                         fit.against == ModulusAgainst::pressure ? "the pressure" : "Phi");
    if (!fit.law.found()) {
      spdlog::warn("{}: no power law can be fitted: {}", what, fit.law.failure_reason);
      code = kNotConverged;
    }
    for (const std::string& warning : fit.law.warnings) spdlog::warn("{}: warning: {}", what, warning);
  }
  return code;
}

int fit_laws(ModuliArguments arguments) {
  arguments.fit.phi_limit = phi_limit_of(arguments.phi_limit);
  Printing printing = arguments.printing;
  std::vector<std::string> names = names_with_densities({"P", "P_star"});
  for (const std::vector<std::string>& moduli : {default_moduli(), arguments.fit.moduli})
    names.insert(names.end(), moduli.begin(), moduli.end());
  const ColumnNames columns = parse_column_names(arguments.columns, names, printing);
  std::vector<ModulusFit> fits;
  int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    ModulusFits found = modulus_fits(file, columns, arguments.fit);
    for (const std::string& note : found.notes) spdlog::info("{}", note);
    const int own = log_laws(found.fits);
    std::move(found.fits.begin(), found.fits.end(), std::back_inserter(fits));
    return own;
  });
  for (ModulusFit& mean : pooled_over_samples(fits)) fits.push_back(std::move(mean));
  Json array = Json::array();
  for (const ModulusFit& fit : fits) array.push_back(as_json(fit));
  const Table table = modulus_table(fits);
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_moduli(CommandLine fit) {
  auto arguments = std::make_shared<ModuliArguments>();
  CommandLine app = fit.add_subcommand(
      "moduli", "fit power laws of elastic moduli against the pressure and against the solid fraction");
  app.add_option("TABLE", arguments->inputs,
                 "tables of floc moduli, or other tables with a pressure, moduli and, for the law of the solid "
                 "fraction, a solid fraction or void_ratio; - for a table on stdin")
      .required();
  app.add_option("--moduli", arguments->fit.moduli,
                 "NAME,...: columns of the moduli to fit [those of B, B_S, G, G_shear, M and E of which the "
                 "table has values]")
      .delimiter(',');
  app.add_option("--branch", arguments->fit.branch,
                 "states to fit: first (those of the first loading of each sample) or all [first]")
      .one_of({"first", "all"});
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns,
                     "P, P_star, phi, void_ratio or another density, B, G or other moduli");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_laws(*arguments); }};
}

}  // namespace floc
