#include "floc/io/table.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace floc {
namespace {

Table sample() {
  return {{"file", "n", "x", "ok"},
          {{std::string("a,\"b\".h5"), std::int64_t{3}, 1.0 / 3.0, true},
           {std::string("c.h5"), std::int64_t{-12345}, std::numeric_limits<double>::quiet_NaN(),
            std::monostate{}}}};
}

std::string printed(const Table& table, TableFormat format) {
  std::ostringstream out;
  write_table(out, table, format);
  return out.str();
}

TEST(Table, AsCsvHasTheNamesAloneFirstAndNumbersThatReadBack) {
  EXPECT_EQ(printed(sample(), TableFormat::csv),
            "file,n,x,ok\n"
            "\"a,\"\"b\"\".h5\",3,0.3333333333333333,true\n"
            "c.h5,-12345,,\n");
  EXPECT_EQ(std::stod("0.3333333333333333"), 1.0 / 3.0);
}

TEST(Table, AsJsonIsAnArrayOfObjectsWithNullForUndefined) {
  const auto json = nlohmann::json::parse(printed(sample(), TableFormat::json));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["file"], "a,\"b\".h5");
  EXPECT_EQ(json[0]["x"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json[0]["ok"], true);
  EXPECT_EQ(json[1]["n"], -12345);
  EXPECT_TRUE(json[1]["x"].is_null());
  EXPECT_TRUE(json[1]["ok"].is_null());
}

TEST(Table, ForReadingIsAlignedWithSixDigits) {
  EXPECT_EQ(printed(sample(), TableFormat::table),
            "file           n         x    ok\n"
            "a,\"b\".h5       3  0.333333  true\n"
            "c.h5      -12345         -     -\n");
}

TEST(Table, WithoutRowsStillNamesItsColumns) {
  const Table empty{{"a", "b"}, {}};
  EXPECT_EQ(printed(empty, TableFormat::csv), "a,b\n");
  EXPECT_EQ(printed(empty, TableFormat::json), "[]\n");
}

}  // namespace
}  // namespace floc
