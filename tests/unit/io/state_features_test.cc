#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/state_file.h"
#include "support/contact_laws.h"
#include "support/scratch_directory.h"
#include "support/sealed.h"
#include "support/springs.h"
#include "support/states.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(StateFeatures, ThatAReaderDoesNotKnowAreRefusedByName) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), busy_state<2>());
  const std::string foreign = with_replaced(scratch.file("s.h5"), "contacts/memory", "contacts/liquid");
  EXPECT_THAT([&] { read_state(foreign); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("does not support contacts/liquid"), HasSubstr("contacts/memory"))));
}

TEST(StateFeatures, NameTheMemoryOfLawsThatHaveOne) {
  const ScratchDirectory scratch;
  State<2> bare = busy_state<2>();
  bare.packing.law = Law{};
  bare.packing.law += test::linear(1e5);
  refresh_contacts(bare.packing);
  write_state(scratch.file("bare.h5"), bare);
  EXPECT_EQ(read_file(scratch.file("bare.h5")).find("contacts/memory"), std::string::npos);
  EXPECT_EQ(std::get<State<2>>(read_state(scratch.file("bare.h5"))).packing.contacts.size(),
            bare.packing.contacts.size());
}

}  // namespace
}  // namespace floc::test
