#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/places.h"
#include "support/run_arguments.h"
#include "support/states.h"

namespace floc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Changes the packing of 16 disks by `spoil` and runs `floc verify` on it.
template <class Spoil>
Outcome verify_spoiled(const Spoil& spoil) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("s.h5");
  EXPECT_EQ(floc_arguments({"convert", jambashbulk_file(), path}).code, 0);
  auto state = std::get<State<2>>(read_state(path));
  spoil(state);
  write_state(path, state);
  return floc_arguments({"verify", path, "--format", "json"});
}

/// Expects exit code 5, the names of the failed criteria, and a message on stderr.
void expect_failed(const Outcome& result, const std::string& criteria, const std::string& message) {
  EXPECT_EQ(result.code, 5);
  const auto row = nlohmann::json::parse(result.out).at(0);
  EXPECT_EQ(row["equilibrium"], false);
  EXPECT_EQ(row["failed"], criteria);
  EXPECT_THAT(result.err, AllOf(HasSubstr("s.h5"), HasSubstr(message)));
}

TEST(Verify, PassesARealPacking) {
  const Outcome result = verify_spoiled([](State<2>&) {});
  EXPECT_EQ(result.code, 0) << result.err;
  const auto row = nlohmann::json::parse(result.out).at(0);
  EXPECT_EQ(row["equilibrium"], true);
  EXPECT_LT(row["force"].get<double>(), 1e-11);
  EXPECT_LT(row["stress"].get<double>(), 1e-11);
  EXPECT_LT(row["mean_stress"].get<double>(), 1e-10);
  EXPECT_LT(row["boundary_balance"].get<double>(), 1e-11 * 1e-3);  // the bound is 1e-11 times the stress
  EXPECT_EQ(row["stability"], 0);
}

TEST(Verify, NamesTheGrainsOutOfBalance) {
  const auto result = verify_spoiled([](State<2>& s) {
    s.packing.grains.position[3][0] += 1e-5;
    find_contacts(s.packing);
  });
  expect_failed(result, "force stress mean_stress boundary_balance recorded", "force does not hold");
  EXPECT_THAT(result.err, HasSubstr("grain 3 with"));
}

TEST(Verify, NamesTheContactsThatTheListMisses) {
  const auto result = verify_spoiled([](State<2>& s) { s.packing.contacts.erase(s.packing.contacts.begin()); });
  EXPECT_EQ(result.code, 5);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("list does not hold"),
                    HasSubstr("are missing in the contact list although they interact at their gap of -")));
}

TEST(Verify, NamesTheContactsThatTheListHasTooMany) {
  expect_failed(verify_spoiled([](State<2>& s) {
                  Contact<2> far;
                  far.i = 0;
                  far.j = 1;
                  refresh_contact(s.packing, far);
                  s.packing.contacts.push_back(far);
                }),
                "list", "grains 0-1 are in the contact list although they do not interact at their gap of");
  const auto twice =
      verify_spoiled([](State<2>& s) { s.packing.contacts.push_back(s.packing.contacts.front()); });
  EXPECT_THAT(twice.err, HasSubstr("are in the contact list twice"));
}

TEST(Verify, NamesTheContactsWhoseGapOrForceIsNotThatOfThePositions) {
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.contacts[5].gap *= 1.001; }), "geometry",
                "geometry");
  expect_failed(
      verify_spoiled([](State<2>& s) { s.packing.contacts[5].normal = s.packing.contacts[6].normal; }),
      "geometry", "grains ");
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.contacts[5].normal_force *= 1.001; }), "law", "law");
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.contacts[5].kn = 2.0; }), "law", "by the stiffness");
}

TEST(Verify, MeasuresAgainstTheStressAndTheTolerancesAskedFor) {
  expect_failed(verify_spoiled([](State<2>& s) { s.target_stress[0] *= 1.001; }), "stress recorded",
                "sigma_1 = 0.001 but the target is 0.001001");
  EXPECT_EQ(verify_spoiled([](State<2>& s) {
              s.tolerance.stress = 2e-3, s.target_stress[0] *= 1.001;
              measure(s);
            }).code,
            0);
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.grains.velocity[0][0] = 1e-3; }), "energy recorded",
                "still moving");
}

TEST(Verify, HoldsTheStressThatTheFileRecordsAgainstTheForces) {
  for (const auto& [a, b] : {std::pair{0, 0}, std::pair{1, 1}, std::pair{0, 1}})
    expect_failed(verify_spoiled([&](State<2>& s) { s.stress(a, b) += 1e-9 * s.stress(0, 0); }), "mean_stress",
                  "recorded");
}

TEST(Verify, HoldsResidualsCountsAndFlagsThatTheFileRecordsAgainstWhatItFinds) {
  expect_failed(verify_spoiled([](State<2>& s) { s.residuals.force = 1e-8; }), "recorded",
                "residuals.force is recorded as 1e-08, but its value is");
  expect_failed(verify_spoiled([](State<2>& s) { s.residuals.energy = 1e-9; }), "recorded", "residuals.energy");
  expect_failed(verify_spoiled([](State<2>& s) { s.n_negative = 2; }), "recorded",
                "n_negative is recorded as 2, but its value is 0");
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.contacts[5].sliding = true; }), "recorded",
                "are recorded as sliding, but their forces show the opposite");
}

