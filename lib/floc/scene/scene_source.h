#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Parsed text of a scene, with the values that the user replaced (overrides, "--set key=value") and the faults found
/// while it is read.
class SceneSource {
 public:
  /// @throws InputError if the text is not TOML, or if an override is not of the form "key.path=value" or names a table
  /// or array item that the scene does not have
  SceneSource(const std::string& text, std::string place, const std::vector<std::string>& overrides);

  const toml::table& root() const { return root_; }
  toml::table& root() { return root_; }

  /// Returns the place where the value of a key comes from: "file:line", or the override ("--set key=value") that
  /// replaced it.
  std::string place_of(const std::string& key, const toml::node* node) const;

  /// Records a fault of the scene.
  /// @param node  TOML node that the message is about, or the table in which the key is missing
  void fault(const std::string& key, const toml::node* node, const std::string& problem);
  /// Records a fault in a file other than the scene file, for example a file of diameters that the scene names.
  void fault_at(const std::string& place, const std::string& problem);

  /// Whether a fault has been recorded for this key itself; faults of keys below it do not count.
  bool is_faulty(const std::string& key) const;

  /// Throws the recorded faults, if there are any.
  /// @throws InputError with all faults in one message, in the order of the lines of the file
  void throw_faults() const;

 private:
  struct Fault {
    unsigned line;  ///< number of the line in the scene file; 0 if the fault belongs to no line of it
    std::string key;
    std::string message;
  };
  struct Override {
    std::string key;
    std::string text;
  };

  void apply(const std::string& override_text);
  unsigned line_of(const std::string& key, const toml::node* node) const;
  const Override* override_of(const std::string& key) const;

  std::string place_;
  toml::table root_;
  std::vector<Override> overrides_;
  std::vector<Fault> faults_;
};

/// Returns a TOML value as the user would write it, for messages.
std::string as_written(const toml::node& node);

/// Returns the candidate that is most similar to `key` (smallest edit distance), or an empty text if there are no
/// candidates.
std::string nearest_key(std::string_view key, const std::vector<std::string>& candidates);

}  // namespace floc
