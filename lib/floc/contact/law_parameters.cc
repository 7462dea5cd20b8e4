#include "floc/contact/law_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <utility>

#include "floc/contact/law_description.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/relation_faults.h"

namespace floc {
namespace {

const char* requirement_text(Requirement requirement) {
  switch (requirement) {
    case Requirement::positive:
      return "must be positive and finite";
    case Requirement::not_negative:
      return "must be >= 0 and finite";
    case Requirement::at_most_one:
      return "must be in (0, 1]";
    case Requirement::poisson_ratio:
      return "must be in (-1, 0.5)";
    case Requirement::acute_angle:
      return "must be in [0, 90] degrees";
  }
  return "";
}

/// Returns the table that describes a model in a scene file, without values, for use in messages, such as
/// "contact.friction = {law = \"mindlin\", coefficient}".
template <class Model>
std::string table_of(const std::string& key) {
  const auto slot = std::find_if(declared_slots().begin(), declared_slots().end(),
                                 [&](const DeclaredSlot& s) { return s.key == key; });
  const auto model = std::find_if(slot->models.begin(), slot->models.end(),
                                  [](const DeclaredModel& m) { return m.keyword == Model::kKeyword; });
  return fmt::format("contact.{} = {}", key, table_text(*slot, *model));
}

/// Returns table_of() for each model of a slot of the contact law (normal, adhesion, ...) for which `takes` returns
/// true.
template <class... Models, class Takes>
std::vector<std::string> tables_of(const std::string& key, const LawSlot<Models...>&, const Takes& takes) {
  std::vector<std::string> tables;
  const auto add = [&]<class Model>(std::type_identity<Model> type) {
    if constexpr (!kIsAbsent<Model>)
      if (takes(type)) tables.push_back(table_of<Model>(key));
  };
  (add(std::type_identity<Models>{}), ...);
  return tables;
}

/// Returns a message if a model (of adhesion, damping, ...) cannot be combined with the normal law (kGoesWith);
/// otherwise an empty text.
template <class Normals, class Slot>
std::string family_fault(const Normals& normals, const std::string& key, const Slot& slot) {
  return normals.visit([&]<class Normal>(const Normal&) {
    return slot.visit([&]<class Model>(const Model&) -> std::string {
      if constexpr (kIsAbsent<Model> || kGoesWith<Normal, Model>) {
        return "";
      } else {
        std::vector<std::string> expected = tables_of(
            key, slot, []<class Other>(std::type_identity<Other>) { return kGoesWith<Normal, Other>; });
        expected.push_back("this table left out");
        for (std::string& table : tables_of("normal", normals, []<class Other>(std::type_identity<Other>) {
               return kGoesWith<Other, Model>;
             }))
          expected.push_back(std::move(table));
        const std::string_view rule = kAdheresByItself<Normal> && kIsAdhesion<Model>
                                          ? std::string_view("grains already adhere under this normal law")
                                          : family_rule(family_of<Normal>(), key);
        return fmt::format(
            "contact.{}.law = \"{}\" cannot be combined with contact.normal.law = \"{}\"{}{}; expected {}", key,
            Model::kKeyword, Normal::kKeyword, rule.empty() ? "" : ", because ", rule,
            fmt::join(expected, " or "));
      }
    });
  });
}

}  // namespace

std::vector<LawFault> LawParameters::faults_in_dimension(int dimension) const {
  std::vector<LawFault> faults;
  for_each_slot(*this, [&](const char* key, const auto& slot) {
    slot.visit([&]<class Model>(const Model&) {
      if constexpr (kDimensionOf<Model> != 0) {
        if (kDimensionOf<Model> != dimension)
          faults.push_back(
              {key, fmt::format("contact.{}.law = \"{}\": this model is for {}; expected dimension = {}", key,
                                Model::kKeyword, kDimensionOf<Model> == 3 ? "spheres" : "disks",
                                kDimensionOf<Model>)});
      }
    });
  });
  return faults;
}

std::vector<std::string> LawParameters::validate() const {
  std::vector<std::string> faults;
  LawParameters law = *this;
  for (const LawNumber& n : numbers_of(law)) {
    if (std::isfinite(*n.value) && holds(n.declared->requirement, *n.value)) continue;
    faults.push_back(
        fmt::format("contact.{} = {}: {}", n.key, *n.value, requirement_text(n.declared->requirement)));
  }
  for (LawFault& fault : faults_between_slots()) faults.push_back(std::move(fault.words));
  for (LawFault& fault : faults_between_numbers()) faults.push_back(std::move(fault.words));
  return faults;
}

std::vector<LawFault> LawParameters::faults_between_numbers() const {
  std::vector<LawFault> faults;
  for_each_slot(*this, [&](const char* key, const auto& slot) {
    slot.visit([&](const auto& model) {
      for (LawFault& fault : relation_faults(key, model)) faults.push_back(std::move(fault));
    });
  });
  return faults;
}

std::vector<LawFault> LawParameters::faults_between_slots() const {
  std::vector<LawFault> faults;
  const auto refuse = [&](bool fault, const std::string& slot, const char* words) {
    if (fault) faults.push_back({slot, "contact." + slot + words});
  };
  // Without friction the dynamics does not rotate grains (PairKernel::kRotates), and rolling and twisting springs would
  // never be loaded.
  refuse(rolling && !friction, "rolling",
         ": rolling resistance needs friction, because grains without friction do not rotate; give "
         "contact.friction or leave out contact.rolling");
  refuse(twisting && !friction, "twisting",
         ": twisting resistance needs friction, because grains without friction do not rotate; give "
         "contact.friction or leave out contact.twisting");
  for_each_slot(*this, [&](const char* key, const auto& slot) {
    if (std::string words = family_fault(normal, key, slot); !words.empty())
      faults.push_back({key, std::move(words)});
  });
  adhesion.visit([&]<class Adhesion>(const Adhesion&) {
    // Grains connected by liquid bridges roll freely. If family_fault() has already refused a rolling or twisting
    // resistance, this resistance is not reported again.
    if constexpr (kRollsFreely<Adhesion>) {
      const auto refuse_resistance = [&](const char* key, const auto& slot) {
        if (!slot || !family_fault(normal, key, slot).empty()) return;
        faults.push_back(
            {key,
             fmt::format(
                 "contact.{} is not allowed here: grains with contact.adhesion.law = \"{}\" roll and twist "
                 "without resistance; leave out this table",
                 key, Adhesion::kKeyword)});
      };
      refuse_resistance("rolling", rolling);
      refuse_resistance("twisting", twisting);
    }
  });
  return faults;
}

}  // namespace floc
