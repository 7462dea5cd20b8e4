#include "floc/picture/periodic_copies.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace floc {
namespace {

using Shifts = std::set<std::pair<double, double>>;

Shifts copies(const Cell<2>& cell, const Vec<2>& from, const Vec<2>& to, double radius) {
  Shifts found;
  PeriodicCopies(cell).of_segment(from, to, radius, [&](const Vec<2>& shift) {
    EXPECT_TRUE(found.insert({shift[0], shift[1]}).second) << "the same copy twice";
  });
  return found;
}

TEST(PeriodicCopies, OfADiskInTheMiddleIsOne) {
  Cell<2> cell;
  cell.matrix *= 4.0;
  EXPECT_EQ(copies(cell, {2.0, 2.0}, {2.0, 2.0}, 0.5), (Shifts{{0.0, 0.0}}));
  EXPECT_EQ(copies(cell, {-2.0, 6.0}, {-2.0, 6.0}, 0.5), (Shifts{{4.0, -4.0}}));
}

TEST(PeriodicCopies, OfADiskInACornerAreFour) {
  Cell<2> cell;
  cell.matrix *= 4.0;
  EXPECT_EQ(copies(cell, {0.1, 3.9}, {0.1, 3.9}, 0.5), (Shifts{{0, 0}, {4, 0}, {0, -4}, {4, -4}}));
}

TEST(PeriodicCopies, MissNoPointThatLiesInTheCellHoweverSkewed) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    Cell<2> cell;
    cell.matrix << 1.0 + 0.3 * uniform(engine), 1.5 * uniform(engine), 0.4 * uniform(engine), 1.2;
    if (cell.volume() < 0.3) continue;
    const Vec<2> from(3.0 * uniform(engine), 3.0 * uniform(engine));
    const Vec<2> to = from + Vec<2>(uniform(engine), uniform(engine));
    const double radius = 0.7;
    const Shifts found = copies(cell, from, to, radius);
    for (int k = 0; k < 100; ++k) {
      const Vec<2> around = Vec<2>(uniform(engine), uniform(engine)).normalized() * radius;
      const Vec<2> point = from + 0.5 * (1.0 + uniform(engine)) * (to - from) + around;
      const Vec<2> shift = cell.wrapped(point) - point;
      bool has = false;
      for (const auto& [x, y] : found) has = has || (Vec<2>(x, y) - shift).norm() < 1e-9;
      ASSERT_TRUE(has) << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace floc
