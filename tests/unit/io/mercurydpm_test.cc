#include "floc/io/mercurydpm.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "support/foreign_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string three_numbers(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v[0], v[1], v[2]);
}

/// Returns a wall as MercuryDPM writes it. The orientation rotates the x axis to the outward normal of the
/// wall.
std::string wall_line(int index, int axis, int side, double position) {
  const char* orientations[3][2] = {
      {"0 0 1 0", "1 0 0 0"},
      {"0.707106781186548 0 0 -0.707106781186548", "0.707106781186548 0 0 0.707106781186548"},
      {"0.707106781186548 0 0.707106781186548 0", "0.707106781186548 0 -0.707106781186548 0"}};
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  at[axis] = position;
  return fmt::format("InfiniteWall id {} indSpecies 0 position {} orientation {} velocity 0 0 0 force 0 0 0\n",
                     index, three_numbers(at), orientations[axis][side > 0]);
}

/// Returns a packing as the text of a restart file of MercuryDPM. Each force in this file acts on the first of the two
/// particles of a contact.
template <int Dim>
std::string restart(const Packing<Dim>& p) {
  std::string text = "MercuryDPM 1.0 name test\nxMin 0 xMax 4 yMin 0 yMax 4 zMin 0 zMax 4\n";
  text += fmt::format(
      "systemDimensions {} particleDimensions {} gravity {} \nSpecies 1\nLinearSpecies id 0 density 1\n", Dim,
      Dim, three_numbers(test::in_space<Dim>(p.gravity)));
  std::string walls, boundaries;
  int n_walls = 0, n_boundaries = 0;
  std::vector<int> wall_index;
  for (const Wall<Dim>& wall : p.walls) {
    wall_index.push_back(n_walls);
    if (!wall.open) walls += wall_line(n_walls++, wall.axis, wall.side, wall.position);
  }
  for (int a = 0; a < Dim; ++a)
    if (!between_walls(p.walls, a)) {
      Eigen::Vector3d normal = Eigen::Vector3d::Unit(a), shift = p.cell.matrix(a, a) * normal;
      boundaries +=
          fmt::format("PeriodicBoundary id {} normal {} distanceLeft 0 distanceRight {} shift {}\n",
                      n_boundaries++, three_numbers(normal), p.cell.matrix(a, a), three_numbers(shift));
    }
  text += fmt::format("Walls {}\n{}Boundaries {}\n{}Particles {}\n", n_walls, walls, n_boundaries, boundaries,
                      p.grains.size());
  for (int i = 0; i < p.grains.size(); ++i)
    text += fmt::format(
        "BaseParticle id {} indSpecies 0 position {} orientation 1 0 0 0 radius {} invMass {}\n", i,
        three_numbers(test::in_space<Dim>(p.grains.position[i])), p.grains.radius[i], 1.0 / p.grains.mass[i]);
  text += fmt::format("Interactions {}\n", p.contacts.size());
  for (const Contact<Dim>& c : p.contacts)
    text += fmt::format("LinearInteraction {} {} {} timeStamp 1 contactPoint 0 0 0 force {} torque 0 0 0\n",
                        p.is_wall(c.j) ? "particleWallIds" : "particleIds", c.i,
                        p.is_wall(c.j) ? wall_index[c.j - p.grains.size()] : c.j,
                        three_numbers(test::in_space<Dim>(test::force_on_first(c))));
  return text;
}

/// Returns the contacts as the text of an .fstat file, which lists every pair of grains twice. The force on the first
/// particle of a pair is fn n + ft t. For a contact with a wall, the sign of the force is opposite.
template <int Dim>
std::string fstat(const Packing<Dim>& p) {
  std::string text = "# 0 0\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n";
  for (const Contact<Dim>& c : p.contacts) {
    const double shear = c.shear_force.norm();
    const Eigen::Vector3d n = -test::in_space<Dim>(c.normal),
                          t = test::in_space<Dim>(Vec<Dim>(c.shear_force / shear));
    const auto row = [&](int i, int j, double sign) {
      text += fmt::format("1 {} {} 0 0 0 {} 0 {} {} {} {}\n", i, j, -c.gap, c.normal_force, shear,
                          three_numbers(sign * n), three_numbers(sign * t));
    };
    if (p.is_wall(c.j)) {
      row(c.i, p.grains.size() - c.j - 1, -1.0);
    } else {
      row(c.i, c.j, 1.0);
      row(c.j, c.i, -1.0);
    }
  }
  return text;
}

