#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A change of a scene, as `floc run --set key=value` makes it.
struct SceneChange {
  std::string key;
  std::string value;  ///< value in the notation of TOML
  std::string place;  ///< file and line of the campaign

  std::string text() const { return key + "=" + value; }
};

/// Selection of states of a run.
struct StateChoice {
  enum Kind { all, last, steps, pressures };
  Kind kind = all;
  std::vector<int> numbers;    ///< numbers of the steps, for `steps`
  std::string branch;          ///< branch of the load path, for `pressures`; empty: any
  std::vector<double> P_star;  ///< reduced imposed pressures, for `pressures`
  std::string place;           ///< file and line, for messages
};

/// One changed scene, run with every seed.
struct CampaignCase {
  std::string label;  ///< letters, digits and "_=.+-": the name of its directory
  std::vector<SceneChange> changes;
  std::string place;  ///< file and line, for messages
};

/// Columns of a table that are collected at some states of every run.
struct Collection {
  std::string table;  ///< path, moduli, network, structure or compare
  std::vector<std::string> columns;
  std::vector<std::string> options;  ///< options of the command that makes the table
  StateChoice states;
  StateChoice before;  ///< the one state that `states` are compared with, for compare
  std::string place;   ///< file and line, for messages
};

/// A fit of the paths of each case: `floc fit LAW`.
struct CampaignFit {
  std::string law;
  std::vector<std::string> options;
};

/// A reference value that results of the campaign are compared with.
struct Reference {
  std::string quantity;           ///< column collected, or parameter of a fit
  std::string fit;                ///< law of the fit; empty: a column
  std::vector<SceneChange> when;  ///< values of keys in the cases that it applies to; empty: all
  StateChoice state;              ///< state of a column
  double value = 0.0;
  double deviation = 0.0;  ///< standard deviation of its samples; for one sample, its standard error
  int n_samples = 1;
  std::string source;
  std::string place;  ///< file and line, for messages
};

/// Runs of one scene: each case changes values of some keys, and has one sample per seed.
struct Campaign {
  std::string name;
  std::string scene_file;
  std::string scene;  ///< text of the scene file
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> keys;  ///< keys that differ between cases, in the order of the file
  std::vector<CampaignCase> cases;
  std::vector<Collection> collections;
  std::vector<CampaignFit> fits;
  std::vector<Reference> references;
};

/// Returns the value of a key in a case, as TOML writes it; empty if the case keeps the value of the scene.
inline std::string value_of(const CampaignCase& one, const std::string& key) {
  std::string value;
  for (const SceneChange& change : one.changes)
    if (change.key == key) value = change.value;
  return value;
}

}  // namespace floc
