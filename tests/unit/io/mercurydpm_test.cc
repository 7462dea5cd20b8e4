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

/// A run writes the contacts of several times to one .fstat file. Those at the time of the restart file belong to its
/// grains.
TEST(MercuryDpm, TakesTheContactsAtTheTimeOfTheRestartFile) {
  const Packing<2> written = test::packing_with_forces<2>({"p", "p"}).packing;
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("s.restart");
  ImportOptions options;
  options.contacts = scratch.file("s.fstat");
  options.pairs_twice = true;
  // The rows of fstat() are those at time 1. Before and after them, the file has other times.
  const std::string row = " 0 1 0 0 0 0.01 0 99 0 1 0 0 0 1 0\n", head = "# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n";
  const std::string rows = fstat(written);
  const auto write = [&](const std::string& keys, const std::string& text) {
    std::string grains = restart(written);
    grains.insert(grains.find("systemDimensions"), keys);
    test::write_text(path, grains);
    test::write_text(options.contacts, text);
  };
  const std::string several = "# 0.5 0\n" + head + "0.5" + row + "# 1 0\n" + rows.substr(6) + "# 2 0\n" + head +
                              "2" + row + "# 3 0\n" + head;
  for (const std::string keys : {"timeStep 0.1 time 1.0000000001 timeMax 3\n", "dt 0.1 t 1 tmax 3\n"}) {
    write(keys, several);
    test::expect_same_packing(test::read_packing<2>(path, options), written, 1e-12);
  }
  write("timeStep 0.1 time 3 timeMax 3\n", several);
  EXPECT_EQ(test::read_packing<2>(path, options).contacts.size(), 0u);
  write("timeStep 0.1 time 1.5 timeMax 3\n", several);
  EXPECT_THAT([&] { test::read_packing<2>(path, options); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("s.fstat: the grains of"),
                                                       HasSubstr("are those at the time 1.5"),
                                                       HasSubstr("the nearest of which is the time"))));
  // A run that is restarted writes a time twice.
  write("timeStep 0.1 time 1 timeMax 3\n", several + "# 1 0\n" + rows.substr(6));
  test::expect_same_packing(test::read_packing<2>(path, options), written, 1e-12);
}

/// Rows of an .fstat file contain positions in the restart file, interactions of the restart file contain identifiers.
TEST(MercuryDpm, NumbersGrainsOfFstatInTheOrderOfTheRestartFile) {
  const Packing<2> written = test::packing_with_forces<2>({"p", "p"}).packing;
  const test::ScratchDirectory scratch;
  std::string grains = restart(written);
  grains.erase(grains.find("Interactions"));
  for (int i = 0; i < written.grains.size(); ++i) {
    const std::string from = fmt::format("BaseParticle id {} ", i);
    grains.replace(grains.find(from), from.size(), fmt::format("OtherParticle id {} ", (7 * i + 3) % 16));
  }
  test::write_text(scratch.file("s.restart"), grains);
  ImportOptions options;
  options.contacts = scratch.file("s.fstat");
  options.pairs_twice = true;
  test::write_text(options.contacts, fstat(written));
  const Packing<2> read = test::read_packing<2>(scratch.file("s.restart"), options);
  test::expect_same_packing(read, written, 1e-12);
  EXPECT_EQ(read.grains.name(1), 10);
  test::write_text(options.contacts, "1 0 16 0 0 0 0.01 0 1 0 1 0 0 0 1 0\n");
  EXPECT_THAT([&] { test::read_packing<2>(scratch.file("s.restart"), options); },
              ThrowsMessage<InputError>(HasSubstr("s.fstat:1: the second grain is 16, but")));
}

/// The file lists no mass for a fixed particle: its mass follows from the density of its species.
TEST(MercuryDpm, FixedGrainsHaveTheMassOfTheirDensity) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("s.restart");
  ImportOptions options;
  options.law = parse_law("law", test::kForeignLaw);
  const auto mass = [&](const std::string& dimensions, const std::string& species,
                        const std::string& particle) {
    test::write_text(path, "MercuryDPM 1.0 name test\nxMin 0 xMax 4 yMin 0 yMax 4 zMin 0 zMax 4\n" +
                               dimensions + "\n" + species + "Particles 1\n" + particle + "\n");
    return std::visit([](const auto& state) { return state.packing.grains.mass[0]; },
                      read_mercurydpm(path, options).state);
  };
  const double pi = 3.141592653589793, sphere = 4.0 / 3.0 * pi / 8.0, disk = pi / 4.0;
  const std::string spheres = "systemDimensions 3 particleDimensions 3",
                    disks = "systemDimensions 3 particleDimensions 2",
                    two = "Species 2\nLinearSpecies id 0 density 2\nLinearSpecies id 1 density 6\n";
  const auto fixed = [](int species) {
    return fmt::format(
        "BaseParticle id 0 indSpecies {} position 2 2 2 orientation 1 0 0 0 radius 0.5 invMass 0", species);
  };
  EXPECT_NEAR(mass(spheres, two, fixed(0)), 2.0 * sphere, 1e-14);
  EXPECT_NEAR(mass(spheres, two, fixed(1)), 6.0 * sphere, 1e-14);
  const std::string old = "Species 1\nk 39 disp 0 mu 0.5 rho 2400 dim_particle 3\n";
  EXPECT_NEAR(mass("dim 3 gravity 0 0 0", old, "TSP BP 2 2 2 0 0 0 0.5 0 0 0 0 0 0 0 0 0 0"), 2400.0 * sphere,
              1e-10);
  EXPECT_NEAR(mass(disks, two, fixed(1)), 6.0 * disk, 1e-14);
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
