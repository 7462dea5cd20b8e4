#include "floc/planning/duration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"

namespace floc {
namespace {

TEST(Duration, IsReadInEveryUnit) {
  constexpr double kYear = 365.25 * 86400.0;
  for (const auto& [text, seconds] : std::vector<std::pair<std::string, double>>{{"90", 90},
                                                                                 {"90s", 90},
                                                                                 {"90 s", 90},
                                                                                 {"1 second", 1},
                                                                                 {"30min", 1800},
                                                                                 {"1.5 minutes", 90},
                                                                                 {"2h", 7200},
                                                                                 {"2 hours", 7200},
                                                                                 {"0.5d", 43200},
                                                                                 {"3 days", 259200},
                                                                                 {"1y", kYear},
                                                                                 {"10 years", 10 * kYear},
                                                                                 {"1e3s", 1000},
                                                                                 {"1e-3h", 3.6},
                                                                                 {"2E+1 min", 1200}})
    EXPECT_DOUBLE_EQ(duration_of("--budget", text), seconds) << text;
}

TEST(Duration, OtherTextsAreRefusedWithWhatIsExpected) {
  for (const char* text :
       {"", "h", "-1h", "0s", "2m", "2 fortnights", "nan", "inf", "1h30", "1e999s", "1e", "2hh", "٣h"})
    try {
      (void)duration_of("--budget", text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  testing::HasSubstr("--budget " + std::string(text) +
                                     ": expected a positive number with one of the units s, min, h, d"))
          << text;
    }
}

TEST(Duration, IsWrittenInTheLargestUnitOfAtLeastOne) {
  EXPECT_EQ(duration_in_words(0.25), "0.25 s");
  EXPECT_EQ(duration_in_words(59), "59 s");
  EXPECT_EQ(duration_in_words(90), "1.5 min");
  EXPECT_EQ(duration_in_words(7200), "2 h");
  EXPECT_EQ(duration_in_words(86400 * 3), "3 d");
  EXPECT_EQ(duration_in_words(86400 * 730.5), "2 y");
  for (const double seconds : {1e-3, 7.0, 600.0, 1e4, 1e6, 1e9})
    EXPECT_NEAR(duration_of("", duration_in_words(seconds)), seconds, 0.006 * seconds);
}

}  // namespace
}  // namespace floc
