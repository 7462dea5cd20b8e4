#include "floc/contact/law_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "floc/contact/law_description.h"

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LawParameters usable() {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  p.adhesion = TailAdhesion{1.0, 1e-3};
  p.damping = ViscousDamping{0.015, DampingMass::effective};
  p.friction = CoulombFriction{0.5, 1e5};
  p.rolling = RollingSpring{0.005, 10.0};
  return p;
}

TEST(LawParameters, ThoseOfThePaperHaveNoFault) {
  EXPECT_THAT(usable().validate(), IsEmpty());
}

TEST(LawParameters, LimitsThatMakeSenseAreAllowed) {
  LawParameters p = usable();
  p.adhesion = TailAdhesion{0.0, 0.0};
  p.damping.get<ViscousDamping>().restitution = 1.0;
  p.friction.get<CoulombFriction>().coefficient = 0.0;
  p.rolling.get<RollingSpring>().coefficient = 0.0;
  EXPECT_THAT(p.validate(), IsEmpty());
}

TEST(LawParameters, EveryFaultNamesItsKeyAndValue) {
  struct Fault {
    const char* key;
    std::vector<double> wrong;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Fault> faults = {
      {"normal.stiffness", {0, -1, nan, inf}},    {"adhesion.force", {-1, nan, inf}},
      {"adhesion.range", {-1, nan, inf}},         {"damping.restitution", {0, -0.5, 1.5, nan}},
      {"friction.coefficient", {-0.5, nan, inf}}, {"friction.stiffness", {0, -1, nan, inf}},
      {"rolling.coefficient", {-0.5, nan, inf}},  {"rolling.stiffness", {0, -1, nan, inf}}};
  for (const Fault& fault : faults)
    for (const double wrong : fault.wrong) {
      SCOPED_TRACE(::testing::Message() << fault.key << " = " << wrong);
      LawParameters p = usable();
      for (const LawNumber& n : numbers_of(p))
        if (n.key == fault.key) *n.value = wrong;
      EXPECT_THAT(p.validate(), ElementsAre(HasSubstr("contact." + std::string(fault.key) + " = ")));
    }
}

TEST(LawParameters, AllFaultsAreListedAtOnce) {
  LawParameters p = usable();
  p.normal = LinearRepulsion{-1};
  p.friction = CoulombFriction{-1, 1e5};
  p.rolling = RollingSpring{0.005, 0};
  EXPECT_EQ(p.validate().size(), 3u);
}

TEST(LawParameters, RollingNeedsFriction) {
  LawParameters p = usable();
  p.friction.reset();
  EXPECT_THAT(p.validate(),
              ElementsAre(HasSubstr("contact.rolling: rolling resistance needs friction, because grains "
                                    "without friction do not rotate; give contact.friction")));
}

TEST(LawParameters, TwistingNeedsFrictionAndSpheresOfConstantStiffness) {
  LawParameters p = usable();
  p.twisting = TwistingSpring{0.004, 8.0};
  EXPECT_THAT(p.validate(), IsEmpty());
  EXPECT_TRUE(p.faults_in_dimension(3).empty());
  ASSERT_EQ(p.faults_in_dimension(2).size(), 1u);
  EXPECT_THAT(p.faults_in_dimension(2)[0].words,
              HasSubstr("contact.twisting.law = \"spring\": this model is for spheres"));
  p.rolling.reset();
  EXPECT_THAT(p.validate(), IsEmpty());
  p.friction.reset();
  EXPECT_THAT(p.validate(),
              ElementsAre(HasSubstr("contact.twisting: twisting resistance needs friction, because grains "
                                    "without friction do not rotate; give contact.friction")));
  LawParameters hertz;
  hertz.normal = HertzRepulsion{1e3, 0.3};
  hertz.friction = MindlinFriction{0.3};
  hertz.twisting = TwistingSpring{0.004, 8.0};
  EXPECT_THAT(hertz.validate(),
              ElementsAre(HasSubstr(
                  "contact.twisting.law = \"spring\" cannot be combined with contact.normal.law = \"hertz\"")));
}

}  // namespace
}  // namespace floc
