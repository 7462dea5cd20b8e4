#include "floc/contact/law_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "floc/contact/law_description.h"
#include "floc/contact/model_traits.h"

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

}  // namespace

double LawParameters::pull_off_force() const {
  return adhesion.visit([](const auto& model) {
    if constexpr (requires { model.pull_off_force; }) return model.pull_off_force;
    return 0.0;
  });
}

double LawParameters::pull_off_force(double radius) const {
  if (const CapillaryAdhesion* bridges = liquid()) return bridges->strength(radius, radius);
  return pull_off_force();
}

const CapillaryAdhesion* LawParameters::liquid() const {
  if (!adhesion.holds<CapillaryAdhesion>()) return nullptr;
  const CapillaryAdhesion& bridges = adhesion.get<CapillaryAdhesion>();
  return bridges.acts() ? &bridges : nullptr;
}

double LawParameters::range() const {
  return adhesion.visit([](const auto& model) {
    if constexpr (requires { model.range(); }) return model.acts() ? model.range() : 0.0;
    return 0.0;
  });
}

double LawParameters::contact_modulus(int dim, double diameter) const {
  return normal.visit([&](const auto& model) { return model.modulus_of_packing(dim, diameter); });
}

bool LawParameters::stiffness_varies() const {
  return normal.visit([]<class Model>(const Model&) { return kStiffnessVaries<Model>; });
}

bool LawParameters::resists_sliding() const {
  return friction.visit([](const auto& model) {
    if constexpr (requires { model.acts(); }) return model.acts();
    return false;
  });
}

std::vector<LawFault> LawParameters::faults_in_dimension(int dimension) const {
  std::vector<LawFault> faults;
  for_each_slot(*this, [&](const char* key, const auto& slot) {
    slot.visit([&]<class Model>(const Model&) {
      if constexpr (kDimensionOf<Model> != 0) {
        if (kDimensionOf<Model> != dimension)
          faults.push_back({key, fmt::format("contact.{}.law = \"{}\": is for {}, expected dimension = {}", key,
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
  return faults;
}

std::vector<LawFault> LawParameters::faults_between_slots() const {
  std::vector<LawFault> faults;
  const auto refuse = [&](bool fault, const std::string& slot, const char* words) {
    if (fault) faults.push_back({slot, "contact." + slot + words});
  };
  refuse(rolling && !friction, "rolling", ": needs contact.friction; grains that slide freely need not roll");
  refuse(twisting && !friction, "twisting",
         ": needs contact.friction; grains that slide freely need not turn against each other");
  if (adhesion.holds<CapillaryAdhesion>() && !normal.holds<HertzRepulsion>()) {
    constexpr const char* kDoNotResist =
        ": grains with liquid bridges, contact.adhesion.law = \"capillary\", do not resist it; expected no "
        "such "
        "table";
    refuse(bool(rolling), "rolling", kDoNotResist);
    refuse(bool(twisting), "twisting", kDoNotResist);
  }
  if (normal.holds<HertzRepulsion>()) {
    refuse(bool(adhesion) && !adhesion.holds<CapillaryAdhesion>(), "adhesion",
           ": spheres under contact.normal.law = \"hertz\" adhere only by liquid; expected no such table, law "
           "= \"capillary\", or contact.normal = {law = \"linear\", stiffness}");
    refuse(damping.holds<ViscousDamping>(), "damping",
           ".restitution: under contact.normal.law = \"hertz\" damping follows the stiffness; "
           "expected contact.damping = {critical_fraction}");
    refuse(friction.holds<CoulombFriction>(), "friction",
           ".stiffness: under contact.normal.law = \"hertz\" it follows from Poisson's ratio; "
           "expected contact.friction = {law = \"mindlin\", coefficient}");
    refuse(bool(rolling), "rolling",
           ": spheres under contact.normal.law = \"hertz\" do not resist rolling; expected no such "
           "table, or contact.normal = {law = \"linear\", stiffness}");
    refuse(bool(twisting), "twisting",
           ": spheres under contact.normal.law = \"hertz\" do not resist twisting; expected no such "
           "table, or contact.normal = {law = \"linear\", stiffness}");
  } else {
    refuse(damping.holds<CriticalDamping>(), "damping",
           ".critical_fraction: under contact.normal.law = \"linear\" expected contact.damping = "
           "{restitution}");
    refuse(friction.holds<MindlinFriction>(), "friction",
           ".law = \"mindlin\": its stiffness follows from contact.normal.law = \"hertz\"; "
           "expected that, or contact.friction = {coefficient, stiffness}");
  }
  return faults;
}

}  // namespace floc
