#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A change of one key of a scene, like the option `--set key=value` of `floc run`.
struct SceneChange {
  std::string key;
  std::string value;  ///< value in the notation of TOML
  std::string place;  ///< "FILE:LINE" in the campaign file, for messages

  std::string text() const { return key + "=" + value; }
};

/// Choice of states of a run, as given in a campaign file: all states, the last state, the states with given numbers,
/// or the states at given pressures.
struct StateChoice {
  enum Kind { all, last, steps, pressures };
  Kind kind = all;
  std::vector<int> numbers;  ///< numbers of the chosen states, if `kind` is `steps`
  /// branch of the load path that contains the states, if `kind` is `pressures`; empty: any branch
  std::string branch;
  std::vector<double> P_star;  ///< reduced imposed pressures of the states, if `kind` is `pressures`
  /// whether the values in `P_star` are stresses on the driven axis; if not, they are pressures on all axes
  bool is_driven = false;
  std::string place;  ///< "FILE:LINE" in the campaign file, for messages
};

/// A case of a campaign: the scene of the campaign with changed values of some keys. Each case is run with every seed.
struct CampaignCase {
  std::string label;  ///< name of the directory of the case; consists of letters, digits and "_=.+-"
  std::vector<SceneChange> changes;
  std::string place;  ///< "FILE:LINE" in the campaign file, for messages
};

/// Part of the results of a campaign: columns of one table, collected from every run for chosen states of the run.
struct Collection {
  std::string table;  ///< name of the table: path, moduli, network, structure or compare
  std::vector<std::string> columns;
  std::vector<std::string> options;  ///< options of the command that makes the table
  StateChoice states;
  StateChoice before;  ///< only for the table compare: the single state with which `states` are compared
  std::string place;   ///< "FILE:LINE" in the campaign file, for messages
};

/// A law that the command `floc fit LAW` fits to the load paths of the runs of each case.
struct CampaignFit {
  std::string law;
  std::vector<std::string> options;
  std::string place = {};  ///< "FILE:LINE" in the campaign file, for messages
};

/// A reference value for one result of the campaign. The result is compared with this value.
struct Reference {
  std::string quantity;  ///< name of the result: a collected column, or a parameter of a fit
  std::string fit;       ///< law of which `quantity` is a parameter; empty if `quantity` is a column
  /// keys of the scene with values; cases with these values are compared. Empty: all cases
  std::vector<SceneChange> when;
  StateChoice state;  ///< state at which a column is compared
  double value = 0.0;
  /// Standard deviation of the reference samples; if `n_samples` is 1, standard error of `value`.
  double deviation = 0.0;
  int n_samples = 1;
  std::string source;
  std::string place;  ///< "FILE:LINE" in the campaign file, for messages
};

/// Cost and errors that floc plan has predicted for a campaign, see floc/planning/plan.h.
struct PlanPromise {
  std::string settings;       ///< name of the numerical settings in the table of prices, such as "patience 0.2"
  std::string prices;         ///< source of the prediction: a table of prices, or a pilot run
  double core_seconds = 0.0;  ///< processor time of all runs (s)
  /// Names of observables, each with the predicted relative error of its value: half the width of the 95 % confidence
  /// interval, divided by the value. The value is a mean over states and samples, or the result of a fit.
  std::vector<std::pair<std::string, double>> errors;
};

/// A campaign: runs of one scene, one run for each case and seed. A case changes the values of some keys of the scene.
struct Campaign {
  std::string name;
  std::string scene_file;
  std::string scene;  ///< text of the scene file
  std::vector<std::uint64_t> seeds;
  /// Keys of the scene that differ between cases, in the order of the campaign file.
  std::vector<std::string> keys;
  std::vector<CampaignCase> cases;
  std::vector<Collection> collections;
  std::vector<CampaignFit> fits;
  std::vector<Reference> references;
  std::optional<PlanPromise> promise;  ///< absent if floc plan has not written the campaign file
};

/// Returns the value that a case gives to a key of the scene, in the notation of TOML; empty if the case does not
/// change this key.
inline std::string value_of(const CampaignCase& one, const std::string& key) {
  std::string value;
  for (const SceneChange& change : one.changes)
    if (change.key == key) value = change.value;
  return value;
}

}  // namespace floc
