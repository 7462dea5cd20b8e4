#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/scratch_directory.h"

namespace floc::test {
namespace {

/// Returns the lines that nm prints for a library.
std::vector<std::string> symbols(const std::string& library, const std::string& options) {
  const ScratchDirectory scratch;
  const std::string file = scratch.file("symbols");
  const std::string command = "nm " + options + " '" + library + "' >'" + file + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// If several source files define an inline function, the linker keeps only one copy. If this copy is compiled for
// AVX-512, it crashes on processors without AVX-512.
void expect_no_shared_functions(const std::string& library, const std::string& kernels) {
  int n_own = 0;
  bool of_wide_kernels = false;
  for (const std::string& line : symbols(library, "--defined-only")) {
    if (line.ends_with(".o:")) of_wide_kernels = line.starts_with(kernels + "_avx");
    if (!of_wide_kernels || line.size() < 20) continue;
    const char kind = line[17];  // the columns of nm are: address, space, type, space, name
    if (kind != 'W' && kind != 'V' && kind != 'u') continue;
    EXPECT_TRUE(line.find("4Avx2E") != std::string::npos || line.find("6Avx512E") != std::string::npos) << line;
    ++n_own;
  }
  EXPECT_GT(n_own, 0);
}

TEST(Kernels, ShareNoInlineFunctionWithCodeForOtherProcessors) {
  expect_no_shared_functions(relaxation_library(), "step_kernels");
  expect_no_shared_functions(rigid_library(), "sweep_kernels");
}

// Pair kernels make up most of the code of the force loop and take most of its compile time.
TEST(PairKernels, AreFewAndOfCompositionsThatRun) {
  int n_kernels = 0;
  for (const std::string& line : symbols(relaxation_library(), "--defined-only --demangle")) {
    const auto holds = [&](const char* word) { return line.find(word) != std::string::npos; };
    if (!holds("floc::PairKernel<") || !holds("::compute(")) continue;
    ++n_kernels;
    EXPECT_FALSE(holds("floc::Walls") && holds("CapillaryAdhesion")) << line;
    EXPECT_FALSE(holds(", 2, ") && holds("TwistingSpring")) << line;
  }
  EXPECT_GT(n_kernels, 0);
  EXPECT_LE(n_kernels, 200);
}

}  // namespace
}  // namespace floc::test
