#include "floc/io/law_attributes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

/// Reads an attribute whose value is a keyword. @return index of the keyword in `known`
/// @throws InputError naming the attribute if the keyword is not in `known`
int keyword_index(const Hdf5Reader& file, const std::string& group, const std::string& attribute,
                  const std::vector<std::string>& known) {
  std::string given;
  file.attribute(group, attribute, given);
  const auto found = std::find(known.begin(), known.end(), given);
  if (found != known.end()) return static_cast<int>(found - known.begin());
  throw InputError(file.place(group), fmt::format("attribute {} = \"{}\", expected one of {}", attribute, given,
                                                  fmt::join(known, ", ")));
}

/// Returns the keys of the parameters that a state file contains for a slot (a component of the contact law, such as
/// friction), each key once. These are the parameters of the model in the slot, and the parameters of those models of
/// the slot that every file lists. The latter parameters are zero if their model is not in the slot.
/// @param present  index of the model in the slot, -1 if the slot is empty
/// @param choices  true to return the parameters whose value is a keyword, false to return those whose value is a
/// number
std::vector<std::string> keys_of(const DeclaredSlot& slot, int present, bool choices) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  };
  for (const DeclaredModel& model : slot.models) {
    if (!model.is_in_every_file && (present < 0 || &model != &slot.models[present])) continue;
    if (choices)
      for (const DeclaredChoice& c : model.choices) add(c.key);
    else
      for (const DeclaredNumber& n : model.numbers) add(n.key);
  }
  return keys;
}

/// Returns the name of the attribute that contains a parameter of a law: adhesion_force for the parameter
/// adhesion.force.
std::string attribute_name(const std::string& slot, const std::string& key) {
  return slot + "_" + key;
}

/// Whether every state file has an attribute with the keyword of the model in this slot ("none" if the slot is empty).
/// This is false if all models of the slot were added to the file format after the first version of the format.
bool is_named_in_every_file(const DeclaredSlot& slot) {
  return std::any_of(slot.models.begin(), slot.models.end(),
                     [](const DeclaredModel& model) { return model.is_in_every_file; });
}

void write_slot(Hdf5Writer& file, const std::string& group, const DeclaredSlot& slot, LawParameters& law) {
  const int present = slot.present(law);
  if (present < 0 && !is_named_in_every_file(slot)) return;
  file.attribute(group, slot.key, present < 0 ? "none" : slot.models[present].keyword);
  const std::vector<LawNumber> numbers = numbers_of(law);
  for (const std::string& key : keys_of(slot, present, false)) {
    const auto n = std::find_if(numbers.begin(), numbers.end(),
                                [&](const LawNumber& number) { return number.key == slot.key + "." + key; });
    file.attribute(group, attribute_name(slot.key, key), n == numbers.end() ? 0.0 : *n->value);
  }
  const std::vector<LawChoice> choices = choices_of(law);
  for (const std::string& key : keys_of(slot, present, true)) {
    const auto c = std::find_if(choices.begin(), choices.end(),
                                [&](const LawChoice& choice) { return choice.key == slot.key + "." + key; });
    file.attribute(group, attribute_name(slot.key, key),
                   c == choices.end() ? std::string("none") : c->declared->keywords[c->chosen]);
  }
}

/// Checks that all parameters of a slot, except those of the model in the slot, have the value zero or "none" in the
/// file.
/// @param present  index of the model in the slot, -1 if the slot is empty
/// @throws InputError naming the attribute if a parameter has another value
void require_nothing_else(const Hdf5Reader& file, const std::string& group, const DeclaredSlot& slot,
                          int present) {
  const auto is_present = [&](const std::string& key) {
    const auto has = [&key](const auto& members) {
      return std::any_of(members.begin(), members.end(), [&key](const auto& m) { return m.key == key; });
    };
    return present >= 0 && (has(slot.models[present].numbers) || has(slot.models[present].choices));
  };
  const std::string model = present < 0 ? "none" : slot.models[present].keyword;
  const auto require = [&](const std::string& key, auto value, const auto& expected) {
    const std::string name = attribute_name(slot.key, key);
    if (is_present(key) || !file.has_attribute(group, name)) return;
    file.attribute(group, name, value);
    if (value != expected)
      throw InputError(file.place(group), fmt::format("attribute {} = {}, expected {} because {} = \"{}\"",
                                                      name, value, expected, slot.key, model));
  };
  for (const std::string& key : keys_of(slot, present, false)) require(key, 0.0, 0.0);
  for (const std::string& key : keys_of(slot, present, true)) require(key, std::string(), std::string("none"));
}

void read_slot(const Hdf5Reader& file, const std::string& group, const DeclaredSlot& slot, LawParameters& law) {
  if (!is_named_in_every_file(slot) && !file.has_attribute(group, slot.key)) return;
  std::vector<std::string> known;
  if (slot.optional) known.emplace_back("none");
  for (const DeclaredModel& model : slot.models) known.push_back(model.keyword);
  const int chosen = keyword_index(file, group, slot.key, known) - (slot.optional ? 1 : 0);
  require_nothing_else(file, group, slot, chosen);
  if (chosen < 0) return;
  const DeclaredModel& model = slot.models[chosen];
  model.choose(law);
  for (const LawNumber& n : numbers_of(law)) {
    const std::string prefix = slot.key + ".";
    if (n.key.starts_with(prefix))
      file.attribute(group, attribute_name(slot.key, n.key.substr(prefix.size())), *n.value);
  }
  for (const DeclaredChoice& c : model.choices)
    choose(law, slot.key, c.key, keyword_index(file, group, attribute_name(slot.key, c.key), c.keywords));
}

}  // namespace

void write_law(Hdf5Writer& file, const Law& law, const std::string& group) {
  file.group(group);
  LawParameters parameters = law;
  for (const DeclaredSlot& slot : declared_slots()) write_slot(file, group, slot, parameters);
}

Law read_law(const Hdf5Reader& file, int dimension, const std::string& group) {
  LawParameters law;
  for (const DeclaredSlot& slot : declared_slots()) read_slot(file, group, slot, law);
  std::vector<std::string> faults = law.validate();
  for (LawFault& fault : law.faults_in_dimension(dimension)) faults.push_back(std::move(fault.words));
  if (!faults.empty()) throw InputError(file.place(group), fmt::format("{}", fmt::join(faults, "; ")));
  return law;
}

}  // namespace floc
