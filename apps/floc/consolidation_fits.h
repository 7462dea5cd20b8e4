#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit_parameters.h"
#include "fit_tables.h"
#include "floc/fitting/consolidation.h"

namespace floc {

/// What `floc fit consolidation` is asked.
struct ConsolidationArguments {
  std::vector<std::string> inputs;
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
  std::string columns;
  std::string plot;
  std::string format;
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

/// The first loading of a path, or the virgin one, as the arguments say.
ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationArguments& arguments);

/// @throws InputError naming the option at fault
ConsolidationOptions consolidation_options(const ConsolidationArguments& arguments);

/// What is fitted: each sample and their mean; the published protocol fits the mean alone.
std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled);

/// The fit of one of these. @param options  of all
ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationArguments& arguments,
                        const ConsolidationOptions& options);

/// What a smaller error would need: "samples", "points" on the curve, or a clearer end of the "regimes".
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit);

/// A fit as `--format json` prints it.
Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationArguments& arguments);

}  // namespace floc
