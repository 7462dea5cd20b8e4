#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/dynamic_compaction.h"
#include "floc/fitting/force_distribution.h"
#include "floc/fitting/preconsolidation.h"
#include "floc/io/table.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

/// Fits to tables, and what `--format json` prints of them.
namespace floc {

/// A reloading branch and its fit.
struct ReloadingFit {
  Reloading branch;
  PreconsolidationFit fit;
};
std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path);
/// The table of `floc fit preconsolidation`, without rows.
Table preconsolidation_table();
/// Adds a row for each parameter of a fit.
void add_rows(const PathTable& path, const ReloadingFit& reloading, Table& table);
Json as_json(const PathTable& path, const ReloadingFit& reloading);

/// The table of `floc fit cycle`, without rows.
Table cycle_table();
/// Adds the rows of a path's cycles of pressure. @return how many
int add_cycles(const PathTable& path, Table& table);

/// What a smaller error would need: more "samples", another "law", or a clearer "plateau".
const char* limit_of(const CompactionErrorParts& parts);
/// A sample of dynamic compaction with void ratio e, p, sc and se.
/// @param place  of its row, for messages  @throws InputError unless all are positive
CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se);
/// The table of `floc fit dynamic-compaction`, without rows.
Table compaction_table();
/// Adds a row for each parameter of a fit. @param name  of its samples
void add_rows(const std::string& name, const CompactionFit& fit, Table& table);
Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference);

/// Options of fits to force distributions, by the words of `floc fit force-distribution`.
struct ForceDistributionOptions {
  std::string form = "all";
  std::optional<double>
      threshold;  ///< magnitude at which tails begin; without it the mean of the forces of a sign
  ForceFitOptions fit;
};

/// Tails of both signs if there are tensions, the forms of compressive networks if there are none; or the form
/// asked for.
std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionOptions& options);
/// The table of `floc fit force-distribution`, without rows.
Table force_table();
/// Adds a row for each parameter of a fit. @param name  of the forces
void add_rows(const std::string& name, const ForceFit& fit, Table& table);
Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit);

}  // namespace floc
