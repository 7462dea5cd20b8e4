#include "floc/io/table_text.h"

#include <gtest/gtest.h>

#include <string_view>

#include "floc/base/error.h"

namespace floc {
namespace {

using namespace std::string_view_literals;

TEST(TableText, IsInUtf8WhateverTheEncodingOfTheFile) {
  struct Encoded {
    std::string_view bytes, encoding;
  };
  for (const auto& [bytes, encoding] : {Encoded{"\xc3\xa4,\xe2\x82\xac\n"sv, ""},
                                        {"\xef\xbb\xbf\xc3\xa4,\xe2\x82\xac\n"sv, ""},
                                        {"\xe4,\x80\n"sv, "Latin-1"},
                                        {"\xff\xfe\xe4\0,\0\xac\x20\n\0"sv, "UTF-16"},
                                        {"\xfe\xff\0\xe4\0,\x20\xac\0\n"sv, "UTF-16"}}) {
    const TableText decoded = decoded_table("t", std::string(bytes));
    EXPECT_EQ(decoded.text, "\xc3\xa4,\xe2\x82\xac\n");
    EXPECT_EQ(decoded.encoding, encoding);
  }
  EXPECT_EQ(decoded_table("t", std::string("x\0,\0y\0"sv)).text, "x,y");
  EXPECT_EQ(decoded_table("t", std::string("\xff\xfe\x3d\xd8\x00\xde"sv)).text, "\xf0\x9f\x98\x80");
  EXPECT_EQ(decoded_table("t", "").text, "");
  EXPECT_THROW(decoded_table("t", std::string("\xff\xfe\0\0x\0\0\0"sv)), InputError);
}

TEST(TableText, HasTheLineEndsOfUnixInPlaceOfThoseOfOldMacs) {
  EXPECT_EQ(decoded_table("t", "x\r1\r").text, "x\n1\n");
  EXPECT_EQ(decoded_table("t", "x\r\n1\r\n").text, "x\r\n1\r\n");
}

}  // namespace
}  // namespace floc
