#include "floc/io/law_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LawText, GivesBackEveryLawItWrites) {
  LawParameters law;
  law.normal = LinearRepulsion{1e5 / 3.0};
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law.adhesion = ConstantAdhesion{1.0};
  law.friction = CoulombFriction{0.5, 1e5};
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law.adhesion = TailAdhesion{1.0, 1e-3};
  law.damping = ViscousDamping{0.015, DampingMass::grain};
  law.rolling = RollingSpring{0.005, 10.0};
  EXPECT_EQ(parse_law("", law_text(law)), law);
}

/// A coefficient is all that friction of elastic spheres has, and lacks a stiffness where contacts are linear.
TEST(LawText, KnowsAModelByItsNumbersAndByWhatItGoesWith) {
  LawParameters law;
  law.normal = HertzRepulsion{70.0, 0.3};
  law.friction = MindlinFriction{0.3};
  law.damping = CriticalDamping{0.5};
  EXPECT_EQ(law_text(law),
            "normal.modulus=70, normal.poisson=0.3, damping.critical_fraction=0.5, friction.coefficient=0.3");
  EXPECT_EQ(parse_law("", law_text(law)), law);
  EXPECT_EQ(parse_law("", "friction.law=mindlin, " + law_text(law)), law);
}

TEST(LawText, GivesBackLiquidBridgesWithTheirChoices) {
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.adhesion = CapillaryAdhesion{0.072, 10.0, 0.007, 2.6};
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law.adhesion = CapillaryAdhesion{0.072, 10.0, 0.007, 2.6, BridgeForm::rational, BridgeFormation::contact};
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law.normal = HertzRepulsion{7e10, 0.3};
  EXPECT_EQ(parse_law("", law_text(law)), law);
}

TEST(LawText, NamesWhatIsWrongAndWhatWasExpected) {
  const auto refusal = [](const std::string& text) { return [text] { parse_law("--law", text); }; };
  EXPECT_THAT(refusal(""), ThrowsMessage<InputError>(HasSubstr("--law: normal.stiffness is missing")));
  EXPECT_THAT(refusal("normal.stifness=1"),
              ThrowsMessage<InputError>(HasSubstr("\"normal.stifness\" is not a parameter")));
  EXPECT_THAT(refusal("normal.stiffness"), ThrowsMessage<InputError>(HasSubstr("has no value")));
  EXPECT_THAT(refusal("normal.stiffness=stiff"),
              ThrowsMessage<InputError>(HasSubstr("\"stiff\", expected a finite")));
  EXPECT_THAT(refusal("normal.stiffness=nan"), ThrowsMessage<InputError>(HasSubstr("\"nan\"")));
  EXPECT_THAT(refusal("normal.stiffness=-1"), ThrowsMessage<InputError>(HasSubstr("must be positive")));
  EXPECT_THAT(refusal("normal.stiffness=1,normal.stiffness=2"),
              ThrowsMessage<InputError>(HasSubstr("given twice")));
  EXPECT_THAT(refusal("normal.stiffness=1,friction.coefficient=0.5"),
              ThrowsMessage<InputError>(HasSubstr("friction.stiffness is missing")));
  EXPECT_THAT(
      refusal("normal.modulus=1,normal.poisson=0.3,friction.coefficient=0.5,friction.stiffness=1"),
      ThrowsMessage<InputError>(HasSubstr("friction.law = \"coulomb\" does not go with contact.normal.law = "
                                          "\"hertz\", under which it follows from Poisson's ratio")));
  EXPECT_THAT(
      refusal("normal.stiffness=1,normal.modulus=1"),
      ThrowsMessage<InputError>(HasSubstr("normal.modulus: normal.law = linear has no such parameter")));
  EXPECT_THAT(refusal("normal.stiffness=1,adhesion.range=0.1"),
              ThrowsMessage<InputError>(HasSubstr("adhesion.force is missing")));
  EXPECT_THAT(refusal("normal.stiffness=1,damping.restitution=0.5,damping.mass=heavy"),
              ThrowsMessage<InputError>(HasSubstr("expected effective or grain")));
}

}  // namespace
}  // namespace floc
