#include "floc/io/law_attributes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floc/base/error.h"

namespace floc {
namespace {

const std::string kGroup = "law";

std::string keyword(const Hdf5Reader& file, const char* slot, const std::vector<std::string>& known) {
  std::string word;
  file.attribute(kGroup, slot, word);
  for (const std::string& k : known)
    if (word == k) return word;
  throw InputError(file.place(kGroup), fmt::format("attribute {} = \"{}\", expected one of {}", slot, word,
                                                   fmt::join(known, ", ")));
}

double parameter(const Hdf5Reader& file, const char* name) {
  double value = 0.0;
  file.attribute(kGroup, name, value);
  return value;
}

}  // namespace

void write_law(Hdf5Writer& file, const LawParameters& law) {
  const auto word = [&](const char* slot, const char* value) {
    file.attribute(kGroup, slot, std::string(value));
  };
  const auto number = [&](const char* name, double value) { file.attribute(kGroup, name, value); };
  file.group(kGroup);
  word("normal", "linear");
  number("normal_stiffness", law.normal_stiffness);
  word("adhesion", !law.adhesion ? "none" : law.adhesion->range > 0.0 ? "tail" : "constant");
  number("adhesion_force", law.adhesion ? law.adhesion->force : 0.0);
  number("adhesion_range", law.adhesion ? law.adhesion->range : 0.0);
  word("damping", law.damping ? "viscous" : "none");
  number("damping_restitution", law.damping ? law.damping->restitution : 0.0);
  word("damping_mass", !law.damping ? "none" : law.damping->mass == DampingMass::grain ? "grain" : "effective");
  word("friction", law.friction ? "coulomb" : "none");
  number("friction_coefficient", law.friction ? law.friction->coefficient : 0.0);
  number("friction_stiffness", law.friction ? law.friction->stiffness : 0.0);
  word("rolling", law.rolling ? "spring" : "none");
  number("rolling_coefficient", law.rolling ? law.rolling->coefficient : 0.0);
  number("rolling_stiffness", law.rolling ? law.rolling->stiffness : 0.0);
}

LawParameters read_law(const Hdf5Reader& file) {
  LawParameters law;
  keyword(file, "normal", {"linear"});
  law.normal_stiffness = parameter(file, "normal_stiffness");
  if (keyword(file, "adhesion", {"none", "tail", "constant"}) != "none")
    law.adhesion = {parameter(file, "adhesion_force"), parameter(file, "adhesion_range")};
  if (keyword(file, "damping", {"none", "viscous"}) != "none") {
    const bool grain = keyword(file, "damping_mass", {"effective", "grain"}) == "grain";
    law.damping = {parameter(file, "damping_restitution"), grain ? DampingMass::grain : DampingMass::effective};
  }
  if (keyword(file, "friction", {"none", "coulomb"}) != "none")
    law.friction = {parameter(file, "friction_coefficient"), parameter(file, "friction_stiffness")};
  if (keyword(file, "rolling", {"none", "spring"}) != "none")
    law.rolling = {parameter(file, "rolling_coefficient"), parameter(file, "rolling_stiffness")};
  const std::vector<std::string> faults = law.validate();
  if (!faults.empty()) throw InputError(file.place(kGroup), fmt::format("{}", fmt::join(faults, "; ")));
  return law;
}

}  // namespace floc
