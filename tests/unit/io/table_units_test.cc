#include "floc/io/table_units.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/error.h"

namespace floc {
namespace {

using testing::Pair;

TEST(TableUnits, AreTheLastBracketsOfAHeader) {
  EXPECT_THAT(name_and_unit("P_star [kPa]"), Pair("P_star", "kPa"));
  EXPECT_THAT(name_and_unit("sigma' (eff) [ kPa ]"), Pair("sigma' (eff)", "kPa"));
  EXPECT_THAT(name_and_unit("sigma(MPa)"), Pair("sigma", "MPa"));
  EXPECT_THAT(name_and_unit("P [-]"), Pair("P", ""));
  EXPECT_THAT(name_and_unit("P [1]"), Pair("P", ""));
  EXPECT_THAT(name_and_unit("P"), Pair("P", ""));
  EXPECT_THAT(name_and_unit("c_force[1]x"), Pair("c_force[1]x", ""));
  EXPECT_THAT(name_and_unit("c_force[2]"), Pair("c_force[2]", ""));
}

TEST(TableUnits, AreAlsoKnownUnitsBehindTheName) {
  EXPECT_THAT(name_and_unit("sigma', kPa"), Pair("sigma'", "kPa"));
  EXPECT_THAT(name_and_unit("sigma' in kN/m2"), Pair("sigma'", "kN/m2"));
  EXPECT_THAT(name_and_unit("sigma'/kPa"), Pair("sigma'", "kPa"));
  EXPECT_THAT(name_and_unit("Pressure MPa"), Pair("Pressure", "MPa"));
  EXPECT_THAT(name_and_unit("sigma_kPa"), Pair("sigma", "kPa"));
  EXPECT_THAT(name_and_unit("e_percent"), Pair("e", "percent"));
  EXPECT_THAT(name_and_unit("Void ratio (%)"), Pair("Void ratio", "%"));
  // These column names contain something that looks like a unit but is none.
  for (const char* name :
       {"sigma_bar", "F_N", "P/P_ref", "P_m", "x in", "sigma (effective)", "Void ratio (e)", "Spannung"})
    EXPECT_THAT(name_and_unit(name), Pair(name, ""));
}

TEST(TableUnits, OfARowOfUnitsAreKnownUnitsOrInBrackets) {
  for (const char* unit : {"kPa", "[kPa]", " (kPa) "}) EXPECT_EQ(unit_in_cell(unit), "kPa") << unit;
  EXPECT_EQ(unit_in_cell("[turnips]"), "turnips");
  for (const char* cell : {"turnips", "", "-", "[-]", "[1]", "x"}) EXPECT_EQ(unit_in_cell(cell), "") << cell;
  EXPECT_TRUE(states_no_unit("-") && states_no_unit("[-]") && states_no_unit("[1]"));
  EXPECT_FALSE(states_no_unit("1") || states_no_unit("kPa"));
}

TEST(TableUnits, OfSharesAreThoseOfOneAndPercent) {
  EXPECT_EQ(share_of_one("c", ""), 1.0);
  EXPECT_EQ(share_of_one("c", "%"), 0.01);
  EXPECT_THROW(share_of_one("c", "kPa"), InputError);
}

TEST(TableUnits, AreConvertedByTheirSizes) {
  const auto factor = [](const char* from, const char* to) { return unit_factor("a", from, "b", to); };
  EXPECT_DOUBLE_EQ(factor("kPa", "Pa"), 1e3);
  EXPECT_DOUBLE_EQ(factor("MPa", "kpa"), 1e3);
  EXPECT_DOUBLE_EQ(factor("GPa", "N/mm2"), 1e3);
  EXPECT_DOUBLE_EQ(factor("kN/m2", "kPa"), 1.0);
  EXPECT_DOUBLE_EQ(factor("bar", "kPa"), 100.0);
  EXPECT_NEAR(factor("psi", "kPa"), 6.894757, 1e-6);
  EXPECT_DOUBLE_EQ(factor("kN/m", "N/mm"), 1.0);
  EXPECT_DOUBLE_EQ(factor("mN", "uN"), 1e3);
  EXPECT_DOUBLE_EQ(factor("mm", "m"), 1e-3);
  EXPECT_DOUBLE_EQ(factor("potatoes", "potatoes"), 1.0);
  EXPECT_THROW(factor("potatoes", "Pa"), InputError);
}

/// Converts between all pairs of units, including prefixes. The factors of the two directions must have the product
/// one. A conversion through a third unit must give the same factor as a direct conversion. Units of different
/// quantities, and missing units, must be refused.
TEST(TableUnits, OfAllPairsConvertOrAreRefused) {
  std::vector<std::string> units = known_units();
  for (const char* name :
       {"kPa", "MPa", "GPa", "hPa", "mPa", "kN/m2", "MN/m^2", "mbar", "kN", "mN", "kN/m", "mm", "um"})
    units.emplace_back(name);
  const auto convertible = [](const std::string& a, const std::string& b) {
    try {
      (void)unit_factor("a", a, "b", b);
    } catch (const InputError&) {
      return false;
    }
    return true;
  };
  int n_converted = 0, n_refused = 0;
  for (const std::string& a : units)
    for (const std::string& b : units) {
      EXPECT_EQ(convertible(a, b), convertible(b, a)) << a << ", " << b;
      if (!convertible(a, b)) {
        ++n_refused;
        continue;
      }
      ++n_converted;
      EXPECT_NEAR(unit_factor("a", a, "b", b) * unit_factor("b", b, "a", a), 1.0, 1e-14) << a << ", " << b;
      for (const std::string& c : units)
        if (convertible(b, c)) {
          EXPECT_NEAR(unit_factor("", a, "", b) * unit_factor("", b, "", c) / unit_factor("", a, "", c), 1.0,
                      1e-14);
        }
    }
  for (const std::string& a : units) {
    EXPECT_FALSE(convertible(a, ""));
    EXPECT_FALSE(convertible("", a));
  }
  fmt::print("{} units: {} pairs converted, {} refused, {} without one of the two units refused\n",
             units.size(), n_converted, n_refused, 2 * units.size());
  EXPECT_GT(n_converted, 100);
  EXPECT_GT(n_refused, 100);
}

}  // namespace
}  // namespace floc
