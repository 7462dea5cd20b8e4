#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A change of a scene, as `floc run --set key=value` makes it.
struct SceneChange {
  std::string key;
  std::string value;  ///< as TOML writes it
  std::string place;  ///< file and line where the campaign says so

  std::string text() const { return key + "=" + value; }
};

/// Which states of a run are meant.
struct StateChoice {
  enum Kind { all, last, steps, pressures };
  Kind kind = all;
  std::vector<int> numbers;    ///< of `steps`
  std::string branch;          ///< of `pressures`; empty: any
  std::vector<double> P_star;  ///< of `pressures`: reduced pressures imposed
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
  std::vector<std::string> options;  ///< of the command that makes the table
  StateChoice states;
  StateChoice before;  ///< of compare: the one state that `states` are compared with
  std::string place;   ///< file and line, for messages
};

/// A fit of the paths of each case: `floc fit LAW`.
struct CampaignFit {
  std::string law;
  std::vector<std::string> options;
};

/// A value to compare with.
struct Reference {
  std::string quantity;           ///< column collected, or parameter of a fit
  std::string fit;                ///< its law; empty: a column
  std::vector<SceneChange> when;  ///< values of keys in the cases it applies to; empty: all cases
  StateChoice state;              ///< of a column
  double value = 0.0;
  double deviation = 0.0;  ///< standard deviation between its samples; for one sample, its standard error
  int n_samples = 1;
  std::string source;
  std::string place;  ///< file and line, for messages
};

/// Many runs of one scene: some keys have other values, and every case has one sample per seed.
struct Campaign {
  std::string name;
  std::string scene_file;
  std::string scene;  ///< its text
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> keys;  ///< that differ between cases, in the order of the file
  std::vector<CampaignCase> cases;
  std::vector<Collection> collections;
  std::vector<CampaignFit> fits;
  std::vector<Reference> references;
};

/// The value of a key in a case, as TOML writes it; empty where the case keeps the scene's.
inline std::string value_of(const CampaignCase& one, const std::string& key) {
  std::string value;
  for (const SceneChange& change : one.changes)
    if (change.key == key) value = change.value;
  return value;
}

}  // namespace floc
