#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A change of one key of a scene, as the option `--set key=value` of `floc run` makes it.
struct SceneChange {
  std::string key;
  std::string value;  ///< value in the notation of TOML
  std::string place;  ///< file and line of the campaign file, for messages

  std::string text() const { return key + "=" + value; }
};

/// A choice of states of a run.
struct StateChoice {
  enum Kind { all, last, steps, pressures };
  Kind kind = all;
  std::vector<int> numbers;    ///< numbers of the chosen states, if `kind` is `steps`
  std::string branch;          ///< branch of the load path, if `kind` is `pressures`; empty: any branch
  std::vector<double> P_star;  ///< reduced imposed pressures of the chosen states, if `kind` is `pressures`
  std::string place;           ///< file and line of the campaign file, for messages
};

/// A scene with some keys changed, which is run with every seed of the campaign.
struct CampaignCase {
  std::string label;  ///< name of its directory; consists of letters, digits and "_=.+-"
  std::vector<SceneChange> changes;
  std::string place;  ///< file and line of the campaign file, for messages
};

/// Columns of a table, which are collected at some states of every run.
struct Collection {
  std::string table;  ///< path, moduli, network, structure or compare
  std::vector<std::string> columns;
  std::vector<std::string> options;  ///< options of the command that makes the table
  StateChoice states;
  StateChoice before;  ///< for the table compare: the single state with which `states` are compared
  std::string place;   ///< file and line of the campaign file, for messages
};

/// A fit of a law to the paths of each case, by the command `floc fit LAW`.
struct CampaignFit {
  std::string law;
  std::vector<std::string> options;
};

/// A reference value, with which a result of the campaign is compared.
struct Reference {
  std::string quantity;           ///< name of a collected column, or of a parameter of a fit
  std::string fit;                ///< law of the fit; empty if `quantity` is a column
  std::vector<SceneChange> when;  ///< keys and values that select the cases to compare; empty: all cases
  StateChoice state;              ///< state at which a column is compared
  double value = 0.0;
  /// Standard deviation of the reference samples; for a single sample its standard error.
  double deviation = 0.0;
  int n_samples = 1;
  std::string source;
  std::string place;  ///< file and line of the campaign file, for messages
};

/// A campaign: runs of one scene. Each case of it changes the values of some keys of the scene and is run with each
/// seed.
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
};

/// Returns the value of a key of the scene in a case, in the notation of TOML; empty if the case does not change this
/// key.
inline std::string value_of(const CampaignCase& one, const std::string& key) {
  std::string value;
  for (const SceneChange& change : one.changes)
    if (change.key == key) value = change.value;
  return value;
}

}  // namespace floc
