#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Options of a fit of the consolidation law to load paths. The members of type string contain keywords of `floc fit
/// consolidation`.
struct ConsolidationFitOptions {
  std::string law = "auto";
  std::string protocol;
  std::vector<double> window;
  double P0 = 0.0;
  /// rows to fit: "first" (first loading) or "virgin" (first loading, and the parts of later loadings above the largest
  /// pressure reached before). Empty: "virgin" if floc chooses the law, otherwise "first"
  std::string loading;
  std::string weights;
  std::string loss = "squared";
  int n_bootstrap = 0;
  std::uint64_t seed = 1;
  std::string stress = "driven";
  double phi_limit = 1.0;  ///< largest solid fraction that a fitted law may approach; infinity for no bound

  /// Whether floc chooses the law from the data. If the option --protocol or --P0 is given, floc fits the full law.
  bool chooses_law() const { return law == "auto" && protocol.empty() && P0 <= 0.0; }
};

/// Consolidation curve of a sample, with the table rows from which it was read; or the mean curve of several samples,
/// which has no rows.
struct ConsolidationSample {
  std::string name;
  Loading loading;
  std::vector<PathStep> steps;  ///< for each row of the table, kind of the step that ends at this row
  std::string unit;             ///< unit of the pressures; empty if the table does not contain it
  /// Stress used as the pressure in rows of oedometer tests: "driven" (on the driven axis) or "mean" (over the axes);
  /// empty if the table has no such rows.
  std::string stress = {};
  std::vector<PathRow> path = {};  ///< rows of the table; empty for the mean of several tables

  /// Returns the points (P*, 1/Phi) of all loops in the table. A loop consists of successive rows of unloading or
  /// reloading and of the row before them. A pair of NaN follows each loop, unless the table ends with the loop.
  std::vector<std::vector<double>> loops() const;
};

/// A kind of step of a load path, such as unloading, whose rows are left out of the fit of the consolidation law. The
/// kind has a key in the json output, and a description for messages.
struct LeftOutStep {
  PathStep step;
  const char *key, *description;
};
/// Returns all kinds of steps whose rows are left out of fits of the consolidation law.
std::span<const LeftOutStep> left_out_steps();

/// Returns the indices of those table rows of a sample that are left out of the fit and at which a step of the given
/// kind ends.
std::vector<int> left_out(const ConsolidationSample& sample, PathStep step);

/// Returns the consolidation curve of a load path. Its points are the rows of the first loading and, if the option
/// `loading` is "virgin", the rows of later loadings at pressures above the largest pressure reached before.
ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationFitOptions& asked);

/// Returns the upper bound of solid fractions from the option --phi-limit: a positive number, or infinity for "none".
/// @throws InputError that names the option if the text is anything else
double phi_limit_of(const std::string& text);

/// Converts the keywords of `floc fit consolidation` to the options of fit_consolidation().
/// @throws InputError that names the option that is not valid
ConsolidationOptions consolidation_options(const ConsolidationFitOptions& asked);

/// Returns the samples to fit: all given samples and, if there are several, their mean as the last element.
/// @param only_pooled  whether only the mean is returned, without the samples
std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled);

/// Returns the smallest and the largest value of lambda over several windows: the fitted window, and windows that begin
/// or end one row earlier or later. Returns nothing if the law has no lambda, or if one of these windows contains no
/// regime II.
std::optional<std::pair<double, double>> range_of_lambda(const ConsolidationFit& fit);

/// Fits the consolidation law to one sample.
/// @param asked    options as keywords. Only `weights` and `P0` are used, because their effect depends on the sample
/// @param options  all other options, from consolidation_options()
ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationFitOptions& asked,
                        const ConsolidationOptions& options);

/// Fits the consolidation law to one load path, or to the mean of several load paths, in a single call, as `floc fit
/// consolidation` does.
/// @param inputs   csv tables with the columns P_star and phi or void_ratio, or directories of floc run
/// @param columns  headers of the columns P_star, phi and void_ratio, if the tables use other headers
/// @throws InputError if an input is not a load path or an option is not valid
ConsolidationFit consolidation_fit(const std::vector<std::string>& inputs,
                                   const ConsolidationFitOptions& options = {},
                                   const ColumnNames& columns = {});

/// Returns the main source of the standard error of a parameter: "samples" (too few samples), "points" (too few points
/// on the curve) or "regimes" (uncertain ends of the regimes).
/// @param parts  parts of this standard error
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit);

/// Returns the table of `floc fit consolidation`, with its columns and without rows.
Table consolidation_table(const ConsolidationFitOptions& asked);
/// Adds a row for each fitted parameter to the table of `floc fit consolidation`.
void add_rows(const ConsolidationSample& sample, const ConsolidationFit& fit,
              const ConsolidationFitOptions& asked, Table& table);

/// Returns a fit as the json object that `floc fit consolidation --format json` prints.
Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationFitOptions& asked);

}  // namespace floc
