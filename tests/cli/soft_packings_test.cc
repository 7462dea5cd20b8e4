#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "floc/io/law_text.h"
#include "support/law_list.h"
#include "support/places.h"
#include "support/run_arguments.h"

/// Tests of grains that are much too soft for the pressure, as if the stiffness were given in a wrong unit. The tests
/// use every law in 2D and 3D, and every command that may read such grains.
namespace floc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::map<std::string, double> kNumbers = {{"normal.stiffness", 100.0},
                                                {"normal.modulus", 1e4},
                                                {"normal.poisson", 0.3},
                                                {"adhesion.force", 0.25},
                                                {"adhesion.range", 1e-2},
                                                {"adhesion.surface_tension", 0.1},
                                                {"adhesion.contact_angle", 20.0},
                                                {"adhesion.water_content", 1e-3},
                                                {"adhesion.density_ratio", 2.5},
                                                {"damping.restitution", 0.1},
                                                {"damping.critical_fraction", 0.8},
                                                {"friction.coefficient", 0.5},
                                                {"friction.stiffness", 80.0},
                                                {"rolling.coefficient", 0.05},
                                                {"rolling.stiffness", 3.0},
                                                {"twisting.coefficient", 0.04},
                                                {"twisting.stiffness", 2.0}};

/// Returns the tables of a scene that describe the law.
std::string contact_tables(LawParameters law) {
  std::string text = "[contact]\n";
  for (const DeclaredSlot& slot : declared_slots())
    if (const int k = slot.present(law); k >= 0)
      text += fmt::format("{}.law = \"{}\"\n", slot.key, slot.models[static_cast<std::size_t>(k)].keyword);
  for (const LawNumber& number : numbers_of(law)) text += fmt::format("{} = {}\n", number.key, *number.value);
  if (law.damping.holds<ViscousDamping>()) text += "damping.mass = \"effective\"\n";
  return text;
}

/// Scene of a few equal grains under a pressure that gives a mean overlap of about a tenth of a radius.
std::string soft_scene(const Law& law, int dimension) {
  const double pressure = law.contact_modulus(dimension, 1.0) / (law.force_exponent() != 1.0 ? 180.0 : 12.0);
  return fmt::format(
      "[scene]\ndimension = {}\nunits = \"reduced\"\n[grains]\ncount = 8\ndiameter = {{distribution = "
      "\"constant\", value = "
      "1.0}}\n{}"
      "[cell]\nsolid_fraction = 0.3\ninertial_number_cap = 0.1\n[assembly]\nprotocol = \"direct\"\npressure = "
      "{}\n[equilibrium]\nforce = 1e-3\nmoment = 1e-3\nstress = 1e-2\nenergy = 1e-3\nmax_time = 3000\n",
      dimension, contact_tables(law), pressure);
}

/// Rows of a table of grains of radius 1/2 on a square or cubic lattice. Neighbours along the first axis overlap by
/// 0.14 radii.
std::string lattice_rows(int dimension) {
  std::string rows = "x,y,z,radius\n";
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < (dimension == 3 ? 3 : 1); ++k)
        rows += fmt::format("{},{},{},0.5\n", 0.93 * i, 0.99 * j, 0.99 * k);
  return rows;
}

class SoftPackings : public testing::Test {
 protected:
  /// Expects that the message of a command says that grains overlap too much, and asks the user to check the units.
  /// @param words  another part of the message
  void expect_said(const std::vector<std::string>& arguments, const std::string& words,
                   const std::string& question = "consistent with the units of lengths and forces?") {
    const Outcome o = floc_arguments(arguments);
    EXPECT_THAT(o.err, AllOf(HasSubstr(words), HasSubstr(question))) << arguments[0];
    EXPECT_THAT(o.code, testing::AnyOf(0, 3, 5)) << o.err;
    ++n_said_;
  }