TEST(Verify, HoldsMassesAgainstTheDensityOfTheScene) {
  const std::string scene = "[scene]\ndimension = 2\n[grains]\ndensity = 2.0\n";
  const auto with_masses = [&](double factor) {
    return verify_spoiled([&](State<2>& s) {
      s.scene = scene;
      for (int i = 0; i < s.packing.grains.size(); ++i)
        s.packing.grains.mass[i] =
            2.0 * std::numbers::pi * s.packing.grains.radius[i] * s.packing.grains.radius[i];
      s.packing.grains.mass[3] *= factor;
    });
  };
  EXPECT_EQ(with_masses(1.0).code, 0);
  expect_failed(with_masses(1.5), "mass", "of grain 3, whose radius is");
}

/// The stress of the contacts is compared with the stress of the forces across the faces of the cell. They differ if a
/// contact is removed, or if it refers to the wrong periodic image of a grain, even if all other checks of the file
/// pass.
TEST(Verify, HoldsTheForcesAcrossTheFacesOfTheCellAgainstTheStress) {
  const auto expect_both = [](const Outcome& result) {
    EXPECT_EQ(result.code, 5);
    EXPECT_THAT(result.err, AllOf(HasSubstr("boundary_balance does not hold"), HasSubstr("across the faces")));
    EXPECT_THAT(result.err, HasSubstr("mean_stress does not hold"));
  };
  for (const bool crossing : {false, true}) {
    const auto chosen = [crossing](State<2>& s) {
      auto& contacts = s.packing.contacts;
      return std::find_if(contacts.begin(), contacts.end(), [&](const Contact<2>& c) {
        return c.image.isZero() != crossing && c.normal_force > 1e-4;
      });
    };
    expect_both(verify_spoiled([&](State<2>& s) { s.packing.contacts.erase(chosen(s)); }));
    expect_both(verify_spoiled([&](State<2>& s) {
      Contact<2>& c = *chosen(s);
      c.image[0] += 1;
      refresh_contact(s.packing, c);
    }));
    const Outcome remeasured = verify_spoiled([&](State<2>& s) {
      s.packing.contacts.erase(chosen(s));
      measure(s);
    });
    EXPECT_THAT(remeasured.err, HasSubstr("boundary_balance does not hold"));
    EXPECT_THAT(remeasured.err, Not(HasSubstr("mean_stress does not hold")));
  }
}

/// Four equal disks of diameter 1 form a chain across the cell, which closes to a ring through the periodic boundary.
/// Only attractions at a distance connect the disks, so the chain buckles if it is pushed sideways.
TEST(Verify, NamesAnUnstableState) {
  const ScratchDirectory scratch;
  State<2> s;
  s.packing.law += test::linear(1e5);
  s.packing.law += test::tail_adhesion(1.0, 1e-3);
  s.packing.cell.matrix << 4.002, 0.0, 0.0, 3.0;
  s.packing.grains = Grains<2>::with_size(4);
  for (int i = 0; i < 4; ++i) {
    s.packing.grains.position[i] = {1.0005 * i + 0.1, 1.0};
    s.packing.grains.radius[i] = 0.5;
    s.packing.grains.mass[i] = 1.0;
  }
  find_contacts(s.packing);
  s.target_stress.setZero();
  s.tolerance = {1.0, 1.0, 10.0, 1.0};
  measure(s);
  write_state(scratch.file("s.h5"), s);
  expect_failed(floc_arguments({"verify", scratch.file("s.h5"), "--format", "json"}), "stability",
                "negative eigenvalue");
}

TEST(Verify, NamesTolerancesThatAnyPackingMeetsAndABoundaryThatMoves) {
  for (const double tolerance : {1e3, std::numeric_limits<double>::infinity(), 0.0})
    EXPECT_THAT(verify_spoiled([&](State<2>& s) { s.tolerance.moment = tolerance; }).err,
                testing::AnyOf(HasSubstr("tolerances does not hold"), HasSubstr("equilibrium/tolerances")));
  expect_failed(verify_spoiled([](State<2>& s) { s.packing.cell.velocity(0, 0) = 1.0; }), "boundary_motion",
                "the cell is still being deformed");
}

TEST(Verify, OfManyExitsWithTheWorst) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("good.h5")}).code, 0);
  write_state(scratch.file("bad.h5"), busy_state<3>());
  const auto two = floc_arguments({"verify", scratch.file("bad.h5"), scratch.file("good.h5")});
  EXPECT_EQ(two.code, 5);
  EXPECT_EQ(std::count(two.out.begin(), two.out.end(), '\n'), 3);
  const auto three =
      floc_arguments({"verify", scratch.file("bad.h5"), scratch.file("none.h5"), scratch.file("good.h5")});
  EXPECT_EQ(three.code, 4);
  EXPECT_EQ(three.out, two.out);
}

}  // namespace
}  // namespace floc::test
