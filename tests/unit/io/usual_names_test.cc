#include "floc/io/usual_names.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

TEST(UsualNames, AreKnownInManyLanguagesAndSpellings) {
  for (const char* name : {"p", "P", "p'", "p’", "sigma'v", "sigma_v'", "σ'ᵥ", "$\\sigma'_{v}$",
                           "Effective stress", "EFFECTIVE VERTICAL STRESS", "Effective stress, σ'", "Spannung",
                           "contrainte verticale", "Esfuerzo vertical efectivo", "Naprężenie", "Pressdruck"})
    EXPECT_TRUE(is_usual_name("P_star", name) && is_usual_name("P", name)) << name;
  for (const char* name : {"e", "Void ratio", "void-ratio", "Void ratio (e)", "Void ratio e", "e = void ratio",
                           "Porenzahl", "Indice des vides", "Wskaźnik porowatości", "índice de vacíos"})
    EXPECT_TRUE(is_usual_name("void_ratio", name)) << name;
  for (const char* name : {"Phi", "φ", "D", "Relative density", "Packungsdichte"})
    EXPECT_TRUE(is_usual_name("phi", name)) << name;
  for (const char* name : {"Höhe", "H", "hauteur", "Wysokość", "Thickness"})
    EXPECT_TRUE(is_usual_name("height", name)) << name;
}

TEST(UsualNames, OfOtherQuantitiesAreNotTaken) {
  for (const char* name :
       {"E", "Void ratio, final", "pore pressure", "Pressure, pore", "time", "", " ", "e0", "n"})
    EXPECT_FALSE(is_usual_name("void_ratio", name) || is_usual_name("P", name)) << name;
  EXPECT_FALSE(is_usual_name("phi", "void ratio"));
  EXPECT_FALSE(is_usual_name("mass", "e"));
  EXPECT_FALSE(is_usual_name("nothing", "e"));
}

}  // namespace
}  // namespace floc
