#include "floc/io/hdf5_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "floc/base/error.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// The file has a dataset with a nominal size of 8e9 bytes. Nothing was written to this dataset, so it takes no space
/// in the file, but reading it would need 8e9 bytes of memory.
TEST(Hdf5Reader, TakesNoMemoryForWhatIsLongerThanItsFile) {
  constexpr std::uint64_t kRows = 1'000'000'000;
  const test::ScratchDirectory scratch;
  Hdf5Writer writer(scratch.file("s.h5"));
  writer.array("rows", {kRows}, std::vector<double>{});
  writer.close();
  ASSERT_LT(std::filesystem::file_size(scratch.file("s.h5")), 10'000u);
  const Hdf5Reader reader("s.h5", scratch.file("s.h5"));
  EXPECT_THAT([&] { reader.n_rows("rows"); },
              ThrowsMessage<InputError>(HasSubstr(
                  "s.h5:/rows: the dataset has 1e+09 bytes according to its header, but the whole file has ")));
  std::vector<double> values;
  EXPECT_THAT([&] { reader.array("rows", {kRows}, values); },
              ThrowsMessage<InputError>(HasSubstr(
                  "s.h5:/rows: the dataset has 8e+09 bytes according to its header, but the whole file has ")));
  EXPECT_EQ(values.capacity(), 0u);
}

TEST(Hdf5Reader, RefusesNumbersWhereATextIsExpected) {
  const test::ScratchDirectory scratch;
  Hdf5Writer writer(scratch.file("s.h5"));
  writer.array("scene", {1}, std::vector<double>{1.0});
  writer.close();
  const Hdf5Reader reader("s.h5", scratch.file("s.h5"));
  EXPECT_THAT([&] { (void)reader.text("scene"); },
              ThrowsMessage<InputError>(HasSubstr("s.h5:/scene: the dataset is not a string")));
}

}  // namespace
}  // namespace floc
