#include "floc/io/state_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/liquid/liquid.h"
#include "support/contact_laws.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"
#include "support/sealed.h"
#include "support/springs.h"
#include "support/states.h"

namespace floc {
namespace {

using test::busy_state;
using test::ScratchDirectory;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Returns the message with which read_state() refuses a file, or "" if it accepts the file.
std::string refusal(const std::string& path) {
  return test::message_of([&] { read_state(path); });
}

template <int Dim>
void expect_same_contacts(const Packing<Dim>& a, const Packing<Dim>& b) {
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const Contact<Dim>& c = a.contacts[k];
    const Contact<Dim>& d = b.contacts[k];
    EXPECT_EQ(std::tie(c.i, c.j, c.key, c.gap, c.normal_force, c.elastic_force, c.kn, c.kt, c.kr),
              std::tie(d.i, d.j, d.key, d.gap, d.normal_force, d.elastic_force, d.kn, d.kt, d.kr));
    EXPECT_EQ(std::tie(c.sliding, c.rolling_yield, c.distant), std::tie(d.sliding, d.rolling_yield, d.distant));
    EXPECT_EQ(c.image, d.image);
    EXPECT_EQ(c.normal, d.normal);
    EXPECT_EQ(c.shear_force, d.shear_force);
    EXPECT_EQ(c.rolling_moment, d.rolling_moment);
    EXPECT_EQ(std::tie(c.twisting_moment, c.ktw, c.twisting_yield),
              std::tie(d.twisting_moment, d.ktw, d.twisting_yield));
    EXPECT_EQ(c.history, d.history);
    EXPECT_EQ(test::shear_spring(c), test::shear_spring(d));
    EXPECT_EQ(test::rolling_spring(c), test::rolling_spring(d));
  }
}

template <int Dim>
void expect_same_grains(const Packing<Dim>& a, const Packing<Dim>& b) {
  EXPECT_EQ(a.cell.matrix, b.cell.matrix);
  EXPECT_EQ(a.cell.velocity, b.cell.velocity);
  EXPECT_EQ(a.grains.position, b.grains.position);
  EXPECT_EQ(a.grains.velocity, b.grains.velocity);
  EXPECT_EQ(a.grains.radius, b.grains.radius);
  EXPECT_EQ(a.grains.mass, b.grains.mass);
  EXPECT_EQ(a.grains.angular_velocity, b.grains.angular_velocity);
  for (int i = 0; i < a.grains.size(); ++i) {
    if constexpr (Dim == 2) {
      EXPECT_EQ(a.grains.orientation[i], b.grains.orientation[i]);
    } else {
      EXPECT_EQ(a.grains.orientation[i].coeffs(), b.grains.orientation[i].coeffs());
    }
  }
}

template <class Dimension>
class StateFile : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(StateFile, Dimensions);

TYPED_TEST(StateFile, GivesBackEveryNumberThatWasWritten) {
  constexpr int kDim = TypeParam::value;
  const ScratchDirectory scratch;
  const State<kDim> s = busy_state<kDim>();
  ASSERT_EQ(s.packing.contacts.size(), 3u);
  write_state(scratch.file("s.h5"), s);
  const auto back = std::get<State<kDim>>(read_state(scratch.file("s.h5")));
  expect_same_grains(s.packing, back.packing);
  expect_same_contacts(s.packing, back.packing);
  EXPECT_EQ(back.packing.law, s.packing.law);
  EXPECT_EQ(back.target_stress, s.target_stress);
  EXPECT_EQ(back.stress, s.stress);
  EXPECT_EQ(back.tolerance, s.tolerance);
  EXPECT_EQ(back.n_negative, s.n_negative);
  EXPECT_EQ(back.scene, s.scene);
  EXPECT_EQ(std::tie(back.residuals.force, back.residuals.moment, back.residuals.stress, back.residuals.energy),
            std::tie(s.residuals.force, s.residuals.moment, s.residuals.stress, s.residuals.energy));
  EXPECT_EQ(back.residuals.worst_force_grain, s.residuals.worst_force_grain);
  EXPECT_EQ(back.residuals.worst_moment_grain, s.residuals.worst_moment_grain);
  EXPECT_EQ(std::tie(back.path.step, back.path.branch, back.path.time, back.path.n_steps, back.path.ending),
            std::tie(s.path.step, s.path.branch, s.path.time, s.path.n_steps, s.path.ending));
  const Provenance& p = s.provenance;
  const Provenance& q = back.provenance;
  EXPECT_EQ(std::tie(p.program, p.commit, p.compiler, p.seed, p.stream_state, p.parent_sha256, p.source),
            std::tie(q.program, q.commit, q.compiler, q.seed, q.stream_state, q.parent_sha256, q.source));
}

TYPED_TEST(StateFile, OfIdenticalStatesIsIdentical) {
  constexpr int kDim = TypeParam::value;
  const ScratchDirectory scratch;
  write_state(scratch.file("a.h5"), busy_state<kDim>(), "progress");
  const std::vector<char> disturbed_heap(1 << 22, 'x');
  write_state(scratch.file("b.h5"), busy_state<kDim>(), "progress");
  EXPECT_EQ(read_file(scratch.file("a.h5")), read_file(scratch.file("b.h5")));
}

TYPED_TEST(StateFile, HoldsAPackingWithoutContactsOrPhysicsInItsSlots) {
  constexpr int kDim = TypeParam::value;
  const ScratchDirectory scratch;
  State<kDim> s = busy_state<kDim>();
  s.packing.contacts.clear();
  s.packing.law = Law{};
  s.packing.law += test::linear(2.0);
  s.residuals.force = std::numeric_limits<double>::infinity();
  write_state(scratch.file("s.h5"), s);
  const auto back = std::get<State<kDim>>(read_state(scratch.file("s.h5")));
  EXPECT_TRUE(back.packing.contacts.empty());
  EXPECT_EQ(back.packing.law, s.packing.law);
  EXPECT_EQ(back.residuals.force, s.residuals.force);
}

/// Returns two glass beads in contact.
/// @param overlap  overlap divided by the radius
State<3> pressed_beads(double overlap) {
  State<3> s = busy_state<3>();
  s.packing.law = Law{};
  s.packing.law += test::hertz(70.0, 0.3);
  s.packing.contacts.resize(1);
  s.packing.contacts[0] = Contact<3>{};
  s.packing.contacts[0].j = 1;
  s.packing.contacts[0].gap = -overlap * s.packing.grains.radius[1];
  return s;
}

/// Returns the message with which the reader refuses a written state; empty if the reader accepts the state.
template <int Dim>
std::string refusal_of(const State<Dim>& state, const std::string& progress = "") {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), state, progress);
  return refusal(scratch.file("s.h5"));
}

