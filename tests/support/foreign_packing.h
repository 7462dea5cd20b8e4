#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <variant>

#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/state.h"
#include "support/run_program.h"

/// Packings with normal and tangential forces at their contacts. Tests write these packings in the formats of other
/// programs.
namespace floc::test {

const std::string kForeignLaw = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";

/// Ends of each axis of a packing: "p" for a periodic axis, otherwise two letters. The first letter is for the lower
/// end and the second letter for the upper end: "w" is a wall, and "o" an open end.
template <int Dim>
using Ends = std::array<std::string, Dim>;

/// Returns randomly placed grains in a box of about four diameters. Neighbours overlap a little, and their contacts
/// have random forces.
template <int Dim>
State<Dim> packing_with_forces(const Ends<Dim>& ends, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  State<Dim> state;
  Packing<Dim>& p = state.packing;
  p.law = parse_law("law", kForeignLaw);
  const int side = 4;
  p.cell.matrix = side * Mat<Dim>::Identity();
  int n = 1;
  for (int a = 0; a < Dim; ++a) n *= side;
  p.grains = Grains<Dim>::with_size(n);
  for (int i = 0; i < n; ++i) {
    for (int a = 0, rest = i; a < Dim; ++a, rest /= side)
      p.grains.position[i][a] = rest % side + 0.5 + 0.02 * (unit(random) - 0.5);
    p.grains.radius[i] = 0.51 + 0.01 * unit(random);
    p.grains.mass[i] = 1.0 + unit(random);
  }
  for (int a = 0; a < Dim; ++a) {
    if (ends[a] == "p") continue;
    double low = 0.0, high = side;
    for (int i = 0; i < n; ++i) {
      if (ends[a][0] == 'o') low = std::min(low, p.grains.position[i][a] - p.grains.radius[i]);
      if (ends[a][1] == 'o') high = std::max(high, p.grains.position[i][a] + p.grains.radius[i]);
    }
    const double fixed = std::numeric_limits<double>::infinity();
    p.walls.push_back({a, -1, low, 0.0, fixed, ends[a][0] == 'o'});
    p.walls.push_back({a, +1, high, 0.0, fixed, ends[a][1] == 'o'});
    p.cell.matrix(a, a) = high - low;
  }
  if (!p.walls.empty()) p.wall_law = p.law;
  find_contacts(p);
  for (Contact<Dim>& c : p.contacts) {
    Vec<Dim> t = Vec<Dim>::NullaryExpr([&] { return unit(random) - 0.5; });
    t -= c.normal * c.normal.dot(t);
    c.shear_force = 0.3 * c.normal_force * t;
  }
  return state;
}

/// Reads a file and returns its packing.
template <int Dim>
Packing<Dim> read_packing(const std::string& path, ImportOptions options = {}) {
  if (!options.law) options.law = parse_law("law", kForeignLaw);
  const Imported imported = find_import_format("", path).read(path, options);
  return std::get<State<Dim>>(imported.state).packing;
}

/// Expects that two packings are equal: grains, ends of the axes, contacts with their forces, and net forces on the
/// grains.
/// @param tolerance  largest accepted difference between two coordinates, or between two forces divided by the largest
/// force
template <int Dim>
void expect_same_packing(const Packing<Dim>& read, const Packing<Dim>& written, double tolerance) {
  ASSERT_EQ(read.grains.size(), written.grains.size());
  ASSERT_EQ(read.walls.size(), written.walls.size());
  for (std::size_t w = 0; w < read.walls.size(); ++w) {
    EXPECT_EQ(read.walls[w].axis, written.walls[w].axis);
    EXPECT_EQ(read.walls[w].side, written.walls[w].side);
    EXPECT_EQ(read.walls[w].open, written.walls[w].open) << w;
    EXPECT_NEAR(read.walls[w].position, written.walls[w].position, tolerance) << w;
  }
  ASSERT_EQ(read.contacts.size(), written.contacts.size());
  double largest = 0.0;
  for (const Contact<Dim>& c : written.contacts) largest = std::max(largest, c.normal_force);
  for (std::size_t k = 0; k < read.contacts.size(); ++k) {
    const Contact<Dim>&a = read.contacts[k], &b = written.contacts[k];
    ASSERT_EQ(a.i, b.i) << k;
    ASSERT_EQ(a.j, b.j) << k;
    EXPECT_EQ(a.image, b.image) << k;
    EXPECT_NEAR(a.normal_force, b.normal_force, tolerance * largest) << k;
    EXPECT_NEAR((a.shear_force - b.shear_force).norm(), 0.0, tolerance * largest) << k;
    EXPECT_NEAR((a.arm_i - b.arm_i).norm(), 0.0, tolerance) << k;
  }
  const Balance<Dim> of_read = net_forces(read), of_written = net_forces(written);
  for (int i = 0; i < read.grains.size(); ++i) {
    EXPECT_NEAR(read.grains.radius[i], written.grains.radius[i], tolerance);
    EXPECT_NEAR(read.grains.mass[i], written.grains.mass[i], tolerance * written.grains.mass[i]);
    EXPECT_NEAR((of_read.force[i] - of_written.force[i]).norm(), 0.0, 10 * tolerance * largest) << i;
  }
}

/// Returns a vector with three components; in 2D the third one is zero.
template <int Dim>
Eigen::Vector3d in_space(const Vec<Dim>& v) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  out.head<Dim>() = v;
  return out;
}

/// Returns the force on the first grain of a contact.
template <int Dim>
Vec<Dim> force_on_first(const Contact<Dim>& c) {
  return c.shear_force - c.normal_force * c.normal;
}

/// Formats a number as Fortran writes it.
inline std::string fortran_number(double x) {
  std::string text = fmt::format("{:.16e}", x);
  std::replace(text.begin(), text.end(), 'e', 'D');
  return text;
}

/// Replaces a part of the text of a file.
/// @pre the file contains `from`
inline void change_file(const std::string& path, const std::string& from, const std::string& to) {
  std::string text = content_of(path);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  write_text(path, text.replace(at, from.size(), to));
}

}  // namespace floc::test
