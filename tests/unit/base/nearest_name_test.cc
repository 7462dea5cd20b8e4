#include "floc/base/nearest_name.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

TEST(NearestName, IsTheOneWithTheFewestLettersChanged) {
  EXPECT_EQ(nearest_name("modli", {"modes", "moduli", "network"}), "moduli");
  EXPECT_EQ(nearest_name("--prestres", {"--strains", "--prestress"}), "--prestress");
  EXPECT_EQ(nearest_name("x", {"y", "z"}), "y") << "the first of several";
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace floc