TEST(StateFile, OfBeadsThatOverlapTooMuchIsRefusedUnlessTheyMove) {
  EXPECT_EQ(refusal_of(pressed_beads(0.09)), "");
  EXPECT_THAT(refusal_of(pressed_beads(0.2)),
              HasSubstr("contacts/gap: the mean overlap of the contacts is 0.2 of a radius"));
  EXPECT_EQ(refusal_of(pressed_beads(0.2), "in motion"), "");
}

TEST(StateFile, OfDisksUnderALawOfSpheresIsRefused) {
  State<2> s = busy_state<2>();
  s.packing.contacts.clear();
  s.packing.law = Law{};
  s.packing.law += test::hertz(70.0, 0.3);
  EXPECT_THAT(refusal_of(s), HasSubstr("contact.normal.law = \"hertz\": this model is for spheres"));
}

TYPED_TEST(StateFile, KeepsTheLiquidOfAWetPacking) {
  constexpr int kDim = TypeParam::value;
  const ScratchDirectory scratch;
  write_state(scratch.file("dry.h5"), busy_state<kDim>());
  EXPECT_EQ(read_file(scratch.file("dry.h5")).find("surface_tension"), std::string::npos);
  const State<kDim> s = test::wet_state<kDim>();
  ASSERT_GT(bridge_volume(s.packing, s.packing.contacts[0]), 0.0);
  write_state(scratch.file("s.h5"), s);
  EXPECT_NE(read_file(scratch.file("s.h5")).find("surface_tension"), std::string::npos);
  const auto back = std::get<State<kDim>>(read_state(scratch.file("s.h5")));
  EXPECT_EQ(back.packing.law, s.packing.law);
  expect_same_contacts(s.packing, back.packing);
  EXPECT_EQ(back.n_bridges_unsettled, 3);
}

TEST(Checkpoint, CarriesItsProgressBesideTheState) {
  const ScratchDirectory scratch;
  write_state(scratch.file("c.h5"), busy_state<2>(), "{\"step\": 3}");
  EXPECT_EQ(read_progress(scratch.file("c.h5")), "{\"step\": 3}");
  EXPECT_EQ(refusal(scratch.file("c.h5")), "");
  write_state(scratch.file("s.h5"), busy_state<2>());
  EXPECT_EQ(read_progress(scratch.file("s.h5")), "");
}

TEST(StateFileRefuses, AFileThatIsMissing) {
  EXPECT_THAT(refusal("nowhere/s.h5"), AllOf(HasSubstr("nowhere/s.h5"), HasSubstr("No such file")));
}

