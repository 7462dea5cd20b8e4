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
  /// Points that were fitted: all points of the branch or, if the branch is curved, the points of its straight part.
  Loading fitted;
  ElasticFit fit;
  std::optional<StateModuli> state;  ///< moduli of a saved state, with which the fit is compared
  /// Fit of the modulus M against the stress on the driven axis; only for branches of an oedometer test.
  std::optional<ElasticFit> driven = {};
  Loading driven_fitted = {};  ///< points to which `driven` was fitted

  /// Returns the parameters of `fit` and, if `driven` exists, the modulus M of `driven`.
  std::vector<FittedParameter> parameters() const;
  /// Returns the warnings of `fit` and `driven`. The warnings of `driven` begin with the words "fit of the modulus M".
  std::vector<std::string> warnings() const;
};

/// Fits elastic lines to all unloading branches of a load path: the bulk modulus B against the mean stress and, in an
/// oedometer test, also the modulus M against the stress on the driven axis. Each fit is compared with the moduli of a
/// saved state.
/// @param path   load path, read with OedometerPressure::mean
/// @param state  file of the saved state. If `state` is empty, each branch is compared with the state named in the
/// first row of the branch or, if the branch is curved, in the middle row of its straight part. If the file of that
/// state is not in the directory of the table, the branch is not compared with a state
std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state);

/// Returns the distance of an unloading branch from the elastic line of a saved state: the root mean square difference
/// of ln Phi, where Phi is the solid fraction. The elastic line, ln Phi as a function of the mean stress, passes
/// through the point of the state. Its slope is 1/B_S or, in an oedometer test, 1/B_uniaxial; these moduli belong to
/// the state.
double distance_from(const StateModuli& state, const ConsolidationCurve& branch);

/// Returns the table of `floc fit elastic`, with its columns and without rows.
Table elastic_table();
/// Adds a row for each parameter fitted to a branch, and for each modulus of the state with which the branch is
/// compared.
void add_rows(const PathTable& path, const ElasticBranch& branch, Table& table);

/// Returns the fit of a branch as the json object that `floc fit elastic --format json` prints.
Json as_json(const PathTable& path, const ElasticBranch& branch);

}  // namespace floc
