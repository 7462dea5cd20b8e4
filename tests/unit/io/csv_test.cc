#include "floc/io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "floc/base/error.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

CsvTable parse(const std::string& text, const std::vector<std::string>& wanted = {}) {
  std::istringstream in(text);
  return CsvTable::parse("t.csv", in, wanted);
}

TEST(Csv, ReadsNumbersByColumnNameAndSkipsComments) {
  const CsvTable t = parse("# made by hand\n x , y\r\n1.5, -2e-3\r\n\n+3,4\n");
  EXPECT_THAT(t.columns(), ElementsAre("x", "y"));
  ASSERT_EQ(t.n_rows(), 2);
  EXPECT_EQ(t.number(0, t.column("y")), -2e-3);
  EXPECT_EQ(t.number(1, t.column("x")), 3.0);
  EXPECT_EQ(t.integer(1, t.column("y")), 4);
  EXPECT_EQ(t.place(1), "t.csv:5");
  EXPECT_TRUE(t.has("x"));
  EXPECT_FALSE(t.has("z"));
}

TEST(Csv, TakesTabsAndSemicolonsForSeparatorsToo) {
  EXPECT_EQ(parse("a\tb\n1\t2\n").number(0, 1), 2.0);
  EXPECT_EQ(parse("a;b\n1;2\n").number(0, 1), 2.0);
}

TEST(Csv, KeepsSeparatorsAndQuotesInsideQuotedCells) {
  const CsvTable t = parse("\"a,b\",c\n\"1, \"\"2\"\"\",\"\"\n");
  EXPECT_THAT(t.columns(), ElementsAre("a,b", "c"));
  EXPECT_EQ(t.text(0, 0), "1, \"2\"");
  EXPECT_TRUE(t.is_empty(0, 1));
}

TEST(Csv, NamesFileLineAndColumnOfWhatItCannotRead) {
  const CsvTable t = parse("x,y\n1,abc\n2,\n3,nan\n4,1.5\n");
  EXPECT_THAT([&] { t.number(0, 1); },
              ThrowsMessage<InputError>("t.csv:2: y = \"abc\", expected a finite number"));
  EXPECT_THAT([&] { t.number(1, 1); }, ThrowsMessage<InputError>(StartsWith("t.csv:3: y = \"\"")));
  EXPECT_THAT([&] { t.number(2, 1); }, ThrowsMessage<InputError>(StartsWith("t.csv:4: y = \"nan\"")));
  EXPECT_THAT([&] { t.integer(3, 1); }, ThrowsMessage<InputError>("t.csv:5: y = \"1.5\", expected an integer"));
  EXPECT_THAT([&] { t.column("z"); },
              ThrowsMessage<InputError>("t.csv: the table has no column \"z\"; its columns are x, y"));
}

TEST(Csv, RefusesALineOfAnotherLengthAndATableWithoutHeader) {
  EXPECT_THAT(
      [] { parse("x,y\n1,2\n1,2,b\n"); },
      ThrowsMessage<InputError>("t.csv:3: the line has 3 cells, expected 2 as in the header of the table"));
  EXPECT_THAT([] { parse("x,y\n\"1,2\n"); }, ThrowsMessage<InputError>(HasSubstr("t.csv:2: a quoted cell")));
  EXPECT_THAT([] { parse("# nothing\n"); }, ThrowsMessage<InputError>(HasSubstr("no header")));
  EXPECT_THAT([] { CsvTable::read("nowhere.csv"); }, ThrowsMessage<InputError>(HasSubstr("No such file")));
}

TEST(Csv, ReadsDecimalCommasUnlessTheySeparateCells) {
  const CsvTable t = parse("x;y\n0,5;-1,5e3\n1,2,3;a,b\n2;1,0\n");
  EXPECT_EQ(t.number(0, 0), 0.5);
  EXPECT_EQ(t.number(0, 1), -1500.0);
  EXPECT_EQ(t.integer(0, 1), -1500);
  EXPECT_EQ(t.integer(2, 1), 1);
  EXPECT_EQ(t.text(0, 0), "0,5");
  EXPECT_EQ(t.number_text(0, 0), "0.5");
  EXPECT_THAT([&] { t.number(1, 0); },
              ThrowsMessage<InputError>("t.csv:3: x = \"1,2,3\", expected a finite number "
                                        "without separators of thousands"));
  EXPECT_THAT([&] { t.number(1, 1); },
              ThrowsMessage<InputError>("t.csv:3: y = \"a,b\", expected a finite number"));
  EXPECT_THAT([] { parse("x,y\n0,5,1\n"); },
              ThrowsMessage<InputError>(AllOf(StartsWith("t.csv:2: the line has 3 cells, expected 2"),
                                              HasSubstr("decimal point, not a comma"))));
}

