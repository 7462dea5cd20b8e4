#include "floc/contact/relation_faults.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

/// Model with two parameters, the second of which must be at least as large as the first.
struct TwoSlopes {
  double loading;
  double unloading;

  static constexpr Number<TwoSlopes> kNumbers[] = {
      {"loading", &TwoSlopes::loading, Unit::stiffness, "K_1", Requirement::positive, "", ""},
      {"unloading", &TwoSlopes::unloading, Unit::stiffness, "K_2", Requirement::positive, "", ""}};
  static constexpr AtLeast<TwoSlopes> kRelations[] = {{&TwoSlopes::unloading, &TwoSlopes::loading}};
};

TEST(RelationFaults, NameBothNumbersAndTheirValues) {
  const auto faults = relation_faults("normal", TwoSlopes{10.0, 2.5});
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].slot, "normal");
  EXPECT_EQ(faults[0].key, "unloading");
  EXPECT_EQ(faults[0].words, "contact.normal.unloading = 2.5: expected at least contact.normal.loading = 10");
}

TEST(RelationFaults, AreNoneOfNumbersInOrderOrOfModelsWithoutRelations) {
  EXPECT_TRUE(relation_faults("normal", TwoSlopes{10.0, 10.0}).empty());
  EXPECT_TRUE(relation_faults("normal", LinearRepulsion{10.0}).empty());
}

}  // namespace
}  // namespace floc
