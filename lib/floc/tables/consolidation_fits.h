#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Options of a fit of the consolidation law to load paths, with the keywords of `floc fit consolidation`.
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

/// A consolidation curve with its name and the rows of its table. A mean of several samples has no rows.
struct ConsolidationSample {
  std::string name;
  Loading loading;
  std::vector<PathStep> steps;  ///< kinds of the steps of all rows of the table
  std::string unit;             ///< unit of the pressures; empty if the table names none
  /// Stress taken as the pressure of oedometric rows, "driven" or "mean"; empty without such rows.
  std::string stress = {};
};

/// A kind of step of a load path whose rows are not fitted, with its json key and its description in messages.
struct LeftOutStep {
  PathStep step;
  const char *key, *description;
};
/// Returns all kinds of steps whose rows are not fitted.
std::span<const LeftOutStep> left_out_steps();

/// Returns the indices of the rows of a sample that are not fitted because their step is of a given kind.
std::vector<int> left_out(const ConsolidationSample& sample, PathStep step);

/// Returns the curve of a path to fit: the first loading, or also later loading beyond the largest earlier
/// pressure if the option `loading` is "virgin".
ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationFitOptions& asked);

/// Converts keywords to the options of fit_consolidation(). @throws InputError with the name of an option that
/// is not valid
ConsolidationOptions consolidation_options(const ConsolidationFitOptions& asked);

/// Returns the curves to fit: all samples and, if there are several, their mean at the end.
/// @param only_pooled  returns the mean alone
std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled);

/// Fits the consolidation law to one sample. @param options  options that all samples share
ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationFitOptions& asked,
                        const ConsolidationOptions& options);

/// Fits the consolidation law to load paths in one call, as `floc fit consolidation` does. If there are several
/// samples, their mean is fitted.
/// @param inputs   csv tables with the columns P_star and phi or void_ratio, or directories of floc run
/// @param columns  names of these columns in the tables, if they differ
/// @throws InputError if an input is not a load path or an option is not valid
ConsolidationFit consolidation_fit(const std::vector<std::string>& inputs,
                                   const ConsolidationFitOptions& options = {},
                                   const ColumnNames& columns = {});

/// Returns the name of the largest part of the error of a parameter: the number of "samples" or of "points" on
/// the curve, or the uncertain ends of the "regimes".
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit);

/// Returns the table of `floc fit consolidation` without rows.
Table consolidation_table(const ConsolidationFitOptions& asked);
/// Adds a row for each parameter of a fit to the table of `floc fit consolidation`.
void add_rows(const ConsolidationSample& sample, const ConsolidationFit& fit,
              const ConsolidationFitOptions& asked, Table& table);

/// Returns a fit as the json object that `floc fit consolidation --format json` prints.
Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationFitOptions& asked);

}  // namespace floc
