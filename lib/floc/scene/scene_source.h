#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// A parsed scene text with its overrides, and the faults found while it is read.
class SceneSource {
 public:
  /// @throws InputError if the text is not TOML, or an override is not "key.path=value" or does not fit the
  /// scene's structure.
  SceneSource(const std::string& text, std::string place, const std::vector<std::string>& overrides);

  const toml::table& root() const { return root_; }
  toml::table& root() { return root_; }

  /// Returns "file:line" of a key, or the override that set it.
  std::string place_of(const std::string& key, const toml::node* node) const;

  /// Records a fault. @param node  node that the message is about, or the table that lacks the key
  void fault(const std::string& key, const toml::node* node, const std::string& problem);
  /// Records a fault of another file.
  void fault_at(const std::string& place, const std::string& problem);

  /// Whether a fault of exactly this key was recorded.
  bool is_faulty(const std::string& key) const;

  /// @throws InputError with all faults in the order of the file, if there are any.
  void throw_faults() const;

 private:
  struct Fault {
    unsigned line;  ///< line in the file; 0 without one
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

/// Returns a value as the user would write it, for messages.
std::string as_written(const toml::node& node);

/// Returns the candidate with the smallest edit distance to `key`; empty without candidates.
std::string nearest_key(std::string_view key, const std::vector<std::string>& candidates);

}  // namespace floc
