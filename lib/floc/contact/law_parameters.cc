#include "floc/contact/law_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "floc/contact/law_description.h"

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
  }
  return "";
}

}  // namespace

double LawParameters::pull_off_force() const {
  return adhesion.visit([](const auto& model) {
    if constexpr (requires { model.pull_off_force; }) return model.pull_off_force;
    return 0.0;
  });
}

double LawParameters::range() const {
  return adhesion.visit([](const auto& model) {
    if constexpr (requires { model.range(); }) return model.acts() ? model.range() : 0.0;
    return 0.0;
  });
}

double LawParameters::contact_modulus(int dim, double diameter) const {
  return normal.visit([&](const auto& model) { return model.modulus(dim, diameter); });
}

std::vector<std::string> LawParameters::validate() const {
  std::vector<std::string> faults;
  LawParameters law = *this;
  for (const LawNumber& n : numbers_of(law)) {
    if (std::isfinite(*n.value) && holds(n.declared->requirement, *n.value)) continue;
    faults.push_back(
        fmt::format("contact.{} = {}: {}", n.key, *n.value, requirement_text(n.declared->requirement)));
  }
  if (rolling && !friction)
    faults.emplace_back("contact.rolling: needs contact.friction; grains that slide freely need not roll");
  return faults;
}

}  // namespace floc