template <int Dim>
void expect_read(const test::Ends<Dim>& ends) {
  SCOPED_TRACE(testing::PrintToString(ends));
  const Packing<Dim> written = test::packing_with_forces<Dim>(ends).packing;
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("s.restart"), restart(written));
  EXPECT_TRUE(is_mercurydpm(scratch.file("s.restart")));
  test::expect_same_packing(test::read_packing<Dim>(scratch.file("s.restart")), written, 1e-12);
  ImportOptions options;
  options.contacts = scratch.file("s.fstat");
  options.pairs_twice = true;
  for (std::size_t w = 0; w < written.walls.size(); ++w)
    options.wall_ids[-1 - static_cast<int>(w)] = {written.walls[w].axis, written.walls[w].side};
  test::write_text(options.contacts, fstat(written));
  test::expect_same_packing(test::read_packing<Dim>(scratch.file("s.restart"), options), written, 1e-12);
  options.pairs_twice = false;
  EXPECT_THAT([&] { test::read_packing<Dim>(scratch.file("s.restart"), options); },
              ThrowsMessage<InputError>(HasSubstr("is listed twice")));
}

TEST(MercuryDpm, GivesContactsForcesAndBalance) {
  for (const std::string x : {"p", "ww", "oo"})
    for (const std::string y : {"p", "ww", "wo"}) {
      expect_read<2>({x, y});
      expect_read<3>({x, "p", y});
    }
}

TEST(MercuryDpm, HasALeesEdwardsCellThatLeansByTheShift) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("s.restart");
  test::write_text(
      path,
      "MercuryDPM 1.0 name test\nxMin 0 xMax 4 yMin 0 yMax 3 zMin 0 zMax 1\nsystemDimensions 2 "
      "particleDimensions 2 gravity 0 0 0\nWalls 0\nBoundaries 1\nLeesEdwardsBoundary id 0 left 0 right 4 "
      "down 0 up 3 shift 9.5 vel 1\nParticles 2\n"
      "BaseParticle id 0 position 1 0.5 0 radius 0.5 invMass 1\n"
      "BaseParticle id 1 position 2.5 2.6 0 radius 0.5 invMass 1\nInteractions 1\n"
      "X particleIds 0 1 force 0 3 0 torque 0 0 0\n");
  const Packing<2> p = test::read_packing<2>(path);
  EXPECT_EQ(p.cell.matrix, (Mat<2>() << 4.0, 0.0, 1.5, 3.0).finished());
  ASSERT_EQ(p.contacts.size(), 1u);
  // The image of grain 1 below grain 0 is at (2.5 - 1.5, 2.6 - 3).
  EXPECT_EQ(p.contacts[0].image, (Vec<2, int>(0, -1)));
}

TEST(MercuryDpm, NamesWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("s.restart");
  const std::string good = restart(test::packing_with_forces<2>({"p", "ww"}).packing);
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string text = good;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    test::write_text(path, text.replace(at, from.size(), to));
    EXPECT_THAT([&] { test::read_packing<2>(path); }, ThrowsMessage<InputError>(HasSubstr(words))) << from;
  };
  refusal("Particles 16", "Particles 17", ": the section Particles ends after 16 of 17 lines");
  refusal("radius 0.51", "radius -0.51", "must be positive");
  refusal("radius", "radios", "the line has no radius");
  refusal("position 0", "position zero", "position is \"zero");
  refusal("InfiniteWall id 0", "AxisymmetricWall id 0",
          "the wall AxisymmetricWall is not a plane perpendicular to an axis");
  refusal("particleWallIds 0 0", "particleWallIds 0 5", "wall = 5, but the file has the walls 0 to 1");
  refusal("particleIds 0", "particleIds 99", "id1 = 99: no grain has this id");
  refusal("Particles 16", "Particles 1e30", "the number of Particles");
  test::write_text(path, good.substr(0, good.find("BaseParticle id 9")));
  EXPECT_THAT([&] { test::read_packing<2>(path); },
              ThrowsMessage<InputError>(HasSubstr("the section Particles ends after 9 of 16 lines")));
}

}  // namespace
}  // namespace floc
