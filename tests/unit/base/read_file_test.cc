#include "floc/base/read_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "floc/base/error.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

/// Returns a text that is longer than the buffer for reading files. gzip cannot compress it much.
std::string long_text() {
  std::string text;
  for (unsigned k = 0, noise = 1; k < 60'000; ++k)
    text += std::to_string(noise = noise * 1664525U + 1013904223U);
  return text;
}

TEST(ReadBeginning, IsThatOfTheFileAndOfACompressedOne) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("long.txt"), text = long_text();
  std::ofstream(path) << text;
  ASSERT_EQ(std::system(("gzip -k " + path).c_str()), 0);
  for (const std::string& file : {path, path + ".gz"}) {
    EXPECT_EQ(read_beginning(file, 0), "") << file;
    EXPECT_EQ(read_beginning(file, 4), text.substr(0, 4)) << file;
    EXPECT_EQ(read_beginning(file, 1 << 16), text.substr(0, 1 << 16)) << file;
    EXPECT_EQ(read_file(file), text) << file;
  }
}

TEST(ReadBeginning, OfAShortFileIsTheWholeFile) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("short.txt")) << "x,y\n";
  EXPECT_EQ(read_beginning(scratch.file("short.txt"), 1000), "x,y\n");
}

TEST(ReadBeginning, SaysWhyAFileCannotBeRead) {
  const test::ScratchDirectory scratch;
  EXPECT_THAT([&] { read_beginning(scratch.file("none"), 10); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("none: No such file or directory")));
  EXPECT_THAT([&] { read_beginning(scratch.file(""), 10); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("this is a directory")));
}

}  // namespace
}  // namespace floc