TEST(StateFileRefuses, AFileThatIsNoHdf5) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("s.h5")) << "x,y,radius\n1,2,3\n";
  EXPECT_THAT(refusal(scratch.file("s.h5")), AllOf(HasSubstr("s.h5"), HasSubstr("not an HDF5 file")));
  std::ofstream(scratch.file("empty.h5")).flush();
  EXPECT_THAT(refusal(scratch.file("empty.h5")), HasSubstr("is empty"));
}

TEST(StateFileRefuses, AFileCutShortAnywhere) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string whole = read_file(scratch.file("s.h5"));
  const std::string cut = scratch.file("cut.h5");
  for (const std::size_t size : {std::size_t{9}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, size);
    EXPECT_THAT(refusal(cut), AllOf(HasSubstr("cut.h5"), HasSubstr("truncated"))) << size;
  }
}

TEST(StateFile, ComesThroughAPipeAsFromADisk) {
  const ScratchDirectory scratch;
  const std::string pipe = scratch.file("pipe"), saved = scratch.file("s.h5");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  write_state(saved, busy_state<3>());
  std::thread writer([&] { write_state(pipe, busy_state<3>()); });
  const std::string bytes = read_file(pipe);
  writer.join();
  EXPECT_EQ(bytes, read_file(saved));
  std::thread second([&] { write_state(pipe, busy_state<3>()); });
  EXPECT_EQ(std::get<State<3>>(read_state(pipe)).packing.grains.position,
            busy_state<3>().packing.grains.position);
  second.join();
}

/// The operating system limits the size of files, so that a state cannot be written completely. For every limit, the
/// old state file must stay unchanged and no other file may remain.
TEST(StateFile, ThatDoesNotFitTheDiskLeavesTheOldOne) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string old = read_file(scratch.file("s.h5"));
  State<2> other = busy_state<2>();
  other.scene = "another";
  write_state(scratch.file("other.h5"), other);
  const rlim_t whole = std::filesystem::file_size(scratch.file("other.h5"));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, SIG_IGN);
  for (rlim_t size = 0; size < whole; size += whole / 97) {
    const rlimit limit{size, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_THAT([&] { write_state(scratch.file("s.h5"), other); },
                ThrowsMessage<IoError>(HasSubstr("s.h5: cannot be written: File too large")))
        << size;
  }
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(read_file(scratch.file("s.h5")), old);
  write_state(scratch.file("s.h5"), other);
  EXPECT_EQ(read_file(scratch.file("s.h5")), read_file(scratch.file("other.h5")));
  EXPECT_FALSE(std::filesystem::exists(scratch.file("s.h5.part")));
}

TEST(StateFileRefuses, AFileWithOneBitTurned) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string whole = read_file(scratch.file("s.h5"));
  for (std::size_t at = 8; at < whole.size() - 80; at += whole.size() / 50) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    std::ofstream(scratch.file("bad.h5"), std::ios::binary) << damaged;
    EXPECT_THAT(refusal(scratch.file("bad.h5")), HasSubstr("damaged")) << at;
  }
}

TEST(StateFileRefuses, SealedBytesThatAreNoHdf5Inside) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("s.h5"), std::ios::binary) << test::sealed("\x89HDF\r\n\x1a\n and nothing more");
  EXPECT_THAT(refusal(scratch.file("s.h5")), HasSubstr("HDF5 library cannot open"));
}

/// The texts of the file are in an HDF5 heap. The signature at the beginning of the heap was overwritten before the
/// file was sealed.
TEST(StateFileRefuses, SealedBytesThatAreDamagedInside) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>(), "progress");
  const std::string whole = read_file(scratch.file("s.h5"));
  std::string content = test::without_seal(whole);
  const std::size_t at = content.find("GCOL");
  ASSERT_NE(at, std::string::npos);
  content[at] = 'X';
  std::ofstream(scratch.file("s.h5"), std::ios::binary) << test::sealed(content);
  EXPECT_THAT(refusal(scratch.file("s.h5")),
              HasSubstr("s.h5: the file is damaged although its checksum is right"));
  EXPECT_THAT([&] { read_progress(scratch.file("s.h5")); },
              ThrowsMessage<InputError>(HasSubstr("s.h5: the file is damaged although its checksum is right")));
}

/// Writes a state that no run can produce. Returns the message with which the reader refuses the state; the message
/// must name the dataset.
template <class Spoil>
std::string refusal_of_spoiled(const Spoil& spoil) {
  const ScratchDirectory scratch;
  State<2> s = busy_state<2>();
  spoil(s);
  write_state(scratch.file("s.h5"), s);
  return refusal(scratch.file("s.h5"));
}

