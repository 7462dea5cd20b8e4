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
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

CsvTable parse(const std::string& text) {
  std::istringstream in(text);
  return CsvTable::parse("t.csv", in);
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
      ThrowsMessage<InputError>("t.csv:3: the line has 3 cells, expected 2 as in the header of the csv table"));
  EXPECT_THAT([] { parse("x,y\n\"1,2\n"); }, ThrowsMessage<InputError>(HasSubstr("t.csv:2: a quoted cell")));
  EXPECT_THAT([] { parse("# nothing\n"); }, ThrowsMessage<InputError>(HasSubstr("no header")));
  EXPECT_THAT([] { CsvTable::read("nowhere.csv"); }, ThrowsMessage<InputError>(HasSubstr("No such file")));
}

TEST(Csv, NamesDecimalCommasTitlesAndColumnsSeparatedByBlanks) {
  const char* words = "decimal point, not a comma";
  const CsvTable t = parse("x;y\n0,5;-1,5e3\n1,2,3;a,b\n");
  EXPECT_THAT([&] { t.number(0, 0); },
              ThrowsMessage<InputError>(
                  "t.csv:2: x = \"0,5\", expected a finite number with a decimal point, not a comma"));
  EXPECT_THAT([&] { t.integer(0, 1); }, ThrowsMessage<InputError>(HasSubstr(words)));
  EXPECT_THAT([&] { t.number(1, 0); }, ThrowsMessage<InputError>(Not(HasSubstr(words))));
  EXPECT_THAT([&] { t.number(1, 1); }, ThrowsMessage<InputError>(Not(HasSubstr(words))));
  EXPECT_THAT([] { parse("x,y\n0,5,1\n"); },
              ThrowsMessage<InputError>(
                  AllOf(StartsWith("t.csv:2: the line has 3 cells, expected 2"), HasSubstr(words))));
  for (const char* titled : {"Sample 12, 3 May\np,e\n1,2\n", "Sample 12\np,e\n1,2\n"})
    EXPECT_THAT([titled] { parse(titled).column("e"); },
                ThrowsMessage<InputError>(HasSubstr("is a title, remove it or put # before it")));
  EXPECT_THAT(
      [] { parse("x y r\n1 2 3\n").column("x"); },
      ThrowsMessage<InputError>(HasSubstr("have to be separated by a comma, semicolon or tab, not blanks")));
}

}  // namespace
}  // namespace floc
