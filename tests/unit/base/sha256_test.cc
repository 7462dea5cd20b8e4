#include "floc/base/sha256.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "floc/base/error.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

// The examples published with FIPS 180-4 (NIST, "SHA-256 examples"): the empty message, a message of one block,
// a message of two blocks, and a million bytes.
TEST(Sha256, GivesThePublishedExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/// The lengths of the tested messages are near multiples of 64 bytes, the size of a block, and near 56 bytes. From 56
/// bytes on, the field with the length of the message no longer fits into the same block.
TEST(Sha256, DoesNotDependOnThePiecesThatBytesComeIn) {
  std::string bytes;
  for (int k = 0; k < 300; ++k) bytes += static_cast<char>(37 * k);
  for (const std::size_t size : {0, 1, 55, 56, 63, 64, 65, 119, 128, 300}) {
    const std::string_view whole = std::string_view(bytes).substr(0, size);
    for (const std::size_t piece : {1, 7, 64, 100}) {
      Sha256 hash;
      for (std::size_t at = 0; at < size; at += piece) hash.update(whole.substr(at, piece));
      EXPECT_EQ(hash.digits(), sha256(whole)) << size << " bytes in pieces of " << piece;
    }
  }
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("abc");
  std::ofstream(path) << "abc";
  EXPECT_EQ(sha256_of_file(path), sha256("abc"));
  std::remove(path.c_str());
  EXPECT_THROW(sha256_of_file(path), InputError);
}

}  // namespace
}  // namespace floc
