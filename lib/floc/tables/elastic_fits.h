#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/elastic_line.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "floc/tables/state_moduli.h"

namespace floc {

/// One unloading branch and its elastic line.
struct ElasticBranch {
  Loading branch;
  Loading fitted;  ///< points that were fitted: the whole branch, or the straight part of a curved one
  ElasticFit fit;
  std::optional<StateModuli> state;  ///< moduli of a state, to compare with the fit
  /// Line against the driven stress, whose modulus is M; only for branches of an oedometer.
  std::optional<ElasticFit> driven = {};
  Loading driven_fitted = {};  ///< points of that line

  /// Returns the parameters of `fit`, then M of `driven`.
  std::vector<FittedParameter> parameters() const;
  /// Returns the warnings of both fits; those of `driven` name M.
  std::vector<std::string> warnings() const;
};

/// Fits all unloading branches of a path; returns none if the pressure never falls. B is fitted against the mean
/// stress, M against the driven stress.
/// @param path   path that was read with OedometerPressure::mean
/// @param state  state file to compare with. If it is empty, the state of the first row of each branch is taken, or of
/// the middle row of the straight part of a curved branch, if its file lies beside the table
std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state);

/// Returns the root mean square distance of ln Phi from the elastic line of a state. The line is drawn against the mean
/// stress and has the slope 1/B_S, or 1/B_uniaxial in an oedometer.
double distance_from(const StateModuli& state, const ConsolidationCurve& branch);

/// Returns the table of `floc fit elastic`, without rows.
Table elastic_table();
/// Adds a row for each parameter of the fit of a branch, and for each modulus of the state beside it.
void add_rows(const PathTable& path, const ElasticBranch& branch, Table& table);

/// Returns a fit as `--format json` prints it.
Json as_json(const PathTable& path, const ElasticBranch& branch);

}  // namespace floc
