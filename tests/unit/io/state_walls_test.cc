#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "floc/base/error.h"
#include "floc/io/hdf5_file.h"
#include "floc/io/state_file.h"
#include "floc/packing/wall_forces.h"
#include "support/scratch_directory.h"
#include "support/sealed.h"
#include "support/states.h"

namespace floc {
namespace {

template <int Dim>
State<Dim> written_and_read(const State<Dim>& state) {
  const test::ScratchDirectory scratch;
  write_state(scratch.file("box.h5"), state);
  return std::get<State<Dim>>(read_state(scratch.file("box.h5")));
}

template <int Dim>
void expect_walls_kept() {
  const State<Dim> saved = test::boxed_state<Dim>();
  const State<Dim> read = written_and_read(saved);
  EXPECT_EQ(read.packing.walls, saved.packing.walls);
  EXPECT_EQ(read.packing.wall_law, saved.packing.wall_law);
  EXPECT_EQ(read.packing.law, saved.packing.law);
  ASSERT_EQ(read.packing.contacts.size(), saved.packing.contacts.size());
  int on_walls = 0;
  for (std::size_t k = 0; k < saved.packing.contacts.size(); ++k) {
    const Contact<Dim>&a = saved.packing.contacts[k], &b = read.packing.contacts[k];
    EXPECT_EQ(a.j, b.j);
    EXPECT_EQ(a.history, b.history);
    EXPECT_EQ(a.normal_force, b.normal_force);
    on_walls += saved.packing.is_wall(a.j);
  }
  EXPECT_EQ(on_walls, 2);
  EXPECT_EQ(read.residuals.stress, saved.residuals.stress);
}

TEST(StateWithWalls, ComesBackAsItWas) {
  expect_walls_kept<2>();
  expect_walls_kept<3>();
}

/// Attributes of the file describe the boundary of each axis and the forces. A further attribute names a required
/// feature: older programs do not know it and therefore refuse the file.
TEST(StateWithWalls, SaysWhatItHasInItsAttributes) {
  const State<3> state = test::boxed_state<3>();
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("box.h5");
  write_state(path, state);
  const Hdf5Reader file(path, path);
  std::string features, boundary;
  file.attribute("/", "features", features);
  file.attribute("cell", "boundary", boundary);
  EXPECT_EQ(features, "contacts/memory walls");
  EXPECT_EQ(boundary, "walls periodic walls");
  std::vector<double> force;
  file.array("walls/force", {4}, force);
  EXPECT_EQ(force, wall_forces(state.packing));
  EXPECT_GT(force[0], 0.0);
}

void expect_refused(const State<2>& state, const char* words) {
  const test::ScratchDirectory scratch;
  write_state(scratch.file("box.h5"), state);
  EXPECT_THAT([&] { read_state(scratch.file("box.h5")); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(words)));
}

TEST(StateWithWalls, IsRefusedWhereTheyMakeNoBox) {
  State<2> state = test::boxed_state<2>();
  state.packing.walls[1].side = -1;
  expect_refused(state, "walls/side");
  state = test::boxed_state<2>();
  state.packing.walls[1].axis = 1;
  expect_refused(state, "walls/axis");
  state = test::boxed_state<2>();
  state.packing.walls[3].position += 1.0;
  expect_refused(state, "walls/position");
  state = test::boxed_state<2>();
  state.packing.walls[2].mass = -1.0;
  expect_refused(state, "walls/mass");
  state = test::boxed_state<2>();
  state.packing.walls.pop_back();
  expect_refused(state, "expected two for each axis");
  state = test::boxed_state<2>();
  // A file of another program may contain the index of a wall that does not exist. A packing in memory cannot have such
  // an index, so the file is changed.
  const test::ScratchDirectory scratch;
  write_state(scratch.file("box.h5"), state);
  const auto id2 = [](std::int32_t last) {
    const std::array<std::int32_t, 3> bodies = {1, 3, last};
    return std::string(reinterpret_cast<const char*>(bodies.data()), sizeof bodies);
  };
  const std::string beyond = test::with_replaced(scratch.file("box.h5"), id2(4), id2(7));
  EXPECT_THAT([&] { read_state(beyond); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("contacts/id2")));
}

}  // namespace
}  // namespace floc
