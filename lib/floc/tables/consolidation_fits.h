#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Options of a fit of the consolidation law to paths, as keywords of `floc fit consolidation`.
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

/// A named curve with the rows of its table; the mean of several samples has no rows.
struct ConsolidationSample {
  std::string name;
  Loading loading;
  std::vector<PathStep> steps;  ///< steps of all rows
  std::string unit;             ///< unit of the pressures; empty if the table names none
  std::string stress = {};      ///< stress that is the pressure of oedometric rows: see PathTable::stress
};

/// A kind of step whose rows are not fitted, with its key in json and its description in messages.
struct LeftOutStep {
  PathStep step;
  const char *key, *description;
};
/// Returns all kinds of steps whose rows are not fitted.
std::span<const LeftOutStep> left_out_steps();

/// Returns the indices of the rows that are not fitted because their step is of this kind.
std::vector<int> left_out(const ConsolidationSample& sample, PathStep step);

/// Returns the first loading of a path or its virgin loading, as the option `loading` says.
ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationFitOptions& asked);

/// Converts keywords to the options of fit_consolidation(). @throws InputError naming the option at fault
ConsolidationOptions consolidation_options(const ConsolidationFitOptions& asked);

/// Returns the curves to fit: each sample and, behind them, their mean. The published protocol fits the mean alone.
std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled);

/// Fits one of the samples. @param options  options that all samples share
ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationFitOptions& asked,
                        const ConsolidationOptions& options);

/// Fits the law to paths in one call, as `floc fit consolidation` does. Several samples are fitted by their mean.
/// @param inputs   csv tables with columns P_star and phi or void_ratio, or directories of floc run
/// @param columns  columns of the tables under other names
/// @throws InputError if an input is no path or an option is not valid
ConsolidationFit consolidation_fit(const std::vector<std::string>& inputs,
                                   const ConsolidationFitOptions& options = {},
                                   const ColumnNames& columns = {});

/// Names the part that limits the error of a fit: the number of "samples" or of "points" on the curve, or the ends of
/// its "regimes".
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit);

/// Returns the table of `floc fit consolidation`, without rows.
Table consolidation_table(const ConsolidationFitOptions& asked);
/// Adds a row for each parameter of a fit.
void add_rows(const ConsolidationSample& sample, const ConsolidationFit& fit,
              const ConsolidationFitOptions& asked, Table& table);

/// Returns a fit as `--format json` prints it.
Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationFitOptions& asked);

}  // namespace floc
