#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/compression_fits.h"
#include "floc/tables/consolidation_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct CompressionArguments {
  std::vector<std::string> inputs;
  CompressionFitOptions fit;
  std::string phi_limit = "1";
  std::string columns;
  Printing printing;
};

/// Prints on stderr the ranking of the laws, why some laws could not be fitted, and the warnings about the fits.
/// @return kNotConverged if no law could be fitted
int log_fits(const PathTable& path, const CompressedPath& compressed) {
  std::vector<std::string> ranks;
  for (const CompressionFit& fit : compressed.fits)
    if (fit.found()) ranks.push_back(fmt::format("{} {:.4g}", name_of(fit.law), fit.delta_aicc));
  if (ranks.size() > 1)
    spdlog::info(
        "{}: laws in the order of Akaike's criterion AICc, each with the difference of its "
        "AICc from the smallest AICc: {} (the order assumes independent errors of the solid "
        "fraction; the first law describes these rows best, but need not be right)",
        path.name, fmt::join(ranks, ", "));
  for (const CompressionFit& fit : compressed.fits) {
    if (!fit.found())
      spdlog::warn("{}: the law {} cannot be fitted: {}", path.name, name_of(fit.law), fit.failure_reason);
    for (const std::string& warning : fit.warnings)
      spdlog::warn("{}: warning: law {}: {}", path.name, name_of(fit.law), warning);
  }
  return ranks.empty() ? kNotConverged : kDone;
}

int fit_tables(CompressionArguments arguments) {
  arguments.fit.fit.phi_limit = phi_limit_of(arguments.phi_limit);
  Printing printing = arguments.printing;
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"}, printing);
  Json array = Json::array();
  Table table = compression_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path =
        read_path(file, columns, {"P_star", "P"}, OedometerPressure::driven, arguments.fit.phi_limit());
    log_notes(path);
    const CompressedPath compressed = compression_fits(path, arguments.fit);
    for (const CompressionFit& fit : compressed.fits)
      array.push_back(as_json(path, compressed, fit, arguments.fit));
    add_rows(path, compressed, table);
    return log_fits(path, compressed);
  });
  constexpr std::size_t kOfParameters = 12;
  print_fit(array, table, kOfParameters, printing);
  return code;
}

std::vector<std::string> words_for_laws() {
  std::vector<std::string> words = {"all"};
  for (const NamedCompressionLaw& named : compression_laws()) words.emplace_back(named.name);
  return words;
}

}  // namespace

Command add_fit_compression(CommandLine fit) {
  auto arguments = std::make_shared<CompressionArguments>();
  CommandLine app = fit.add_subcommand(
      "compression",
      "fit the laws of powder compression: Heckel, Kawakita, Cooper-Eaton, Walker, Gurnham, Adams");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with the columns P (pressure) or P_star (reduced pressure), and phi (solid fraction) or "
         "void_ratio; or directories of `floc run`; - for a table on stdin")
      .required();
  app.add_option("--law", arguments->fit.law,
                 "law to fit: heckel, kawakita, cooper-eaton, walker, gurnham, adams, or all [all]")
      .one_of(words_for_laws());
  app.add_option(
         "--density", arguments->fit.density,
         "state in which the density was measured: out-of-die (of the ejected tablet) or in-die (under load, "
         "where elastic strain may take the solid fraction beyond 1, so that --phi-limit does not apply) "
         "[out-of-die]")
      .one_of({"out-of-die", "in-die"});
  app.add_option("--D0", arguments->fit.fit.D0,
                 "solid fraction D0 of the powder without pressure, for the laws that have it [fitted]")
      .positive();
  // The value of --phi-limit is read as text, because it may be the word none. phi_limit_of() converts this text after
  // the parsing.
  app.add_option("--phi-limit", arguments->phi_limit,
                 "largest solid fraction to which a law may tend at high pressure, or none for no bound [1]");
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
