#include "floc/contact/law_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/contact/law_parameters.h"
#include "floc/contact/model_traits.h"

namespace floc {
namespace {

template <class Model>
void describe_fields(DeclaredModel& model) {
  if constexpr (requires { Model::kNumbers; })
    for (const Number<Model>& n : Model::kNumbers)
      model.numbers.push_back({n.key, n.unit, n.symbol, n.requirement, n.at_first, n.expectation, n.meaning});
  if constexpr (requires { Model::kChoices; })
    for (const Choice<Model>& c : Model::kChoices) {
      DeclaredChoice choice{c.key, {}};
      for (const char* const* keyword = c.keywords; *keyword != nullptr; ++keyword)
        choice.keywords.emplace_back(*keyword);
      model.choices.push_back(choice);
    }
}

/// Puts a model of type Model into the slot of a contact law (normal, adhesion, ...) that can hold this type.
template <class Model>
void put(LawParameters& law) {
  LawParameters::for_each_slot(law, [](const char*, auto& slot) {
    if constexpr (requires { slot = Model{}; }) slot = Model{};
  });
}

template <class... Models>
DeclaredSlot describe(const char* key, const LawSlot<Models...>&) {
  DeclaredSlot slot{key, (kIsAbsent<Models> || ...), {}};
  const auto add = [&]<class Model>(std::type_identity<Model>) {
    if constexpr (!kIsAbsent<Model>) {
      DeclaredModel model{
          Model::kKeyword, kIsDefault<Model>, kIsDefaultOfFamily<Model>, kIsInEveryFile<Model>, {}, {},
          &put<Model>};
      describe_fields<Model>(model);
      slot.models.push_back(std::move(model));
    }
  };
  (add(std::type_identity<Models>{}), ...);
  return slot;
}

std::vector<DeclaredSlot> describe_all() {
  std::vector<DeclaredSlot> slots;
  const LawParameters any;
  LawParameters::for_each_slot(
      any, [&](const char* key, const auto& slot) { slots.push_back(describe(key, slot)); });
  return slots;
}

/// Calls visit(slot key, declaration, model) for each model of a law. The slot key is "normal", "adhesion", ...
template <class Law, class Visit>
void for_each_model(Law& law, Visit&& visit) {
  auto declared = declared_slots().begin();
  LawParameters::for_each_slot(law, [&](const char* key, auto& slot) {
    const int present = declared->present(law);
    if (present >= 0)
      slot.visit([&](auto& model) { visit(std::string(key), declared->models[present], model); });
    ++declared;
  });
}

/// Returns whether a model has a number that no other model of the same slot has, so that this number identifies the
/// model.
bool has_own_number(const DeclaredSlot& slot, const DeclaredModel& model) {
  return std::any_of(model.numbers.begin(), model.numbers.end(), [&](const DeclaredNumber& n) {
    return std::count_if(slot.models.begin(), slot.models.end(),
                         [&](const DeclaredModel& other) { return other.number(n.key) != nullptr; }) == 1;
  });
}

}  // namespace

const DeclaredNumber* DeclaredModel::number(const std::string& number_key) const {
  for (const DeclaredNumber& n : numbers)
    if (n.key == number_key) return &n;
  return nullptr;
}

bool fits(const DeclaredModel& model, LawParameters law) {
  const std::size_t n_faults = law.faults_between_slots().size();
  model.choose(law);
  return law.faults_between_slots().size() <= n_faults;
}

bool names_its_model(const DeclaredSlot& slot) {
  return std::none_of(slot.models.begin(), slot.models.end(),
                      [](const DeclaredModel& m) { return m.is_default; });
}

std::string table_text(const DeclaredSlot& slot, const DeclaredModel& model) {
  std::string keys;
  if (names_its_model(slot) || (!model.is_default && !has_own_number(slot, model)))
    keys = fmt::format("law = \"{}\"", model.keyword);
  for (const DeclaredNumber& n : model.numbers) keys += (keys.empty() ? "" : ", ") + n.key;
  return "{" + keys + "}";
}

int DeclaredSlot::present(const LawParameters& law) const {
  int found = -1;
  LawParameters::for_each_slot(law, [&](const char* slot_key, const auto& slot) {
    if (slot_key == key) found = static_cast<int>(slot.variant().index()) - (optional ? 1 : 0);
  });
  return found;
}

const std::vector<DeclaredSlot>& declared_slots() {
  static const std::vector<DeclaredSlot> slots = describe_all();
  return slots;
}

std::vector<LawNumber> numbers_of(LawParameters& law) {
  std::vector<LawNumber> numbers;
  for_each_model(law, [&]<class Model>(const std::string& slot, const DeclaredModel& declared, Model& model) {
    if constexpr (requires { Model::kNumbers; }) {
      auto next = declared.numbers.begin();
      for (const Number<Model>& n : Model::kNumbers)
        numbers.push_back({slot + "." + n.key, &(model.*n.member), &*next++});
    }
  });
  return numbers;
}

std::vector<LawChoice> choices_of(const LawParameters& law) {
  std::vector<LawChoice> choices;
  for_each_model(law,
                 [&]<class Model>(const std::string& slot, const DeclaredModel& declared, const Model& model) {
                   if constexpr (requires { Model::kChoices; }) {
                     auto next = declared.choices.begin();
                     for (const Choice<Model>& c : Model::kChoices)
                       choices.push_back({slot + "." + c.key, c.get(model), &*next++});
                   }
                 });
  return choices;
}

void choose(LawParameters& law, const std::string& slot, const std::string& key, int chosen) {
  for_each_model(law, [&]<class Model>(const std::string& slot_key, const DeclaredModel&, Model& model) {
    if constexpr (requires { Model::kChoices; }) {
      if (slot_key != slot) return;
      for (const Choice<Model>& c : Model::kChoices)
        if (c.key == key) c.set(model, chosen);
    }
  });
}

}  // namespace floc