  void meet(const Law& law, int dimension) {
    SCOPED_TRACE(fmt::format("{} in {}D", law_text(law), dimension));
    const std::string overlap = "% of the contacts overlap by more than a tenth of a radius";
    write_text(scratch_.file("g.csv"), lattice_rows(dimension));
    // Rigid contacts have no stiffness, so their message cannot ask for the units of a stiffness.
    const std::string question = law.is_rigid() ? "are the positions and the radii in the same unit of length?"
                                                : "consistent with the units of lengths and forces?";
    expect_said({"convert", scratch_.file("g.csv"), scratch_.file("s.h5"), "--overwrite", "--law",
                 law_text(law), "--cell", dimension == 2 ? "2.79,0;0,2.97" : "2.79,0,0;0,2.97,0;0,0,2.97"},
                overlap, question);
    if (law.is_rigid()) return;
    expect_said({"verify", scratch_.file("s.h5")}, overlap);
    expect_said({"moduli", scratch_.file("s.h5"), "--force"}, overlap);
    write_text(scratch_.file("s.toml"), soft_scene(law, dimension));
    expect_said({"scene", "check", scratch_.file("s.toml")}, "grains in contact would overlap by about 0.");
    if (!law.has_damping()) return;  // without damping, a gas takes too long to come to rest
    std::filesystem::remove_all(scratch_.file("run"));
    expect_said({"run", scratch_.file("s.toml"), "-o", scratch_.file("run")}, "  warning: ");
    ++n_run_;
  }

  ScratchDirectory scratch_;
  int n_said_ = 0, n_run_ = 0;
};

TEST_F(SoftPackings, OfEveryLawAreSaidToBeByEveryCommand) {
  int n_laws = 0;
  for (const int dimension : {2, 3})
    for (const Law& law : all_laws(dimension, kNumbers)) {
      meet(law, dimension);
      ++n_laws;
    }
  fmt::print("{} laws of 2D and 3D by convert, verify, moduli and scene check, {} by run: {} warnings\n",
             n_laws, n_run_, n_said_);
  EXPECT_GT(n_laws, 40);
}

TEST_F(SoftPackings, OfASlipOfUnitsAreSaidToBeDenserThanCanBe) {
  const std::string slip = source_directory() + "/data/scenes/cohesionless_cycle.toml";
  const Outcome check = floc_arguments({"scene", "check", slip, "--set", "contact.normal.stiffness=1e-2"});
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.err, AllOf(HasSubstr("grains in contact would overlap by about"),
                               HasSubstr("is K_N = 0.01 consistent with the units")));
}

TEST_F(SoftPackings, OfEqualGrainsAreHeldAgainstTheDensestThereAre) {
  const auto said = [&](double spacing) {
    write_text(scratch_.file("g.csv"),
               fmt::format("x,y,radius\n0,0,0.5\n{},{},0.5\n", spacing / 2, spacing * std::sqrt(3.0) / 2));
    return floc_arguments({"convert", scratch_.file("g.csv"), scratch_.file("t.h5"), "--overwrite", "--law",
                           "normal.stiffness=1000", "--cell",
                           fmt::format("{},0;0,{}", spacing, spacing * std::sqrt(3.0))})
        .err;
  };
  EXPECT_THAT(said(0.999), Not(HasSubstr("the solid fraction is")));
  EXPECT_THAT(said(0.98),
              AllOf(HasSubstr("the solid fraction is 0.9443, but equal disks that do not overlap fill "
                              "at most 0.9069"),
                    Not(HasSubstr("a tenth of a radius"))));
}

/// A cluster that does not span the cell and is not under stress has no stiffness. In an earlier version, Newton steps
/// moved such a cluster into its own images, and 172 pairs were then missing in the list of contacts.
TEST_F(SoftPackings, OfAClusterUnderNoStressListAllOfTheirContacts) {
  const std::string out = scratch_.file("cluster");
  const Outcome made =
      floc_arguments({"run", source_directory() + "/data/scenes/demo.toml", "-o", out, "--until", "0", "--set",
                      "grains.count=60", "--set", "contact.normal.stiffness=10"});
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = floc_arguments({"verify", out + "/state-0000.h5"});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

}  // namespace
}  // namespace floc::test
