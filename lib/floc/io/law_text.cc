#include "floc/io/law_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

const std::vector<std::string> kKeys = {"normal.stiffness",    "adhesion.force",      "adhesion.range",
                                        "damping.restitution", "damping.mass",        "friction.coefficient",
                                        "friction.stiffness",  "rolling.coefficient", "rolling.stiffness"};

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

  std::string word(const std::string& key) const { return values_.at(key); }

  double number(const std::string& key) const {
    if (!has(key))
      throw InputError(place_, fmt::format("{} is missing; a law names all parameters of a part", key));
    if (const auto value = parse_number<double>(values_.at(key))) return *value;
    throw InputError(place_, fmt::format("{} = \"{}\", expected a finite number", key, values_.at(key)));
  }

 private:
  void add(std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string key(trimmed(assignment.substr(0, equals)));
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
      throw InputError(
          place_, fmt::format("\"{}\" is no parameter of a law; they are {}", key, fmt::join(kKeys, ", ")));
    if (equals == std::string_view::npos)
      throw InputError(place_, fmt::format("{} has no value, expected {}=...", key, key));
    if (!values_.emplace(key, trimmed(assignment.substr(equals + 1))).second)
      throw InputError(place_, fmt::format("{} is given twice", key));
  }

  std::string place_;
  std::map<std::string, std::string> values_;
};

DampingMass damping_mass(const std::string& place, const LawText& given) {
  if (!given.has("damping.mass") || given.word("damping.mass") == "effective") return DampingMass::effective;
  if (given.word("damping.mass") == "grain") return DampingMass::grain;
  throw InputError(
      place, fmt::format("damping.mass = \"{}\", expected effective or grain", given.word("damping.mass")));
}

}  // namespace

LawParameters parse_law(const std::string& place, const std::string& text) {
  const LawText given(place, text);
  LawParameters law;
  law.normal_stiffness = given.number("normal.stiffness");
  if (given.has("adhesion.range") || given.has("adhesion.force"))
    law.adhesion = {given.number("adhesion.force"),
                    given.has("adhesion.range") ? given.number("adhesion.range") : 0.0};
  if (given.has("damping.restitution") || given.has("damping.mass"))
    law.damping = {given.number("damping.restitution"), damping_mass(place, given)};
  if (given.has("friction.coefficient") || given.has("friction.stiffness"))
    law.friction = {given.number("friction.coefficient"), given.number("friction.stiffness")};
  if (given.has("rolling.coefficient") || given.has("rolling.stiffness"))
    law.rolling = {given.number("rolling.coefficient"), given.number("rolling.stiffness")};
  const std::vector<std::string> faults = law.validate();
  if (!faults.empty()) throw InputError(place, fmt::format("{}", fmt::join(faults, "; ")));
  return law;
}

std::string law_text(const LawParameters& law) {
  std::string text = fmt::format("normal.stiffness={}", law.normal_stiffness);
  if (law.adhesion) {
    text += fmt::format(", adhesion.force={}", law.adhesion->force);
    if (law.adhesion->range > 0.0) text += fmt::format(", adhesion.range={}", law.adhesion->range);
  }
  if (law.damping) {
    text += fmt::format(", damping.restitution={}", law.damping->restitution);
    if (law.damping->mass == DampingMass::grain) text += ", damping.mass=grain";
  }
  if (law.friction)
    text += fmt::format(", friction.coefficient={}, friction.stiffness={}", law.friction->coefficient,
                        law.friction->stiffness);
  if (law.rolling)
    text += fmt::format(", rolling.coefficient={}, rolling.stiffness={}", law.rolling->coefficient,
                        law.rolling->stiffness);
  return text;
}

}  // namespace floc
