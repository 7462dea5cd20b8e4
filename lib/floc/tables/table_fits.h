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
/// Fits every reloading branch of a path.
std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path);
/// Returns the table of `floc fit preconsolidation`, without rows.
Table preconsolidation_table();
/// Adds a row for each parameter of a fit.
void add_rows(const PathTable& path, const ReloadingFit& reloading, Table& table);
/// Returns a fit as `--format json` prints it.
Json as_json(const PathTable& path, const ReloadingFit& reloading);

/// Returns the table of `floc fit cycle`, without rows.
Table cycle_table();
/// Adds a row for each cycle of pressure of a path. @return number of cycles
int add_cycles(const PathTable& path, Table& table);

/// Names the part that limits the error of a fit: the number of "samples", the "law", or the distance of the samples
/// from the "plateau".
const char* limit_of(const CompactionErrorParts& parts);
/// Returns a sample of dynamic compaction with void ratio e, pressure p, and the stresses sc = f_c/d^2 and se = k_n/d.
/// @param place  place of its row, for messages  @throws InputError unless all are positive
CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se);
/// Returns the table of `floc fit dynamic-compaction`, without rows.
Table compaction_table();
/// Adds a row for each parameter of a fit. @param name  name of the samples fitted
void add_rows(const std::string& name, const CompactionFit& fit, Table& table);
/// Returns a fit as `--format json` prints it.
Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference);

/// Options of fits to force distributions, as keywords of `floc fit force-distribution`.
struct ForceDistributionOptions {
  std::string form = "all";
  /// Magnitude at which tails begin (force); default: the mean of the forces of each sign.
  std::optional<double> threshold;
  ForceFitOptions fit;
};

/// Fits the forms that the options name. The form "all" means the exponential tails of each sign that occurs, and the
/// two forms of compressive networks, which are fitted to the compressive forces.
std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionOptions& options);
/// Returns the table of `floc fit force-distribution`, without rows.
Table force_table();
/// Adds a row for each parameter of a fit. @param name  name of the forces
void add_rows(const std::string& name, const ForceFit& fit, Table& table);
/// Returns a fit as `--format json` prints it.
Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit);

}  // namespace floc