TEST(Csv, RefusesPointsAmongDecimalCommas) {
  const CsvTable t = parse("p;e\n800;0,9\n1.600;0,8\n");
  EXPECT_EQ(t.number(0, 0), 800.0);
  EXPECT_THAT(
      [&] { t.number(1, 0); },
      ThrowsMessage<InputError>(
          "t.csv:3: p = \"1.600\" has a point, but \"0,9\" in line 2 has a decimal comma: expected one decimal "
          "mark in all numbers, and no separators of thousands"));
  EXPECT_THAT([&] { t.integer(1, 0); }, ThrowsMessage<InputError>(HasSubstr("has a point")));
}

TEST(Csv, FindsTheNamesBelowTitlesAndTheUnitsBelowTheNames) {
  const CsvTable t = parse(
      "Sample 12, tested 3 May\nDepth,4.5\n\nSpannung,Porenzahl\np,e\n[kPa],[-]\n1,2\n,\n3,4\n", {"p", "e"});
  EXPECT_THAT(t.columns(), ElementsAre("p", "e"));
  EXPECT_EQ(t.n_rows(), 2);
  EXPECT_EQ(t.place(1), "t.csv:9");
  EXPECT_EQ(t.unit_cell(0), "[kPa]");
  ASSERT_FALSE(t.other_names().empty());
  EXPECT_THAT(t.other_names()[0], ElementsAre("Spannung", "Porenzahl"));
  EXPECT_THAT(t.description(),
              AllOf(HasSubstr("columns named in line 5, below a title"), HasSubstr("units in line 6")));
  EXPECT_EQ(parse("x,y\n1,2\n").description(), "");
  // After a line of column names, even a row without numbers is a row of data.
  EXPECT_THAT(
      [] {
        parse("p,e\nabc,def\n1,2\n", {"p", "e"}).number(0, 0);
      },
      ThrowsMessage<InputError>(HasSubstr("p = \"abc\"")));
  for (const char* text : {"p,e\n,\nnan,nan\n1,2\n", "p,e\nnan,nan\n1,2\n", "p,e\nNA,\n1,2\n"})
    EXPECT_EQ(parse(text).n_rows(), 2) << text;
  EXPECT_EQ(parse("p,e\n,\nkPa,-\n1,2\n").n_rows(), 1);
}

TEST(Csv, ReadsQuotedNamesOfSeveralLines) {
  const CsvTable t = parse("\"Effective\nstress (kPa)\",\"Void\r\nratio\"\n1,2\n3,4\n");
  EXPECT_THAT(t.columns(), ElementsAre("Effective stress (kPa)", "Void ratio"));
  EXPECT_EQ(t.place(1), "t.csv:5");
  // The inch sign (") inside a text is not a quotation mark.
  EXPECT_THAT(parse("Pipe of 5\" bore\nSample of 3\" bore\nx,y\n1,2\n").columns(), ElementsAre("x", "y"));
}

TEST(Csv, HasOneNamePerColumnInEveryLineOfNames) {
  const CsvTable t = parse("Test,of,x\np,e,\n1,2,\n3,4,\n");
  ASSERT_EQ(t.other_names().size(), 1u);
  EXPECT_EQ(t.other_names()[0].size(), t.columns().size());
}

TEST(Csv, TakesARowForUnitsThatHasSomeItDoesNotKnow) {
  const CsvTable t = parse("p,e,T,remark\nkPa,-,Grad,\n1,2,20,\n");
  EXPECT_EQ(t.n_rows(), 1);
  EXPECT_EQ(t.unit_cell(0), "kPa");
}

TEST(Csv, ReadsMinusSignsAndNoBreakSpaces) {
  const CsvTable t = parse(
      "x;y\n\xe2\x88\x92"
      "1,5;\xc2\xa0"
      "2\n");
  EXPECT_EQ(t.number(0, 0), -1.5);
  EXPECT_EQ(t.number(0, 1), 2.0);
}

TEST(Csv, FindsTheNamesInACommentAboveTheNumbers) {
  const CsvTable t = parse("# written by a program\n# x y radius\n1 2 3\n");
  EXPECT_THAT(t.columns(), ElementsAre("x", "y", "radius"));
  EXPECT_THAT([] { parse("1,2\n3,4\n"); },
              ThrowsMessage<InputError>(HasSubstr("the table has no header: no line above")));
}

TEST(Csv, SeparatesColumnsAtBlanksAlsoWhereTheirNamesHaveUnits) {
  const CsvTable t = parse("  x [mm]  y [mm]  radius\n  1  2  3.5\n 10 20  4.5\n");
  EXPECT_THAT(t.columns(), ElementsAre("x [mm]", "y [mm]", "radius"));
  EXPECT_EQ(t.number(1, 2), 4.5);
  EXPECT_THAT(parse("Void ratio   Pressure\n0.5 1\n0.4 2\n").columns(), ElementsAre("Void ratio", "Pressure"));
}

}  // namespace
}  // namespace floc
