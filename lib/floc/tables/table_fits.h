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

/// Fits of `floc fit`, with their tables and json objects. Fits of the consolidation law and of elastic moduli are
/// declared in other headers.
namespace floc {

/// A reloading branch of a load path, or its first loading, and the preconsolidation pressure fitted to it.
struct ReloadingFit {
  Reloading branch;  ///< fitted branch; for a first loading, `largest_before` is 0
  PreconsolidationFit fit;

  bool is_first_loading() const { return branch.largest_before == 0.0; }
};
/// Fits a preconsolidation pressure to branches of a load path.
/// @param branch  keyword: "reloading", "first" (the first loading, up to the point at which the curve bends towards
/// the densest state), or "all". Empty: the reloading branches or, if there are none, the first loading
std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path, const std::string& branch = "");
/// Returns the table of `floc fit preconsolidation`, with its columns and without rows.
Table preconsolidation_table();
/// Adds a row for each fitted parameter to the table of `floc fit preconsolidation`.
void add_rows(const PathTable& path, const ReloadingFit& reloading, Table& table);
/// Returns a fit as the json object that `floc fit preconsolidation --format json` prints.
Json as_json(const PathTable& path, const ReloadingFit& reloading);

/// Returns the table of `floc fit cycle`, with its columns and without rows.
Table cycle_table();
/// Adds the rows of all pressure cycles of a load path to the table of `floc fit cycle`. @return number of cycles
int add_cycles(const PathTable& path, Table& table);

/// Returns the main source of the standard error of a parameter in the law of dynamic compaction: "samples" (too few
/// samples), "law" (misfit of the law) or "plateau" (choice of the samples that count as not lying on the plateau of
/// the law).
/// @param parts  parts of this standard error
const char* limit_of(const CompactionErrorParts& parts);
/// Returns a sample of dynamic compaction: its void ratio e, pressure p, cohesion sc = f_c/d^2 and stiffness
/// se = k_n/d. Here f_c is the cohesive force and k_n the normal stiffness of the contacts, and d is the diameter of
/// the grains. The quantities p, sc and se are stresses in one unit.
/// @param place  place of the sample in the table (file and line), for messages
/// @throws InputError unless all values are positive
CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se);
/// Returns the table of `floc fit dynamic-compaction`, with its columns and without rows.
Table compaction_table();
/// Adds a row for each fitted parameter to the table of `floc fit dynamic-compaction`.
/// @param name  name of the fitted samples: the file from which they were read
void add_rows(const std::string& name, const CompactionFit& fit, Table& table);
/// Returns a fit as the json object that `floc fit dynamic-compaction --format json` prints.
Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference);

/// Options for fitting distributions to forces. The member `form` contains a keyword of `floc fit force-distribution
/// --form`.
struct ForceDistributionOptions {
  std::string form = "all";
  /// Magnitude of the force at which the exponential tails begin (force). If absent, the tail of the positive forces
  /// begins at their mean, and the tail of the negative forces at their mean magnitude.
  std::optional<double> threshold;
  ForceFitOptions fit;
};

/// Fits the distributions that the option `form` selects to normal forces. The keyword "all" selects four: exponential
/// tails of the positive and of the negative forces, if these occur, and the distributions "power-exponential" and
/// "quadratic-exponential" of the compressive forces.
std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionOptions& options);
/// Returns the table of `floc fit force-distribution`, with its columns and without rows.
Table force_table();
/// Adds a row for each fitted parameter to the table of `floc fit force-distribution`.
/// @param name  name of the sample of forces: the file from which they were read
void add_rows(const std::string& name, const ForceFit& fit, Table& table);
/// Returns a fit as the json object that `floc fit force-distribution --format json` prints.
Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit);

}  // namespace floc
