#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "support/contact_laws.h"
#include "support/few_grains.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Fixture: a scratch directory in which packing.h5 is a packing of 16 disks.
class ModuliCommand : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_arguments(floc_program(), {"convert", jambashbulk_file(), scratch_.file("packing.h5")}).code,
              0);
  }
  Outcome moduli(const std::string& arguments) const {
    return run_floc("moduli " + arguments, scratch_.path());
  }

  ScratchDirectory scratch_;
};

TEST_F(ModuliCommand, HasTheColumnsOfTheContractFirst) {
  const Outcome o = moduli("packing.h5 --format csv");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(o.out,
              StartsWith("file,dimension,n_grains,n_contacts,n_distant,P,P_star,phi,z,C11,C22,C12,B,B_S,G,"
                         "isotropy_defect,B_voigt,G_voigt,B_reuss,B_voigt_printed,G_voigt_printed,"
                         "B_reuss_printed,Z2,n_negative,n_mechanisms,n_coupled_mechanisms,residual,"
                         "condition,seconds,"));
  EXPECT_THAT(o.out, HasSubstr("\npacking.h5,2,16,33,0,"));
}

TEST_F(ModuliCommand, TakeNoLongerThanTheirRows) {
  int n_rows = 0;
  for (const char* options : {"", "--method iterative", "--method bounds", "--method single-factor",
                              "--prestress", "--accuracy B=1e-6", "--rolling-stiffness 0,0.1"}) {
    const Outcome o = moduli(std::string("packing.h5 packing.h5 --format json ") + options);
    ASSERT_EQ(o.code, 0) << options << o.err;
    for (const json& row : json::parse(o.out)) {
      EXPECT_GT(row.at("seconds").get<double>(), 0.0) << options;
      EXPECT_GE(row.at("seconds_row").get<double>(), row.at("seconds").get<double>()) << options;
      ++n_rows;
    }
  }
  std::cout << n_rows << " rows of 7 sets of options\n";
  EXPECT_EQ(n_rows, 16);
}

