#include "floc/io/law_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

/// Key that names the model of a slot (a component of the contact law, such as friction), as in "friction.law=coulomb".
/// A text needs this key only if the other keys of the slot do not determine the model.
constexpr const char* kLaw = "law";

bool has_key(const DeclaredModel& model, const std::string& key) {
  return model.number(key) != nullptr || std::any_of(model.choices.begin(), model.choices.end(),
                                                     [&](const DeclaredChoice& c) { return c.key == key; });
}

/// Returns all keys of all slots of a contact law ("normal.stiffness", ...), each once.
std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& slot, const std::string& key) {
    const std::string path = slot + "." + key;
    if (std::find(keys.begin(), keys.end(), path) == keys.end()) keys.push_back(path);
  };
  for (const DeclaredSlot& slot : declared_slots())
    for (const DeclaredModel& model : slot.models) {
      for (const DeclaredNumber& n : model.numbers) add(slot.key, n.key);
      for (const DeclaredChoice& c : model.choices) add(slot.key, c.key);
      add(slot.key, kLaw);
    }
  return keys;
}

/// Returns the model of a slot (a component of the contact law, such as friction) that has all the keys in `given`. If
/// several models have these keys, the order of preference is: first, models compatible with the models of the previous
/// slots (`before`); second, models whose numbers are all given. If no model has all the keys, the first model of the
/// slot is returned, so that the caller can report the wrong key. Models without parameters, such as rigid contacts,
/// are never found from keys; the text must name them.
const DeclaredModel& described_model(const DeclaredSlot& slot, const std::vector<std::string>& given,
                                     const LawParameters& before) {
  const auto has_all = [&](const DeclaredModel& m) {
    return std::all_of(given.begin(), given.end(), [&](const std::string& key) { return has_key(m, key); });
  };
  const auto lacks_none = [&](const DeclaredModel& m) {
    return std::all_of(m.numbers.begin(), m.numbers.end(), [&](const DeclaredNumber& n) {
      return std::find(given.begin(), given.end(), n.key) != given.end();
    });
  };
  const auto closeness = [&](const DeclaredModel& m) {
    const bool has_parameters = !m.numbers.empty() || !m.choices.empty();
    return has_parameters && has_all(m) ? 1 + 2 * fits(m, before) + lacks_none(m) : 0;
  };
  return *std::max_element(
      slot.models.begin(), slot.models.end(),
      [&](const DeclaredModel& a, const DeclaredModel& b) { return closeness(a) < closeness(b); });
}