TEST(StateFileRefuses, NumbersThatNoStateHolds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of_spoiled([&](State<2>& s) { s.packing.grains.position[2][1] = nan; }),
              AllOf(HasSubstr("s.h5:/grains/position"), HasSubstr("entry 2 is nan"), HasSubstr("finite")));
  EXPECT_THAT(refusal_of_spoiled([&](State<2>& s) { s.packing.contacts[1].gap = -1.0 / 0.0; }),
              AllOf(HasSubstr("/contacts/gap"), HasSubstr("entry 1 is -inf")));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.packing.grains.radius[1] = -0.5; }),
              AllOf(HasSubstr("/grains/radius"), HasSubstr("-0.5"), HasSubstr("positive")));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.packing.grains.mass[1] = 0.0; }),
              HasSubstr("/grains/mass"));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.packing.cell.matrix.setOnes(); }), HasSubstr("no volume"));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.packing.contacts[0].image.setZero(); }),
              HasSubstr("touch itself"));
  for (const int image : {1'000'000'001, -1'000'000'001})
    EXPECT_THAT(refusal_of_spoiled([&](State<2>& s) { s.packing.contacts[1].image[1] = image; }),
                AllOf(HasSubstr("s.h5:/contacts/image"), HasSubstr("entry 1 is " + std::to_string(image)),
                      HasSubstr("a number of cells up to 1e9")));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.packing.law += test::linear(-1.0); }),
              AllOf(HasSubstr("/law"), HasSubstr("contact.normal.stiffness = -1"), HasSubstr("positive")));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) {
                s.packing.grains = Grains<2>::with_size(0);
                s.packing.contacts.clear();
              }),
              HasSubstr("the dataset contains no grains"));
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) { s.units = "imperial"; }), HasSubstr("imperial"));
}

TEST(StateFile, KeepsIdentifiersThatAreNotTheIndices) {
  const ScratchDirectory scratch;
  const auto written = [&](std::vector<std::int64_t> id) {
    State<2> s = busy_state<2>();
    s.packing.grains.set_names(std::move(id));
    write_state(scratch.file("s.h5"), s);
    return std::get<State<2>>(read_state(scratch.file("s.h5"))).packing.grains.id;
  };
  const std::vector<std::int64_t> far = {std::numeric_limits<std::int64_t>::max(), -7, 0};
  EXPECT_EQ(written(far), far);
  EXPECT_TRUE(written({0, 1, 2}).empty());
  EXPECT_EQ(read_file(scratch.file("s.h5")).find("imported_id"), std::string::npos);
  EXPECT_THAT(refusal_of_spoiled([](State<2>& s) {
                s.packing.grains.id = {5, 8, 5};
              }),
              AllOf(HasSubstr("/grains/imported_id"), HasSubstr("entry 2 is 5, as is entry 0")));
}

/// Returns the position of a sequence of 32-bit integers in the bytes of a file.
std::size_t find_integers(const std::string& bytes, const std::vector<std::int32_t>& values) {
  return bytes.find(
      std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]));
}

/// Replaces the last entry of the column `good` in the contact list of a state file by `bad`. Returns the
/// message of the reader for this file.
std::string refusal_of_index(const std::vector<std::int32_t>& good, std::int32_t bad) {
  const ScratchDirectory scratch;
  State<2> s = busy_state<2>();
  Grains<2> grains = Grains<2>::with_size(300);
  grains.radius.assign(300, 0.5);
  grains.mass.assign(300, 1.0);
  s.packing.grains = grains;
  constexpr int kFirst[] = {251, 253, 256};
  for (int k = 0; k < 3; ++k) {
    s.packing.contacts[k].i = kFirst[k];
    s.packing.contacts[k].j = kFirst[k] + 1;
  }
  write_state(scratch.file("s.h5"), s);
  const std::string whole = read_file(scratch.file("s.h5"));
  std::string content = test::without_seal(whole);
  const std::size_t at = find_integers(content, good);
  EXPECT_NE(at, std::string::npos);
  content.replace(at + 8, 4, reinterpret_cast<const char*>(&bad), 4);
  std::ofstream(scratch.file("s.h5"), std::ios::binary) << test::sealed(content);
  return refusal(scratch.file("s.h5"));
}

TEST(StateFileRefuses, AContactOfAGrainThatIsNotThere) {
  EXPECT_THAT(refusal_of_index({251, 253, 256}, -1),
              AllOf(HasSubstr("s.h5:/contacts/id1"), HasSubstr("entry 2 is -1"), HasSubstr("from 0 to 299")));
  EXPECT_THAT(refusal_of_index({252, 254, 257}, 300),
              AllOf(HasSubstr("s.h5:/contacts/id2"), HasSubstr("entry 2 is 300"), HasSubstr("from 0 to 299")));
  EXPECT_EQ(refusal_of_index({252, 254, 257}, 299), "");
}

TEST(StateFileWriting, IntoADirectoryThatIsMissingIsAnErrorByName) {
  EXPECT_THROW(write_state("nowhere/s.h5", busy_state<2>()), IoError);
}

}  // namespace
}  // namespace floc
