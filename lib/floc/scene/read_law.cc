#include "floc/scene/read_law.h"

#include <fmt/format.h>

#include "floc/contact/law_description.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// A placeholder for a number that was refused, so that what follows can still be checked.
constexpr double kPlaceholder = 1.0;

NumberRule rule_of(const DeclaredNumber& n) {
  static constexpr bool (*kHolds[])(double) = {[](double x) { return holds(Requirement::positive, x); },
                                               [](double x) { return holds(Requirement::not_negative, x); },
                                               [](double x) { return holds(Requirement::at_most_one, x); }};
  return {kHolds[static_cast<int>(n.at_first)], n.expectation.c_str()};
}

/// Slots one model of which a scene has to name by its keyword: those that can hold several, and the normal
/// force.
bool names_its_model(const DeclaredSlot& slot) {
  return slot.models.size() > 1 || !slot.optional;
}

/// "a table {law = "tail", force, range} or {law = "constant", force}"
std::string expected_table(const DeclaredSlot& slot) {
  std::string text = "a table ";
  for (const DeclaredModel& model : slot.models) {
    if (&model != &slot.models.front()) text += " or ";
    std::string keys;
    if (names_its_model(slot)) keys = fmt::format("law = \"{}\"", model.keyword);
    for (const DeclaredNumber& n : model.numbers) keys += (keys.empty() ? "" : ", ") + n.key;
    for (const DeclaredChoice& c : model.choices) keys += (keys.empty() ? "" : ", ") + c.key;
    text += "{" + keys + "}";
  }
  return text;
}

/// Keys that other models of the slot have.
void refuse_keys_of_others(TableReader& t, const DeclaredSlot& slot, const DeclaredModel& chosen) {
  for (const DeclaredModel& other : slot.models)
    for (const DeclaredNumber& n : other.numbers)
      if (!chosen.number(n.key))
        t.refuse(n.key, fmt::format("{}: a {} {} has no {}; expected law = \"{}\", or no {}", t.path_of(n.key),
                                    chosen.keyword, slot.key, n.key, other.keyword, n.key));
}

void read_slot(TableReader t, const DeclaredSlot& slot, LawParameters& law) {
  if (!t && slot.optional) return;
  std::vector<std::string> keywords;
  for (const DeclaredModel& model : slot.models) keywords.push_back(model.keyword);
  const auto chosen = t.choice("law", keywords, names_its_model(slot) ? Need::required : Need::optional);
  if (slot.models.size() > 1 && !chosen) return;
  const DeclaredModel& model = slot.models[chosen.value_or(0)];
  model.choose(law);
  for (const LawNumber& n : numbers_of(law)) {
    if (!n.key.starts_with(slot.key + ".")) continue;
    *n.value = t.number(n.declared->key, rule_of(*n.declared)).value_or(kPlaceholder);
  }
  for (const DeclaredChoice& c : model.choices)
    if (const auto index = t.choice(c.key, c.keywords, Need::optional))
      choose(law, slot.key, c.key, static_cast<int>(*index));
  refuse_keys_of_others(t, slot, model);
  t.refuse_other_keys();
}

}  // namespace

LawParameters read_law(TableReader& root) {
  TableReader t = root.table("contact", "a table [contact]");
  LawParameters law;
  for (const DeclaredSlot& slot : declared_slots())
    read_slot(t.table(slot.key, expected_table(slot).c_str(), slot.optional ? Need::optional : Need::required),
              slot, law);
  if (law.rolling && !law.friction)
    t.fault("rolling", "contact.rolling: needs contact.friction; grains that slide freely need not roll");
  t.refuse_other_keys();
  return law;
}

}  // namespace floc