TEST_F(ModuliCommand, OfAConvertedPackingGiveItsShearModulus) {
  const Outcome o = moduli("packing.h5 --prestress --strains full --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  // The test validation.FormatOfJamBashbulk checks this value against the stresses of two strained states.
  EXPECT_NEAR(row.at("C33").get<double>(), 0.0498734432608, 1e-12);
  EXPECT_EQ(row.at("G_shear"), row.at("C33"));
  EXPECT_NEAR(row.at("P").get<double>(), 1e-3, 1e-12);
  EXPECT_EQ(row.at("units"), "reduced");
  for (const char* key : {"C13", "C23", "B_without_prestress", "G_without_prestress"})
    EXPECT_TRUE(row.at(key).is_number()) << key;
  const json diagonal = json::parse(moduli("packing.h5 --format json").out).at(0);
  EXPECT_FALSE(diagonal.contains("C33"));
  EXPECT_TRUE(diagonal.at("G_shear").is_null());
  // The two calls solve for different numbers of strains at a time (two and three). The BLAS library may therefore
  // round differently.
  EXPECT_NEAR(diagonal.at("B").get<double>() / row.at("B_without_prestress").get<double>(), 1.0, 1e-13);
}

/// Young's moduli E_1 and E_2, for a strain along one axis at constant stress on the other axis, follow from the
/// compliance S = C^-1.
TEST_F(ModuliCommand, AreToldAxisByAxis) {
  const json row = json::parse(moduli("packing.h5 --format json").out).at(0);
  const auto number = [&](const char* key) { return row.at(key).get<double>(); };
  const double C11 = number("C11"), C22 = number("C22"), C12 = number("C12");
  EXPECT_NEAR(number("E_1") / (C11 - C12 * C12 / C22), 1.0, 1e-12);
  EXPECT_NEAR(number("E_2") / (C22 - C12 * C12 / C11), 1.0, 1e-12);
  EXPECT_NEAR(number("nu_12") / (C12 / C22), 1.0, 1e-12);
  EXPECT_NEAR(number("nu_21") / (C12 / C11), 1.0, 1e-12);
  // If shear strains are free (--strains full), axial moduli are lower.
  const json full = json::parse(moduli("packing.h5 --strains full --format json").out).at(0);
  EXPECT_LT(full.at("E_1").get<double>(), number("E_1"));
}

TEST_F(ModuliCommand, HaveMeanFieldEstimatesBesideTheBounds) {
  // B_reuss_mean_field takes account of unequal springs, B_reuss_printed does not. Here all springs are equal, so the
  // two values agree.
  const json row = json::parse(moduli("packing.h5 --format json").out).at(0);
  const auto number = [&](const char* key) { return row.at(key).get<double>(); };
  EXPECT_NEAR(number("B_reuss_mean_field") / number("B_reuss_printed"), 1.0, 1e-12);
  EXPECT_NEAR(number("G_voigt_smooth_mean_field") / number("B_voigt_printed"), 0.5, 1e-12);
  EXPECT_GT(number("Z_hat"), 1.0);
}

TEST_F(ModuliCommand, OfManyStatesSkipTheBadOneAndSaySo) {
  write_text(scratch_.file("text.h5"), "not a state");
  const Outcome o = moduli("packing.h5 none.h5 text.h5 packing.h5 --format csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("none.h5: No such file"));
  EXPECT_THAT(o.err, HasSubstr("text.h5: "));
  EXPECT_EQ(std::count(o.out.begin(), o.out.end(), '\n'), 3);
}

TEST_F(ModuliCommand, ComeWithBoundsOfTheirErrors) {
  const Outcome o = moduli("packing.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  for (const auto& [modulus, error] : {std::pair{"B", "error_B"}, {"B_S", "error_B_S"}, {"G", "error_G"}}) {
    EXPECT_GT(row.at(error).get<double>(), 0.0);
    EXPECT_LT(row.at(error).get<double>(), 1e-10 * row.at(modulus).get<double>());
  }
  EXPECT_GE(row.at("error_C").get<double>(), row.at("error_B").get<double>());
  const Outcome strict = moduli("packing.h5 --tolerance 1e-20");
  EXPECT_EQ(strict.code, 0);
  EXPECT_THAT(strict.err, HasSubstr("packing.h5: warning: the relative error bound of B or G is "));
  EXPECT_THAT(strict.err, HasSubstr("above the tolerance of 1.0e-20"));
}

TEST_F(ModuliCommand, GiveARowForEachRollingStiffness) {
  const Outcome o = moduli("packing.h5 --rolling-stiffness 0,1e-3 --rolling-stiffness 2 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("rolling_stiffness"), 0.0);
  EXPECT_EQ(rows[1].at("rolling_stiffness"), 1e-3);
  EXPECT_EQ(rows[2].at("rolling_stiffness"), 2.0);
}

/// Two grains touch each other and nothing else, so the cell can be strained without elastic energy.
TEST_F(ModuliCommand, AreZeroAlongAMechanismThatIsCountedAndWarnedAbout) {
  State<2> pair;
  pair.packing = unit_grains<2>({{1.0, 1.0}, {2.0 - 0x1p-10, 1.0}}, 4.0,
                                law_of({linear(1.0), constant_adhesion(0x1p-10)}));
  find_contacts(pair.packing);
  write_state(scratch_.file("pair.h5"), pair);
  const Outcome o = moduli("pair.h5 --format json");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err,
              HasSubstr("pair.h5: warning: 2 mechanism(s) change the strain of the cell without resistance"));
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("n_coupled_mechanisms"), 2);
  for (const char* key : {"C11", "C22", "C12", "B", "B_S", "G"}) EXPECT_EQ(row.at(key), 0.0) << key;
  // The elastic force of the only contact cancels the adhesion exactly. The pressure is therefore zero, and there is no
  // scale of forces.
  EXPECT_EQ(row.at("B_reuss"), 0.0);
  EXPECT_TRUE(row.at("Z2").is_null());
}

TEST_F(ModuliCommand, RefuseWhatNoModuliCanBeOf) {
  EXPECT_EQ(moduli("").code, 2);
  EXPECT_EQ(moduli("packing.h5 --strains shear").code, 2);
  EXPECT_EQ(moduli("packing.h5 --rolling-stiffness 1,stiff").code, 2);
  const Outcome negative = moduli("packing.h5 --rolling-stiffness=-1");
  EXPECT_EQ(negative.code, 4);
  EXPECT_THAT(negative.err, HasSubstr("--rolling-stiffness = -1: must be >= 0"));
  EXPECT_EQ(moduli("packing.h5 --tolerance=-1").code, 4);
  EXPECT_EQ(moduli("packing.h5 --tolerance=0").code, 4);
  EXPECT_EQ(moduli("packing.h5 --force-tolerance=-1").code, 4);
}

}  // namespace
}  // namespace floc::test
