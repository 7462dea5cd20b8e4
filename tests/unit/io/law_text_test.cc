#include "floc/io/law_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LawText, GivesBackEveryLawItWrites) {
  Law law;
  law += test::linear(1e5 / 3.0);
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law += test::constant_adhesion(1.0);
  law += test::coulomb(0.5, 1e5);
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law += test::tail_adhesion(1.0, 1e-3);
  law += test::viscous_damping(0.015);
  law += test::chosen("damping.mass", "grain");
  law += test::rolling_spring(0.005, 10.0);
  EXPECT_EQ(parse_law("", law_text(law)), law);
}

/// For elastic spheres, friction needs only a friction coefficient. For linear contacts, it also needs a tangential
/// stiffness.
TEST(LawText, KnowsAModelByItsNumbersAndByWhatItGoesWith) {
  Law law;
  law += test::hertz(70.0, 0.3);
  law += test::mindlin(0.3);
  law += test::critical_damping(0.5);
  EXPECT_EQ(law_text(law),
            "normal.modulus=70, normal.poisson=0.3, damping.critical_fraction=0.5, friction.coefficient=0.3");
  EXPECT_EQ(parse_law("", law_text(law)), law);
  EXPECT_EQ(parse_law("", "friction.law=mindlin, " + law_text(law)), law);
}

TEST(LawText, GivesBackLiquidBridgesWithTheirChoices) {
  Law law;
  law += test::linear(1e5);
  law += test::liquid(0.072, 10.0, 0.007, 2.6);
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law += test::liquid(0.072, 10.0, 0.007, 2.6, "rational", "contact");
  EXPECT_EQ(parse_law("", law_text(law)), law);
  law += test::hertz(7e10, 0.3);
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
      ThrowsMessage<InputError>(HasSubstr(
          "friction.law = \"coulomb\" cannot be combined with contact.normal.law = "
          "\"hertz\", because the tangential stiffness of elastic spheres follows from Poisson's ratio")));
  EXPECT_THAT(refusal("normal.stiffness=1,normal.modulus=1"),
              ThrowsMessage<InputError>(
                  HasSubstr("normal.modulus is given, but normal.law = linear has no such parameter")));
  EXPECT_THAT(refusal("normal.stiffness=1,adhesion.range=0.1"),
              ThrowsMessage<InputError>(HasSubstr("adhesion.force is missing")));
  EXPECT_THAT(refusal("normal.stiffness=1,damping.restitution=0.5,damping.mass=heavy"),
              ThrowsMessage<InputError>(HasSubstr("expected effective or grain")));
}

}  // namespace
}  // namespace floc
