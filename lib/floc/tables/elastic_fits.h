#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/elastic_line.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "floc/tables/state_moduli.h"

namespace floc {

/// One branch of falling pressure and its elastic line.
struct ElasticBranch {
  Loading branch;
  Loading fitted;  ///< the points that were fitted: all of them, or the straight part of a curved one
  ElasticFit fit;
  std::optional<StateModuli> state;  ///< to compare with
  /// Of a branch of an oedometer, the line against the driven stress, whose modulus is M, and its points.
  std::optional<ElasticFit> driven = {};
  Loading driven_fitted = {};

  /// Those of `fit`, then M of `driven`.
  std::vector<FittedParameter> parameters() const;
  /// Of both fits, those of M by that name.
  std::vector<std::string> warnings() const;
};

/// The fits of all unloading branches of a path; none where the pressure falls nowhere. B is fitted to the mean
/// stress, M to the driven one.
/// @param path    with OedometerPressure::mean
/// @param state  file to compare with; empty: that of the branch's first row, of a curved one that of the middle
/// row of its straight part, if it lies beside the table
std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state);

/// Root mean square distance of ln Phi from the line of a state: against the mean stress with B_S, in an oedometer with
/// what the strain of one axis makes of it.
double distance_from(const StateModuli& state, const ConsolidationCurve& branch);

/// The table of `floc fit elastic`, without rows.
Table elastic_table();
/// Adds a row for each parameter of the fit of a branch, and for each modulus of the state beside it.
void add_rows(const PathTable& path, const ElasticBranch& branch, Table& table);

/// A fit as `--format json` prints it.
Json as_json(const PathTable& path, const ElasticBranch& branch);

}  // namespace floc
