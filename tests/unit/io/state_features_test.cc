#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/state_file.h"
#include "support/scratch_directory.h"
#include "support/sealed.h"
#include "support/springs.h"
#include "support/states.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A state file with every `from` in its content replaced by a text of the same length.
std::string with_replaced(const std::string& path, const std::string& from, const std::string& to) {
  const std::string bytes = read_file(path);
  std::string content = without_seal(bytes);
  std::size_t n = 0;
  for (std::size_t at = content.find(from); at != std::string::npos;
       at = content.find(from, at + to.size()), ++n)
    content.replace(at, from.size(), to);
  EXPECT_EQ(n, 1u);
  const std::string other = path + ".other";
  std::ofstream(other, std::ios::binary) << sealed(content);
  return other;
}

TEST(StateFeatures, ThatAReaderDoesNotKnowAreRefusedByName) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string foreign = with_replaced(scratch.file("s.h5"), "contacts/memory", "contacts/liquid");
  EXPECT_THAT([&] { read_state(foreign); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("does not know contacts/liquid"), HasSubstr("contacts/memory"))));
}

TEST(StateFeatures, NameTheMemoryOfLawsThatHaveOne) {
  const ScratchDirectory scratch;
  State<2> bare = busy_state<2>();
  bare.packing.law = LawParameters{};
  bare.packing.law.normal = LinearRepulsion{1e5};
  refresh_contacts(bare.packing);
  write_state(scratch.file("bare.h5"), bare);
  EXPECT_EQ(read_file(scratch.file("bare.h5")).find("contacts/memory"), std::string::npos);
  EXPECT_EQ(std::get<State<2>>(read_state(scratch.file("bare.h5"))).packing.contacts.size(),
            bare.packing.contacts.size());
}

}  // namespace
}  // namespace floc::test
