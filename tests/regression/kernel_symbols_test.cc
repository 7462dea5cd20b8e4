#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "support/places.h"
#include "support/scratch_directory.h"

namespace floc::test {
namespace {

// A function that several translation units define inline is kept once by the linker, from any of them: were it
// kept from one that was compiled for AVX-512, programs would end on processors without.
TEST(StepKernels, ShareNoInlineFunctionWithCodeForOtherProcessors) {
  const ScratchDirectory scratch;
  const std::string symbols = scratch.file("symbols");
  const std::string command = "nm --defined-only '" + relaxation_library() + "' >'" + symbols + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream lines(symbols);
  int n_own = 0;
  bool of_wide_kernels = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(".o:")) of_wide_kernels = line.starts_with("step_kernels_avx");
    if (!of_wide_kernels || line.size() < 20) continue;
    const char kind = line[17];  // address, blank, kind, blank, name
    if (kind != 'W' && kind != 'V' && kind != 'u') continue;
    EXPECT_TRUE(line.find("4Avx2E") != std::string::npos || line.find("6Avx512E") != std::string::npos) << line;
    ++n_own;
  }
  EXPECT_GT(n_own, 0);
}

}  // namespace
}  // namespace floc::test
