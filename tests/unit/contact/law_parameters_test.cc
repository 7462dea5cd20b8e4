#include "floc/contact/law_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LawParameters usable() {
  LawParameters p;
  p.normal_stiffness = 1e5;
  p.adhesion = {1.0, 1e-3};
  p.damping = {0.015, DampingMass::effective};
  p.friction = {0.5, 1e5};
  p.rolling = {0.005, 10.0};
  return p;
}

TEST(LawParameters, ThoseOfThePaperHaveNoFault) {
  EXPECT_THAT(usable().validate(), IsEmpty());
}

TEST(LawParameters, LimitsThatMakeSenseAreAllowed) {
  LawParameters p = usable();
  p.adhesion = {0.0, 0.0};
  p.damping->restitution = 1.0;
  p.friction->coefficient = 0.0;
  p.rolling->coefficient = 0.0;
  EXPECT_THAT(p.validate(), IsEmpty());
}

TEST(LawParameters, EveryFaultNamesItsKeyAndValue) {
  struct Fault {
    const char* key;
    std::function<double&(LawParameters&)> value;
    std::vector<double> wrong;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Fault> faults = {
      {"contact.normal.stiffness",
       [](LawParameters& p) -> double& { return p.normal_stiffness; },
       {0, -1, nan, inf}},
      {"contact.adhesion.force", [](LawParameters& p) -> double& { return p.adhesion->force; }, {-1, nan, inf}},
      {"contact.adhesion.range", [](LawParameters& p) -> double& { return p.adhesion->range; }, {-1, nan, inf}},
      {"contact.damping.restitution",
       [](LawParameters& p) -> double& { return p.damping->restitution; },
       {0, -0.5, 1.5, nan}},
      {"contact.friction.coefficient",
       [](LawParameters& p) -> double& { return p.friction->coefficient; },
       {-0.5, nan, inf}},
      {"contact.friction.stiffness",
       [](LawParameters& p) -> double& { return p.friction->stiffness; },
       {0, -1, nan, inf}},
      {"contact.rolling.coefficient",
       [](LawParameters& p) -> double& { return p.rolling->coefficient; },
       {-0.5, nan, inf}},
      {"contact.rolling.stiffness",
       [](LawParameters& p) -> double& { return p.rolling->stiffness; },
       {0, -1, nan, inf}},
  };
  for (const Fault& fault : faults)
    for (const double wrong : fault.wrong) {
      SCOPED_TRACE(::testing::Message() << fault.key << " = " << wrong);
      LawParameters p = usable();
      fault.value(p) = wrong;
      EXPECT_THAT(p.validate(), ElementsAre(HasSubstr(std::string(fault.key) + " = ")));
    }
}

TEST(LawParameters, AllFaultsAreListedAtOnce) {
  LawParameters p = usable();
  p.normal_stiffness = -1;
  p.friction->coefficient = -1;
  p.rolling->stiffness = 0;
  EXPECT_EQ(p.validate().size(), 3u);
}

TEST(LawParameters, RollingNeedsFriction) {
  LawParameters p = usable();
  p.friction.reset();
  EXPECT_THAT(p.validate(), ElementsAre(HasSubstr("contact.rolling: needs contact.friction")));
}

}  // namespace
}  // namespace floc
