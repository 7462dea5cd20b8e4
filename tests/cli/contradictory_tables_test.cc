#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/run_arguments.h"

/// Tests that every fit of a load path rejects tables whose columns contradict each other, and that `--columns` may not
/// be given twice.
namespace floc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kFitsOfPaths[] = {"consolidation", "preconsolidation", "elastic", "cycle"};

class ContradictoryTables : public testing::Test {
 protected:
  static Outcome fit(const std::string& which, const std::string& table, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"fit", which, "-", "--format", "csv"});
    return floc_arguments(more, table);
  }
  void refused(const Outcome& o, const testing::Matcher<std::string>& words) {
    EXPECT_EQ(o.code, 4) << o.err;
    EXPECT_THAT(o.err, words);
    ++n_refused_;
  }
  void accepted(const Outcome& o) {
    EXPECT_THAT(o.code, testing::AnyOf(0, 3)) << o.err;
    ++n_accepted_;
  }

  int n_refused_ = 0, n_accepted_ = 0;
};

/// Returns the table of a path with phi and void ratios. The void ratios are computed from phi, then multiplied by
/// `times` and rounded to `decimals` decimals.
std::string both(double times, int decimals = 17) {
  std::string table = "branch,P_star,phi,void_ratio\n";
  for (int k = 0; k < 12; ++k) {
    const double phi = 0.4 + 0.0231 * k;
    table += fmt::format("load,{},{:.{}f},{:.{}f}\n", 0.01 * (k + 1), phi, decimals, times * (1 / phi - 1),
                         decimals);
  }
  return table;
}

TEST_F(ContradictoryTables, AreRefusedByEveryFit) {
  for (const char* which : kFitsOfPaths) {
    SCOPED_TRACE(which);
    for (const char* name : {"branch", "P_star", "phi"})
      refused(fit(which, fmt::format("branch,P_star,phi,{0}\nload,0.1,0.5,{1}\nload,0.2,0.52,{1}\n", name,
                                     name == std::string("branch") ? "load" : "0.5")),
              HasSubstr(fmt::format("are both named \"{}\"", name)));
    refused(fit(which, "P_star,void_ratio,void_ratio\n0.1,0.5,0.6\n"), HasSubstr("both named \"void_ratio\""));
    refused(fit(which, "P_star [kPa],P_star [Pa],phi\n0.1,100,0.5\n"), HasSubstr("both named \"P_star\""));
    for (const double times : {0.5, 0.9, 1.01, 1.0001, 2.0})
      refused(fit(which, both(times)),
              AllOf(HasSubstr("phi = 0.4"), HasSubstr("void_ratio = "), HasSubstr("contradict")));
    accepted(fit(which, both(1.0)));
    accepted(fit(which, both(1.0, 3)));  // rounded to three decimals, as in printed tables
    accepted(fit(which, both(2.0), {"--columns", "phi=phi"}));
    accepted(fit(which, both(2.0), {"--columns", "void_ratio=void_ratio"}));
    refused(fit(which, both(1.0), {"--columns", "phi=phi,phi=void_ratio"}),
            HasSubstr("--columns: the name phi is given twice"));
    accepted(fit(which, both(1.0), {"--columns", "phi=phi", "--columns", "P_star=P_star"}));
  }
  fmt::print("{} fits: {} tables refused, {} accepted\n", std::size(kFitsOfPaths), n_refused_, n_accepted_);
}

TEST_F(ContradictoryTables, WithAVoidRatioThatIsNamedAreReadByIt) {
  std::string table = "P_star,phi,e\n", plain = "P_star,void_ratio\n";
  for (int k = 0; k < 20; ++k) {
    const double e = 2.0 - 0.08 * k;
    table += fmt::format("{},0.5,{}\n", 0.01 * (k + 1), e), plain += fmt::format("{},{}\n", 0.01 * (k + 1), e);
  }
  EXPECT_EQ(fit("consolidation", table, {"--columns", "void_ratio=e"}).out, fit("consolidation", plain).out);
}

TEST(ColumnsOption, GivenTwiceIsOneList) {
  const ScratchDirectory scratch;
  write_text(scratch.file("oedo.csv"), "p,e\n0.1,1.2\n0.2,1.1\n0.4,1.0\n0.8,0.9\n1.6,0.8\n3.2,0.75\n6.4,0.7\n");
  const auto fitted = [&](const std::vector<std::string>& columns) {
    std::vector<std::string> arguments = {"fit", "consolidation", scratch.file("oedo.csv"), "--format", "csv"};
    for (const std::string& given : columns) arguments.insert(arguments.end(), {"--columns", given});
    return floc_arguments(arguments);
  };
  const Outcome once = fitted({"P_star=p,void_ratio=e,parameter,value"});
  EXPECT_EQ(once.out.substr(0, once.out.find('\n')), "parameter,value");
  for (const auto& columns : {std::vector<std::string>{"P_star=p,void_ratio=e", "parameter,value"},
                              {"P_star=p", "void_ratio=e", "parameter", "value"},
                              {"parameter,value", "void_ratio=e,P_star=p"}}) {
    const Outcome several = fitted(columns);
    EXPECT_EQ(several.code, once.code) << several.err;
    EXPECT_EQ(several.out, once.out);
  }
  write_text(scratch.file("g.csv"), "X,Y,R\n0,0,0.5\n0.999,0,0.5\n");
  write_text(scratch.file("c.csv"), "a,b\n0,1\n");
  const Outcome converted =
      floc_arguments({"convert", scratch.file("g.csv"), scratch.file("s.h5"), "--law", "normal.stiffness=1000",
                      "--cell", "3,0;0,3", "--columns", "x=X", "--columns", "y=Y,radius=R", "--contacts",
                      scratch.file("c.csv"), "--contact-columns", "id1=a", "--contact-columns", "id2=b"});
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_THAT(
      floc_arguments({"convert", scratch.file("g.csv"), scratch.file("s.h5"), "--law", "normal.stiffness=1000",
                      "--cell", "3,0;0,3", "--overwrite", "--columns", "x=X,y=Y,radius=R,x=Y"})
          .err,
      HasSubstr("--columns: x is given twice"));
}

}  // namespace
}  // namespace floc::test
