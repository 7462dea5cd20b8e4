#include "floc/io/jambashbulk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "support/places.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kPacking = test::source_directory() + "/data/packings/disks/disks16.txt";

State<2> read(const std::string& path, int index = 0) {
  ImportOptions options;
  options.index = index;
  return std::get<State<2>>(read_jambashbulk(path, options).state);
}

TEST(Jambashbulk, PackingIsTheEquilibriumThatWasWritten) {
  State<2> state = read(kPacking);
  find_contacts(state.packing);
  // The program (floc moduli and floc network) prints the same values: 33 contacts (z = 4.125), solid fraction
  // 0.81991651554.
  const Mat<2> stress = static_stress(state.packing);
  EXPECT_NEAR(stress(0, 0), 1e-3, 1e-12);
  EXPECT_NEAR(stress(1, 1), 1e-3, 1e-12);
  EXPECT_NEAR(stress(0, 1), 2.91239e-5, 1e-10);
  EXPECT_EQ(state.packing.contacts.size(), 33u);
  EXPECT_NEAR(solid_fraction(state.packing), 0.8199165155404775, 1e-15);
  EXPECT_EQ(state.target_stress, Vec<2>(1e-3, 1e-3));
  // Distances of about 1 have rounding errors of 2e-16. The forces computed from them are about 1e-3 and balance within
  // 1e-12.
  EXPECT_LT(residuals(state.packing, state.target_stress).force, 1e-11);
}

TEST(Jambashbulk, CellAndGrainsAreThoseOfTheFileInsideTheCell) {
  const State<2> state = read(kPacking);
  EXPECT_EQ(state.packing.cell.matrix(0, 0), 9.284422065389327);
  EXPECT_EQ(state.packing.cell.matrix(0, 1), 0.0);
  EXPECT_EQ(state.packing.cell.matrix(1, 0), 9.284422065389327);
  EXPECT_EQ(state.packing.grains.position[0], Vec<2>(18.061957410976113, 9.451639042727859));
  EXPECT_EQ(state.packing.grains.radius[2], 1.4);
  EXPECT_EQ(state.packing.grains.mass[0], 4.0);
  for (const Vec<2>& x : state.packing.grains.position) {
    const Vec<2> s = state.packing.cell.reduced(x);
    EXPECT_TRUE((s.array() >= 0.0).all() && (s.array() < 1.0).all());
  }
}

/// Writes a copy of the packing file in which one piece of the text is replaced.
/// @return path of the copy
std::string spoiled(const test::ScratchDirectory& scratch, const std::string& piece, const std::string& by) {
  std::string text = read_file(kPacking);
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  text.replace(at, piece.size(), by);
  std::ofstream(scratch.file("p.txt")) << text;
  return scratch.file("p.txt");
}

TEST(Jambashbulk, OneOfSeveralPackingsIsChosenByIndex) {
  const test::ScratchDirectory scratch;
  const std::string second = read_file(spoiled(scratch, "18.061957410976113", "17.5"));
  std::ofstream(scratch.file("both.txt")) << read_file(kPacking) << "\n" << second;
  EXPECT_EQ(read(scratch.file("both.txt"), 0).packing.grains.position[0][0], 18.061957410976113);
  EXPECT_EQ(read(scratch.file("both.txt"), 1).packing.grains.position[0][0], 17.5);
  EXPECT_THAT([&] { read(scratch.file("both.txt"), 2); },
              ThrowsMessage<InputError>(HasSubstr("index = 2, but the file contains packings 0 to 1")));
}

TEST(Jambashbulk, NamesFileAndLineOfWhatIsMalformed) {
  const test::ScratchDirectory scratch;
  const auto refusal = [&](const std::string& piece, const std::string& by) {
    return [path = spoiled(scratch, piece, by)] { read(path); };
  };
  EXPECT_THAT(refusal("9.451639042727859", "seven"),
              ThrowsMessage<InputError>(HasSubstr("p.txt:5: the line contains \"seven\"")));
  EXPECT_THAT(refusal("9.451639042727859 ,", ""),
              ThrowsMessage<InputError>(HasSubstr("p.txt:5: the line has 2 numbers")));
  EXPECT_THAT(refusal("9.451639042727859", "nan"), ThrowsMessage<InputError>(HasSubstr("\"nan\"")));
  EXPECT_THAT(refusal("1.0 ,", "-1.0 ,"), ThrowsMessage<InputError>(HasSubstr("must be positive")));
  EXPECT_THAT(refusal("N = 16", "N = 17"),
              ThrowsMessage<InputError>(HasSubstr("has 16 grains, but its header says N = 17")));
  EXPECT_THAT(refusal("N = 16", "N = 1.5"), ThrowsMessage<InputError>(HasSubstr("p.txt:3: N = 1.5")));
  EXPECT_THAT(refusal("P0=", "Q0="), ThrowsMessage<InputError>(HasSubstr("P0 is missing")));
  EXPECT_THAT(
      refusal("9.772531100405857 }", "}"),
      ThrowsMessage<InputError>(HasSubstr("L2 in the header of the packing has 1 numbers, expected 2")));
  EXPECT_THAT(refusal("9.772531100405857", "0"), ThrowsMessage<InputError>(HasSubstr("span no area")));
  EXPECT_THAT(refusal("18.061957410976113", "1e11"),
              ThrowsMessage<InputError>(HasSubstr(
                  "p.txt:5: the grain at (100000000000, 9.451639042727859) lies more than 1e9 cells away")));
  EXPECT_THAT(refusal("L1=", "L3="), ThrowsMessage<InputError>(HasSubstr("no packing of jamBashbulk")));
}

TEST(Jambashbulk, RefusesALawOfAnotherMind) {
  ImportOptions options;
  options.law = Law{};
  EXPECT_THROW(read_jambashbulk(kPacking, options), InputError);
}

}  // namespace
}  // namespace floc
