#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "floc/base/read_file.h"
#include "floc/io/hdf5_file.h"
#include "floc/io/state_file.h"
#include "support/places.h"
#include "support/run_arguments.h"
#include "support/sealed.h"
#include "support/states.h"

namespace floc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kScripts = source_directory() + "/tests/cli/";
/// Interpreter for which Debian installs python3-h5py.
const std::string kPython = "/usr/bin/python3";

TEST(StateFromPython, HasGapsForcesAndStressAsTheContractSays) {
  const ScratchDirectory scratch;
  write_state(scratch.file("2.h5"), busy_state<2>());
  write_state(scratch.file("3.h5"), busy_state<3>());
  for (const char* name : {"2.h5", "3.h5"}) {
    const Outcome result = run_arguments(kPython, {kScripts + "read_state.py", scratch.file(name)});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("3 grains, 3 contacts"));
  }
}

TEST(StateFromPython, OfARealPackingIsInEquilibrium) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5")}).code, 0);
  const Outcome result = run_arguments(kPython, {kScripts + "read_state.py", scratch.file("s.h5"), "1e-11"});
  EXPECT_EQ(result.code, 0) << result.err;
}

TEST(StateFromPython, ThatContradictsItselfIsFoundOut) {
  const ScratchDirectory scratch;
  State<2> s = busy_state<2>();
  s.packing.contacts[1].normal_force *= 1.0 + 1e-6;
  write_state(scratch.file("s.h5"), s);
  const Outcome result = run_arguments(kPython, {kScripts + "read_state.py", scratch.file("s.h5")});
  EXPECT_NE(result.code, 0);
  EXPECT_THAT(result.err, HasSubstr("normal_force: recomputed and stated differ"));
}

TEST(VtkHdfFromPython, HasVtksLayoutAndBalancedForces) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.vtkhdf")}).code, 0);
  const Outcome result =
      run_arguments(kPython, {kScripts + "read_vtkhdf.py", scratch.file("s.vtkhdf"), "1e-11"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("28 points, 49 cells"));
}

TEST(VtkHdfFromPython, IsReadByVtk) {
  const ScratchDirectory scratch;
  if (run_arguments(kPython, {"-c", "import vtkmodules.vtkIOHDF"}).code != 0)
    GTEST_SKIP() << "VTK is not installed";
  write_state(scratch.file("box.h5"), boxed_state<3>());
  ASSERT_EQ(floc_arguments({"convert", scratch.file("box.h5"), scratch.file("box.vtkhdf")}).code, 0);
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("disks.vtkhdf")}).code, 0);
  for (const std::string name : {"box.vtkhdf", "disks.vtkhdf"}) {
    const Outcome result = run_arguments(kPython, {kScripts + "read_vtkhdf.py", scratch.file(name), "1e9"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("read by VTK")) << name;
  }
}

TEST(BadState, WithoutAnyOfItsPartsIsRefusedByThePartsName) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const Outcome result = run_arguments(
      kPython, {kScripts + "take_parts_away.py", floc_program(), scratch.file("s.h5"), scratch.path()});
  EXPECT_EQ(result.code, 0) << result.err;
}

/// Writes a file that contains only the header of a state, after `change` has changed it, and runs `floc info` on this
/// file.
template <class Change>
Outcome info_of_header(const std::string& format, std::int64_t version, std::int64_t dimension,
                       const Change& change) {
  const ScratchDirectory scratch;
  const std::string bare = scratch.file("bare.h5");
  Hdf5Writer file(bare);
  file.attribute("/", "format", format);
  file.attribute("/", "version", version);
  file.attribute("/", "dimension", dimension);
  file.attribute("/", "units", std::string("reduced"));
  file.attribute("/", "sign_convention", std::string("compression_positive"));
  change(file);
  file.close();
  std::ofstream(scratch.file("s.h5"), std::ios::binary) << test::sealed(read_file(bare));
  return floc_arguments({"info", scratch.file("s.h5")});
}

TEST(BadState, OfAnotherFormatVersionOrShapeIsRefusedWithExitCode4) {
  const auto nothing = [](Hdf5Writer&) {};
  const auto expect_refusal = [](const Outcome& result, const std::string& message) {
    EXPECT_EQ(result.code, 4);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, AllOf(HasSubstr("s.h5"), HasSubstr(message)));
  };
  expect_refusal(info_of_header("other-state", 1, 2, nothing),
                 "format = \"other-state\", expected \"floc-state\"");
  expect_refusal(info_of_header("floc-state", 3, 2, nothing),
                 "version = 3: the file was written by a newer floc");
  expect_refusal(info_of_header("floc-state", 0, 2, nothing), "version = 0");
  expect_refusal(info_of_header("floc-state", 1, 4, nothing), "dimension = 4, expected 2 or 3");
  expect_refusal(info_of_header("floc-state", 1, 2, nothing), ":/cell/matrix: this dataset is missing");
  expect_refusal(info_of_header("floc-state", 1, 2,
                                [](Hdf5Writer& file) {
                                  file.group("cell");
                                  file.array("cell/matrix", {3, 3}, std::vector<double>(9, 1.0));
                                }),
                 ":/cell/matrix: the shape of the dataset is (3, 3), expected (2, 2)");
  expect_refusal(info_of_header("floc-state", 1, 2,
                                [](Hdf5Writer& file) {
                                  file.group("cell");
                                  file.array("cell/matrix", {2, 2}, std::vector<std::int32_t>(4, 1));
                                }),
                 ":/cell/matrix: the dataset contains values of another type, expected real numbers");
}

TEST(BadState, CutShortOrForeignIsRefusedWithExitCode4) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string whole = read_file(scratch.file("s.h5"));
  std::ofstream(scratch.file("cut.h5"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  std::ofstream(scratch.file("text.h5")) << "not a state";
  for (const char* command : {"info", "verify"}) {
    const Outcome cut = floc_arguments({command, scratch.file("cut.h5")});
    EXPECT_EQ(cut.code, 4);
    EXPECT_THAT(cut.err, AllOf(HasSubstr("cut.h5"), HasSubstr("truncated")));
    const Outcome text = floc_arguments({command, scratch.file("text.h5")});
    EXPECT_EQ(text.code, 4);
    EXPECT_THAT(text.err, AllOf(HasSubstr("text.h5"), HasSubstr("not an HDF5 file")));
    EXPECT_EQ(floc_arguments({command, scratch.path()}).code, 4);
    EXPECT_EQ(floc_arguments({command}).code, 2);
  }
}

}  // namespace
}  // namespace floc::test
