#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "support/places.h"

/// Tests that the table of compatible models in docs/scenes.md agrees with the declarations of the models.
namespace floc {
namespace {

const DeclaredSlot& slot_of(const std::string& key) {
  for (const DeclaredSlot& slot : declared_slots())
    if (slot.key == key) return slot;
  throw std::invalid_argument(key);
}

bool goes_together(const LawParameters& law) {
  return law.faults_between_slots().empty();
}

/// Lists the models of a slot that are compatible with a law, as text.
std::string models_beside(const LawParameters& law, const std::string& key) {
  std::vector<std::string> with_any, with_friction;
  for (const DeclaredModel& model : slot_of(key).models) {
    LawParameters with = law;
    model.choose(with);
    const bool for_spheres = law.faults_in_dimension(2).empty() && !with.faults_in_dimension(2).empty();
    const std::string name = fmt::format("`{}`{}", model.keyword, for_spheres ? " in 3D" : "");
    if (goes_together(with)) {
      with_any.push_back(name);
      continue;
    }
    const auto& frictions = slot_of("friction").models;
    const auto helps = [&](const DeclaredModel& friction) {
      LawParameters with_both = with;
      friction.choose(with_both);
      return goes_together(with_both);
    };
    if (key != "friction" && std::any_of(frictions.begin(), frictions.end(), helps))
      with_friction.push_back(name);
  }
  std::string text = "none";
  if (!with_any.empty()) text += fmt::format(" or {}", fmt::join(with_any, " or "));
  if (!with_friction.empty()) text += fmt::format(", or with friction {}", fmt::join(with_friction, " or "));
  return text;
}

std::string row_of(const LawParameters& law, const std::string& normal, const std::string& adhesion) {
  const std::string dimension = law.faults_in_dimension(2).empty() ? "2D and 3D" : "3D";
  return fmt::format("| `{}`, {} | {} | {} | {} | {} | {} |\n", normal, dimension, adhesion,
                     models_beside(law, "damping"), models_beside(law, "friction"),
                     models_beside(law, "rolling"), models_beside(law, "twisting"));
}

std::string table_of_laws() {
  std::string table =
      "| normal | adhesion | damping | friction | rolling | twisting |\n"
      "|--------|----------|---------|----------|---------|----------|\n";
  for (const DeclaredModel& normal : slot_of("normal").models) {
    LawParameters law;
    normal.choose(law);
    table += row_of(law, normal.keyword, "none");
    for (const DeclaredModel& adhesion : slot_of("adhesion").models) {
      LawParameters adhesive = law;
      adhesion.choose(adhesive);
      if (goes_together(adhesive))
        table += row_of(adhesive, normal.keyword, fmt::format("`{}`", adhesion.keyword));
    }
  }
  return table;
}

TEST(Docs, TableOfLawsFollowsFromTheirDeclarations) {
  std::ifstream file(test::source_directory() + "/docs/scenes.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("<!-- laws -->\n" + table_of_laws() + "<!-- end of laws -->\n"), std::string::npos)
      << "docs/scenes.md has to hold between its marks:\n"
      << table_of_laws();
}

}  // namespace
}  // namespace floc
