#include "floc/contact/normal/softening_repulsion.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

TEST(SofteningRepulsion, LoadsAlongAParabolaAndUnloadsAlongALine) {
  const SofteningRepulsion repulsion{200.0, 0.5};
  double largest[1] = {0.0};
  const auto force_at = [&](double overlap) {
    repulsion.remember(PairGeometry<>(-overlap), largest);
    return repulsion.force(PairGeometry<>(-overlap), largest);
  };
  EXPECT_DOUBLE_EQ(force_at(0.25), 200.0 * 0.25 * 0.75);
  EXPECT_DOUBLE_EQ(force_at(0.1), 200.0 * 0.1 * 0.75);
  EXPECT_DOUBLE_EQ(force_at(0.5), 200.0 * 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(force_at(1.0), 200.0 * 1.0 * 0.5);
  EXPECT_EQ(force_at(-0.1), 0.0);
  EXPECT_DOUBLE_EQ(force_at(0.25), 200.0 * 0.25 * 0.75);
}

}  // namespace
}  // namespace floc
