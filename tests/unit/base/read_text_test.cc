#include "floc/base/read_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string_view>

#include "floc/base/error.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using namespace std::string_view_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ReadText, LeavesOutTheByteOrderMarkOfUtf8) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("t.txt")) << "\xef\xbb\xbfx,y\n";
  EXPECT_EQ(read_text(scratch.file("t.txt")), "x,y\n");
  EXPECT_EQ(without_byte_order_mark("x"), "x");
  EXPECT_EQ(without_byte_order_mark(""), "");
}

TEST(ReadText, NamesOtherEncodings) {
  for (const auto& [text, encoding] : {std::pair{"\xff\xfex\0"sv, "UTF-16"},
                                       {"\xfe\xff\0x"sv, "UTF-16"},
                                       {"x\0,\0"sv, "UTF-16"},
                                       {"\0x\0,"sv, "UTF-16"},
                                       {"\xff\xfe\0\0x\0\0\0"sv, "UTF-32"},
                                       {"\0\0\xfe\xff\0\0\0x"sv, "UTF-32"}})
    EXPECT_THAT([given = text] { require_text("t.txt", given); },
                ThrowsMessage<InputError>(std::string("t.txt: the file is in the encoding ") + encoding +
                                          ": save it as UTF-8"));
}

TEST(ReadText, RefusesLinesThatEndInCarriageReturnsAlone) {
  for (const std::string_view text : {"x,y\r1,2\r"sv, "x,y\r\r1,2\n"sv})
    EXPECT_THAT([text] { require_text("t.txt", text); },
                ThrowsMessage<InputError>(HasSubstr("the lines of this file end in carriage returns alone")));
  for (const std::string_view text : {""sv, "x"sv, "\n"sv, "x,y\n1\r2\n"sv, "x\r\n1\r\n"sv, "x\r\r\n1\r\r\n"sv,
                                      "x\r"sv, "\x1f\x8b\x08\0\r1"sv})
    EXPECT_NO_THROW(require_text("t.txt", text)) << text;
}

TEST(ReadText, HintsAtADecimalCommaOnlyWhereAPointMakesANumber) {
  for (const char* text : {"0,5", "-1,5e-3", " 3, ", ",5"}) EXPECT_NE(decimal_comma_hint(text), "") << text;
  for (const char* text : {"", ",", "0.5", "1,2,3", "a,b", "1,2 3", "1.5,2"})
    EXPECT_EQ(decimal_comma_hint(text), "") << text;
}

}  // namespace
}  // namespace floc
