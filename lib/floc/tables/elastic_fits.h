#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/elastic_line.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "floc/tables/state_moduli.h"

namespace floc {

/// An unloading branch of a load path and the elastic line fitted to it.
struct ElasticBranch {
  Loading branch;
  Loading fitted;  ///< points that were fitted: the whole branch, or the straight part of a curved branch
  ElasticFit fit;
  std::optional<StateModuli> state;  ///< moduli of a saved state, to compare with the fit
  /// Fit against the stress on the driven axis, whose modulus is M; only for branches of an oedometer test.
  std::optional<ElasticFit> driven = {};
  Loading driven_fitted = {};  ///< points of the branch that were fitted in `driven`

  /// Returns the parameters of `fit`, followed by the modulus M of `driven`.
  std::vector<FittedParameter> parameters() const;
  /// Returns the warnings of both fits; the warnings of `driven` begin with the name of the modulus M.
  std::vector<std::string> warnings() const;
};

/// Fits elastic lines to all unloading branches of a load path. The bulk modulus B is fitted against the mean
/// stress, the modulus M of an oedometer test against the stress on the driven axis.
/// @param path   load path, read with OedometerPressure::mean
/// @param state  state file to compare with the fits. If it is empty, the state of the first row of each branch
/// is used, or of the middle row of the straight part of a curved branch, if its file is in the directory of
/// the table
std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state);

/// Returns the root mean square distance of ln Phi of a branch from the elastic line through a state. The line
/// is a function of the mean stress, with the slope 1/B_S, or 1/B_uniaxial in an oedometer test.
double distance_from(const StateModuli& state, const ConsolidationCurve& branch);

/// Returns the table of `floc fit elastic` without rows.
Table elastic_table();
/// Adds a row for each parameter of the fit of a branch, and for each modulus of the state to compare with.
void add_rows(const PathTable& path, const ElasticBranch& branch, Table& table);

/// Returns the fit of a branch as the json object that `floc fit elastic --format json` prints.
Json as_json(const PathTable& path, const ElasticBranch& branch);

}  // namespace floc
