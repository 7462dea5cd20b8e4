#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Parsed text of a scene. It also contains the overrides and the faults of the scene. An override is a value by which
/// the user replaces a value of the scene, with the option "--set key=value". The faults are found while the scene is
/// read.
class SceneSource {
 public:
  /// @param text  text of the scene (TOML)
  /// @param place  name of the scene file, for messages
  /// @param overrides  texts "key.path=value", each of which replaces a value of the scene
  /// @throws InputError if the text is not TOML, or if an override is not of this form or names a table or array item
  /// that the scene does not have
  SceneSource(const std::string& text, std::string place, const std::vector<std::string>& overrides);

  const toml::table& root() const { return root_; }
  toml::table& root() { return root_; }

  /// Returns the place of the value of a key, for messages: "file:line", or "--set key=value" if an override gives it.
  /// @param node  TOML node of the value, or the table in which the key is missing
  std::string place_of(const std::string& key, const toml::node* node) const;

  /// Records a fault of the scene.
  /// @param key  key that the message is about
  /// @param node  TOML node of the value, or the table in which the key is missing
  /// @param problem  message, to which the place is added
  void fault(const std::string& key, const toml::node* node, const std::string& problem);
  /// Records a fault in another file than the scene file, for example in a file of diameters that the scene names.
  /// @param place  name of the other file, with the number of the line; empty if `problem` contains it
  void fault_at(const std::string& place, const std::string& problem);

  /// Whether a fault has been recorded for this key. If the key is a table, faults of keys in the table do not count.
  bool is_faulty(const std::string& key) const;

  /// Returns the number of faults recorded so far.
  std::size_t n_faults() const { return faults_.size(); }

  /// Throws the recorded faults of the scene, if there are any.
  /// @throws InputError with all faults in one message, in the order of the lines of the scene file
  void throw_faults() const;

 private:
  struct Fault {
    unsigned line;  ///< number of the line in the scene file; 0 if the fault is not in this file
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

/// Returns the candidate that is most similar to `key` (with the smallest edit distance), to suggest it in a message;
/// an empty text if there are no candidates.
std::string nearest_key(std::string_view key, const std::vector<std::string>& candidates);

}  // namespace floc
