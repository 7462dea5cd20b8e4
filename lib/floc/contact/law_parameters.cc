#include "floc/contact/law_parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace floc {
namespace {

void require(std::vector<std::string>& faults, const char* key, double value, bool holds,
             const char* requirement) {
  if (!std::isfinite(value) || !holds) faults.push_back(fmt::format("{} = {}: {}", key, value, requirement));
}

}  // namespace

std::vector<std::string> LawParameters::validate() const {
  std::vector<std::string> faults;
  require(faults, "contact.normal.stiffness", normal_stiffness, normal_stiffness > 0,
          "must be positive and finite");
  if (adhesion) {
    require(faults, "contact.adhesion.force", adhesion->force, adhesion->force >= 0, "must be >= 0 and finite");
    require(faults, "contact.adhesion.range", adhesion->range, adhesion->range >= 0, "must be >= 0 and finite");
  }
  if (damping)
    require(faults, "contact.damping.restitution", damping->restitution,
            damping->restitution > 0 && damping->restitution <= 1, "must be in (0, 1]");
  if (friction) {
    require(faults, "contact.friction.coefficient", friction->coefficient, friction->coefficient >= 0,
            "must be >= 0 and finite");
    require(faults, "contact.friction.stiffness", friction->stiffness, friction->stiffness > 0,
            "must be positive and finite");
  }
  if (rolling) {
    require(faults, "contact.rolling.coefficient", rolling->coefficient, rolling->coefficient >= 0,
            "must be >= 0 and finite (a length)");
    require(faults, "contact.rolling.stiffness", rolling->stiffness, rolling->stiffness > 0,
            "must be positive and finite");
    if (!friction)
      faults.emplace_back("contact.rolling: needs contact.friction; grains that slide freely need not roll");
  }
  return faults;
}

}  // namespace floc