class LawText {
 public:
  LawText(std::string place, std::string_view text) : place_(std::move(place)) {
    while (!trimmed(text).empty()) {
      const std::size_t end = std::min(text.find(','), text.size());
      add(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  bool has(const std::string& key) const { return values_.contains(key); }

  std::string keyword(const std::string& key) const { return values_.at(key); }

  /// Returns the keys that the text gives for a slot, except the key "law". The keys are without the name of the slot,
  /// such as "stiffness" for "normal.stiffness".
  std::vector<std::string> keys_of(const std::string& slot) const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : values_)
      if (key.starts_with(slot + ".") && key != slot + "." + kLaw) keys.push_back(key.substr(slot.size() + 1));
    return keys;
  }

  double number(const std::string& key) const {
    if (!has(key))
      throw InputError(
          place_,
          fmt::format(
              "{} is missing; give all parameters of each component of the contact law (normal, friction, ...)",
              key));
    if (const auto value = parse_number<double>(values_.at(key))) return *value;
    throw InputError(place_, fmt::format("{} = \"{}\", expected a finite number", key, values_.at(key)));
  }

 private:
  void add(std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string key(trimmed(assignment.substr(0, equals)));
    const std::vector<std::string> keys = all_keys();
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw InputError(place_, fmt::format("\"{}\" is not a parameter of a contact law; the parameters are {}",
                                           key, fmt::join(keys, ", ")));
    if (equals == std::string_view::npos)
      throw InputError(place_, fmt::format("{} has no value, expected {}=...", key, key));
    if (!values_.emplace(key, trimmed(assignment.substr(equals + 1))).second)
      throw InputError(place_, fmt::format("the parameter {} is given twice", key));
  }

  std::string place_;
  std::map<std::string, std::string> values_;
};

int keyword_index(const std::string& place, const LawText& given, const std::string& key,
                  const std::vector<std::string>& keywords) {
  const auto found = std::find(keywords.begin(), keywords.end(), given.keyword(key));
  if (found != keywords.end()) return static_cast<int>(found - keywords.begin());
  throw InputError(
      place, fmt::format("{} = \"{}\", expected {}", key, given.keyword(key), fmt::join(keywords, " or ")));
}

const DeclaredModel& model_given(const std::string& place, const LawText& given, const DeclaredSlot& slot,
                                 const std::vector<std::string>& keys, const LawParameters& before) {
  const std::string name = slot.key + "." + kLaw;
  std::vector<std::string> keywords;
  for (const DeclaredModel& m : slot.models) keywords.push_back(m.keyword);
  const DeclaredModel& model = given.has(name) ? slot.models[keyword_index(place, given, name, keywords)]
                                               : described_model(slot, keys, before);
  // The keys need this check even if they have determined the model: if no model of the slot has all of them,
  // described_model() returns the first model.
  for (const std::string& key : keys)
    if (!has_key(model, key))
      throw InputError(place, fmt::format("{}.{} is given, but {} = {} has no such parameter", slot.key, key,
                                          name, model.keyword));
  return model;
}

void read_slot(const std::string& place, const LawText& given, const DeclaredSlot& slot, LawParameters& law) {
  const std::vector<std::string> keys = given.keys_of(slot.key);
  // An optional slot without any key is left empty. The key "law" alone fills a slot, because some models have no
  // parameters.
  if (slot.optional && keys.empty() && !given.has(slot.key + "." + kLaw)) return;
  const DeclaredModel& model = model_given(place, given, slot, keys, law);
  // The model is put into the law first, because numbers_of() and choose() find only parameters of models that the law
  // contains. Every number must be given, but a choice that is not given keeps its first keyword.
  model.choose(law);
  for (const LawNumber& n : numbers_of(law))
    if (n.key.starts_with(slot.key + ".")) *n.value = given.number(n.key);
  for (const DeclaredChoice& c : model.choices) {
    const std::string key = slot.key + "." + c.key;
    if (given.has(key)) choose(law, slot.key, c.key, keyword_index(place, given, key, c.keywords));
  }
}

}  // namespace

Law parse_law(const std::string& place, const std::string& text) {
  const LawText given(place, text);
  LawParameters law;
  for (const DeclaredSlot& slot : declared_slots()) read_slot(place, given, slot, law);
  const std::vector<std::string> faults = law.validate();
  if (!faults.empty()) throw InputError(place, fmt::format("{}", fmt::join(faults, "; ")));
  return law;
}

std::string law_text(const Law& law) {
  LawParameters parameters = law, before;
  std::vector<std::string> said;
  for (const DeclaredSlot& slot : declared_slots()) {
    const int present = slot.present(law);
    if (present < 0) continue;
    std::vector<std::string> keys;
    for (const DeclaredNumber& n : slot.models[present].numbers) keys.push_back(n.key);
    if (&described_model(slot, keys, before) != &slot.models[present])
      said.push_back(fmt::format("{}.{}={}", slot.key, kLaw, slot.models[present].keyword));
    for (const LawNumber& n : numbers_of(parameters))
      if (n.key.starts_with(slot.key + ".")) said.push_back(fmt::format("{}={}", n.key, *n.value));
    for (const LawChoice& c : choices_of(law))
      if (c.key.starts_with(slot.key + ".") && c.chosen != 0)
        said.push_back(fmt::format("{}={}", c.key, c.declared->keywords[c.chosen]));
    slot.models[present].choose(before);
  }
  return fmt::format("{}", fmt::join(said, ", "));
}

}  // namespace floc
