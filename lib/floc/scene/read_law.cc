#include "floc/scene/read_law.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Number that replaces an invalid number, so that later checks still find a complete contact law.
constexpr double kPlaceholder = 1.0;

NumberRule rule_of(const DeclaredNumber& n) {
  static constexpr bool (*kHolds[])(double) = {[](double x) { return holds(Requirement::positive, x); },
                                               [](double x) { return holds(Requirement::not_negative, x); },
                                               [](double x) { return holds(Requirement::at_most_one, x); },
                                               [](double x) { return holds(Requirement::poisson_ratio, x); },
                                               [](double x) { return holds(Requirement::acute_angle, x); }};
  return {kHolds[static_cast<int>(n.at_first)], n.expectation.c_str()};
}

/// Returns a description, for messages, of the table that a component of the contact law must have. Example: a table
/// {law = "tail", force, range} or {law = "constant", force}.
std::string expected_table(const DeclaredSlot& slot) {
  std::string text = "a table ";
  for (const DeclaredModel& model : slot.models)
    text += (&model == &slot.models.front() ? "" : " or ") + table_text(slot, model);
  return text;
}

/// Checks the keys in the table of one component of the contact law. Records a fault for each key that belongs to
/// another model of this component but not to the chosen model.
void refuse_keys_of_others(TableReader& t, const DeclaredSlot& slot, const DeclaredModel& chosen) {
  for (const DeclaredModel& other : slot.models)
    for (const DeclaredNumber& n : other.numbers)
      if (!chosen.number(n.key))
        t.refuse(n.key, fmt::format("{} is not allowed here: the model \"{}\" of contact.{} has no {}; "
                                    "expected law = \"{}\", or no key {}",
                                    t.path_of(n.key), chosen.keyword, slot.key, n.key, other.keyword, n.key));
}

/// Returns the index of the model for a component of the contact law if the table of this component has no key "law".
/// The index is that of the default model. If the component has a separate default model for the family of the normal
/// law, that model is the default. If the table has a key that the default model does not have, the index is that of
/// the first model with this key.
/// @param law  contact law with the components that were read earlier
std::size_t unnamed_model(const TableReader& t, const DeclaredSlot& slot, const LawParameters& law) {
  std::size_t meant = 0;
  for (std::size_t k = 0; k < slot.models.size(); ++k)
    if (slot.models[k].is_default) meant = k;
  for (std::size_t k = 0; k < slot.models.size(); ++k)
    if (slot.models[k].is_default_of_family && fits(slot.models[k], law)) meant = k;
  for (std::size_t k = 0; k < slot.models.size(); ++k)
    for (const DeclaredNumber& n : slot.models[k].numbers)
      if (t.has(n.key) && !slot.models[meant].number(n.key)) return k;
  return meant;
}

void read_slot(TableReader t, const DeclaredSlot& slot, LawParameters& law) {
  if (!t && slot.optional) return;
  std::vector<std::string> keywords;
  for (const DeclaredModel& model : slot.models) keywords.push_back(model.keyword);
  const auto chosen = t.choice("law", keywords, names_its_model(slot) ? Need::required : Need::optional);
  if (!chosen && (t.has("law") || (slot.models.size() > 1 && names_its_model(slot)))) return;
  const DeclaredModel& model = slot.models[chosen ? *chosen : unnamed_model(t, slot, law)];
  // If the chosen model cannot be combined with the models of other components, no other fault of this component is
  // reported: the numbers of the model are not checked.
  const bool goes_together = fits(model, law);
  model.choose(law);
  bool all_right = true;
  for (const LawNumber& n : numbers_of(law)) {
    if (!n.key.starts_with(slot.key + ".")) continue;
    std::optional<double> value;
    if (goes_together) value = t.number(n.declared->key, rule_of(*n.declared));
    *n.value = value.value_or(kPlaceholder);
    all_right = all_right && value;
  }
  if (!goes_together) return;
  for (const LawFault& fault : law.faults_between_numbers())
    if (fault.slot == slot.key && all_right) t.fault(fault.key, fault.words);
  for (const DeclaredChoice& c : model.choices)
    if (const auto index = t.choice(c.key, c.keywords, Need::optional))
      choose(law, slot.key, c.key, static_cast<int>(*index));
  refuse_keys_of_others(t, slot, model);
  t.refuse_other_keys();
}

}  // namespace

Law read_law(TableReader& root, int dimension) {
  TableReader t = root.table("contact", "a table [contact]");
  LawParameters law;
  for (const DeclaredSlot& slot : declared_slots())
    read_slot(t.table(slot.key, expected_table(slot).c_str(), slot.optional ? Need::optional : Need::required),
              slot, law);
  // Each number has been checked above. The next check is whether the components can be combined with each other and
  // with the dimension of the scene.
  for (const auto& faults : {law.faults_between_slots(), law.faults_in_dimension(dimension)})
    for (const LawFault& fault : faults) t.fault(fault.slot, fault.words);
  t.refuse_other_keys();
  return law;
}

}  // namespace floc
