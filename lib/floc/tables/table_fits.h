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

/// Tables and json objects of the commands `floc fit`.
namespace floc {

/// A reloading branch of a load path and the fit of its preconsolidation pressure.
struct ReloadingFit {
  Reloading branch;
  PreconsolidationFit fit;
};
/// Fits the preconsolidation pressure of every reloading branch of a load path.
std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path);
/// Returns the table of `floc fit preconsolidation` without rows.
Table preconsolidation_table();
/// Adds a row for each parameter of a fit to the table of `floc fit preconsolidation`.
void add_rows(const PathTable& path, const ReloadingFit& reloading, Table& table);
/// Returns a fit as the json object that `floc fit preconsolidation --format json` prints.
Json as_json(const PathTable& path, const ReloadingFit& reloading);

/// Returns the table of `floc fit cycle` without rows.
Table cycle_table();
/// Adds the rows of the pressure cycles of a load path. @return number of cycles
int add_cycles(const PathTable& path, Table& table);

/// Returns the name of the largest part of the error of a parameter: the number of "samples", the misfit of the
/// "law", or the choice of the samples that count as off the "plateau".
const char* limit_of(const CompactionErrorParts& parts);
/// Returns a sample of dynamic compaction with void ratio e, pressure p, and the stresses sc = f_c/d^2 and se = k_n/d.
/// @param place  place of its row, for messages   @throws InputError unless all values are positive
CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se);
/// Returns the table of `floc fit dynamic-compaction` without rows.
Table compaction_table();
/// Adds a row for each parameter of a fit to the table. @param name  name of the samples fitted
void add_rows(const std::string& name, const CompactionFit& fit, Table& table);
/// Returns a fit as the json object that `floc fit dynamic-compaction --format json` prints.
Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference);

/// Options of fits to force distributions, with the keywords of `floc fit force-distribution`.
struct ForceDistributionOptions {
  std::string form = "all";
  /// Magnitude at which the tails begin (force); if absent, the mean magnitude of the forces of each sign.
  std::optional<double> threshold;
  ForceFitOptions fit;
};

/// Fits the laws of force distributions that the options select. The option "all" selects an exponential tail
/// for each sign that occurs, and the two laws for networks in compression, which are fitted to the compressive
/// forces.
std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionOptions& options);
/// Returns the table of `floc fit force-distribution` without rows.
Table force_table();
/// Adds a row for each parameter of a fit to the table. @param name  name of the sample of forces
void add_rows(const std::string& name, const ForceFit& fit, Table& table);
/// Returns a fit as the json object that `floc fit force-distribution --format json` prints.
Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit);

}  // namespace floc
