#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Options of a fit of the consolidation law to paths, by the words of `floc fit consolidation`.
struct ConsolidationFitOptions {
  std::string law = "full";
  std::string protocol;
  std::vector<double> window;
  double P0 = 0.0;
  std::string loading = "first";
  std::string weights;
  std::string loss = "squared";
  int n_bootstrap = 0;
  std::uint64_t seed = 1;
  std::string stress = "driven";
};

/// A named curve with the rows of its table; a mean has none.
struct ConsolidationSample {
  std::string name;
  Loading loading;
  std::vector<PathStep> steps;  ///< of all rows
  std::string unit;             ///< of the pressures
  std::string stress = {};      ///< that of oedometric rows: see PathTable
};

/// A step of a path whose rows are not fitted: its key in json, and in words.
struct LeftOutStep {
  PathStep step;
  const char *key, *description;
};
std::span<const LeftOutStep> left_out_steps();

/// Rows that do `step` and are not fitted.
std::vector<int> left_out(const ConsolidationSample& sample, PathStep step);

/// The first loading of a path, or the virgin one, as the options say.
ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationFitOptions& asked);

/// @throws InputError naming the option at fault
ConsolidationOptions consolidation_options(const ConsolidationFitOptions& asked);

/// What is fitted: each sample and their mean; the published protocol fits the mean alone.
std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled);

/// The fit of one of these. @param options  of all
ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationFitOptions& asked,
                        const ConsolidationOptions& options);

/// Fits the law to paths in one call, as `floc fit consolidation` does: to the mean of all samples where there are
/// several.
/// @param inputs   csv tables with columns P_star and phi or void_ratio, or directories of floc run
/// @param columns  columns of the tables under other names
/// @throws InputError for what is no path or no option
ConsolidationFit consolidation_fit(const std::vector<std::string>& inputs,
                                   const ConsolidationFitOptions& options = {},
                                   const ColumnNames& columns = {});

/// What a smaller error would need: "samples", "points" on the curve, or a clearer end of the "regimes".
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit);

/// The table of `floc fit consolidation`, without rows.
Table consolidation_table(const ConsolidationFitOptions& asked);
/// Adds a row for each parameter of a fit.
void add_rows(const ConsolidationSample& sample, const ConsolidationFit& fit,
              const ConsolidationFitOptions& asked, Table& table);

/// A fit as `--format json` prints it.
Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationFitOptions& asked);

}  // namespace floc
