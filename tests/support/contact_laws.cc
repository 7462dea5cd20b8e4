#include "support/contact_laws.h"

#include <algorithm>
#include <stdexcept>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "support/law_list.h"
#include "support/law_units.h"

namespace floc::test {
namespace {

double& number_of(LawParameters& law, const std::string& key) {
  for (const LawNumber& n : numbers_of(law))
    if (n.key == key) return *n.value;
  throw std::invalid_argument("the law has no " + key);
}

void choose_keyword(LawParameters& law, const std::string& key, const std::string& keyword) {
  for (const LawChoice& c : choices_of(law)) {
    if (c.key != key) continue;
    const auto& keywords = c.declared->keywords;
    const auto found = std::find(keywords.begin(), keywords.end(), keyword);
    if (found == keywords.end()) break;
    const std::size_t dot = key.find('.');
    return choose(law, key.substr(0, dot), key.substr(dot + 1), static_cast<int>(found - keywords.begin()));
  }
  throw std::invalid_argument("the law has no " + key + " = " + keyword);
}

/// Returns a value for a parameter that is not listed in `numbers`. The value depends on the unit of the parameter. A
/// stiffness gets 1.5 times the normal stiffness; this is also valid as a stiffness of unloading, which must exceed the
/// normal stiffness.
double number_like(Unit unit, const std::map<std::string, double>& numbers) {
  switch (unit) {
    case Unit::stiffness:
      return 1.5 * numbers.at("normal.stiffness");
    case Unit::force:
      return numbers.at("adhesion.force");
    case Unit::length:
      return numbers.at("adhesion.range");
    case Unit::pressure:
      return numbers.at("normal.modulus");
    case Unit::rolling_stiffness:
      return numbers.at("rolling.stiffness");
    default:
      return 0.3;
  }
}

}  // namespace

Part linear(double stiffness) {
  return {[=](LawParameters& law) { law.normal = LinearRepulsion{stiffness}; }};
}
Part hertz(double modulus, double poisson) {
  return {[=](LawParameters& law) { law.normal = HertzRepulsion{modulus, poisson}; }};
}
Part tail_adhesion(double force, double range) {
  return {[=](LawParameters& law) { law.adhesion = TailAdhesion{force, range}; }};
}
Part constant_adhesion(double force) {
  return {[=](LawParameters& law) { law.adhesion = ConstantAdhesion{force}; }};
}
Part viscous_damping(double restitution) {
  return {[=](LawParameters& law) { law.damping = ViscousDamping{restitution, DampingMass::effective}; }};
}
Part critical_damping(double critical_fraction) {
  return {[=](LawParameters& law) { law.damping = CriticalDamping{critical_fraction}; }};
}
Part coulomb(double coefficient, double stiffness) {
  return {[=](LawParameters& law) { law.friction = CoulombFriction{coefficient, stiffness}; }};
}
Part mindlin(double coefficient) {
  return {[=](LawParameters& law) { law.friction = MindlinFriction{coefficient}; }};
}
Part rolling_spring(double coefficient, double stiffness) {
  return {[=](LawParameters& law) { law.rolling = RollingSpring{coefficient, stiffness}; }};
}
Part twisting_spring(double coefficient, double stiffness) {
  return {[=](LawParameters& law) { law.twisting = TwistingSpring{coefficient, stiffness}; }};
}

Part liquid(double surface_tension, double contact_angle, double water_content, double density_ratio,
            const std::string& form, const std::string& formation) {
  return {[=](LawParameters& law) {
    law.adhesion = CapillaryAdhesion{surface_tension, contact_angle, water_content, density_ratio};
    choose_keyword(law, "adhesion.form", form);
    choose_keyword(law, "adhesion.formation", formation);
  }};
}

Part without(const std::string& slot) {
  return {[=](LawParameters& law) {
    LawParameters::for_each_slot(law, [&](const char* key, auto& models) {
      if (key == slot) models.reset();
    });
  }};
}

Part changed(const std::string& key, double value) {
  return {[=](LawParameters& law) { number_of(law, key) = value; }};
}

Part chosen(const std::string& key, const std::string& keyword) {
  return {[=](LawParameters& law) { choose_keyword(law, key, keyword); }};
}

Law& operator+=(Law& law, const Part& part) {
  LawParameters parameters = law;
  part.put(parameters);
  return law = parameters;
}

Law law_of(std::initializer_list<Part> parts) {
  Law law;
  for (const Part& part : parts) law += part;
  return law;
}

Law cohesive_law() {
  return law_of({linear(1e5), tail_adhesion(1.0, 1e-3), viscous_damping(0.015), coulomb(0.5, 1e5),
                 rolling_spring(0.005, 10.0)});
}

double law_number(const Law& law, const std::string& key) {
  LawParameters parameters = law;
  return number_of(parameters, key);
}

Law in_units(const Law& law, double length, double force) {
  LawParameters changed = law;
  for (const LawNumber& n : numbers_of(changed)) {
    switch (n.declared->unit) {
      case Unit::length:
        *n.value *= length;
        break;
      case Unit::force:
        *n.value *= force;
        break;
      case Unit::stiffness:
        *n.value *= force / length;
        break;
      case Unit::rolling_stiffness:
        *n.value *= force * length;
        break;
      case Unit::pressure:
        *n.value *= force / (length * length);
        break;
      case Unit::ratio:
      case Unit::angle:
      case Unit::degrees:
      case Unit::volume:
        break;
    }
  }
  return changed;
}

std::vector<Law> all_laws(int dimension, const std::map<std::string, double>& numbers) {
  std::vector<LawParameters> laws = {{}};
  for (const DeclaredSlot& slot : declared_slots()) {
    std::vector<LawParameters> longer;
    for (const LawParameters& law : laws) {
      if (slot.optional) longer.push_back(law);
      for (const DeclaredModel& model : slot.models) {
        longer.push_back(law);
        model.choose(longer.back());
      }
    }
    laws = std::move(longer);
  }
  std::erase_if(laws, [&](const LawParameters& law) {
    return !law.faults_between_slots().empty() || !law.faults_in_dimension(dimension).empty();
  });
  std::vector<Law> filled;
  for (LawParameters& law : laws) {
    for (const LawNumber& n : numbers_of(law))
      *n.value = numbers.count(n.key) > 0 ? numbers.at(n.key) : number_like(n.declared->unit, numbers);
    filled.emplace_back(law);
  }
  return filled;
}

}  // namespace floc::test
