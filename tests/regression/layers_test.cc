#include "support/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "support/places.h"

namespace floc::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::filesystem::path kLibrary = std::filesystem::path(test::source_directory()) / "lib" / "floc";

TEST(Layers, NoSourceIncludesWhatTheOrderForbids) {
  EXPECT_THAT(layer_faults(kLibrary), IsEmpty());
}

TEST(Layers, TheLibraryIsReallyRead) {
  int n_files = 0, n_includes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kLibrary)) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const Include& include : includes_of(text)) n_includes += include.name.starts_with("floc/");
    ++n_files;
  }
  EXPECT_GT(n_files, 30);
  EXPECT_GT(n_includes, n_files);
}

TEST(Layers, TheOrderHasNoCycle) {
  for (const auto& [folder, below] : layer_order())
    for (const std::string& other : below)
      EXPECT_FALSE(reachable(layer_order(), other).contains(folder)) << folder << " and " << other;
}

TEST(Library, NeverPrints) {
  const std::regex printing(R"re(std::(cout|cerr|clog|puts|printf|perror)\b|\bf?printf *\(|fmt::print)re");
  ASSERT_TRUE(std::regex_search("  std::cerr << 1;", printing));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kLibrary)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_FALSE(std::regex_search(text, printing)) << entry.path();
  }
}

/// Only run_in_team() may start threads. It passes exceptions to its caller; otherwise an exception that leaves a
/// thread or a parallel region of OpenMP would end the program.
TEST(Library, StartsThreadsInATeamAlone) {
  const std::regex starting(
      R"re(#\s*pragma\s+omp\b|_Pragma|std::(jthread|async)\b|std::thread\b(?!::)|pthread_create)re");
  for (const char* text :
       {"#pragma omp parallel for", "# pragma omp task", "std::thread t(f);", "std::async(f)"})
    ASSERT_TRUE(std::regex_search(text, starting)) << text;
  int n_files = 0;
  std::vector<std::string> found;
  for (const char* folder : {"lib", "apps"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(test::source_directory()) / folder)) {
      if (entry.path().extension() != ".cc" && entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      if (std::regex_search(text, starting)) found.push_back(entry.path().filename().string());
      ++n_files;
    }
  EXPECT_THAT(found, ElementsAre("thread_team.cc"));
  EXPECT_GT(n_files, 500);
  std::cout << "sources: " << n_files << "\n";
}

TEST(Layers, EveryFolderHasItsPlace) {
  for (const auto& entry : std::filesystem::directory_iterator(kLibrary))
    if (entry.is_directory()) {
      EXPECT_TRUE(layer_order().contains(entry.path().filename().string())) << entry.path();
    }
}

/// The Python package uses only the library, and no code of the program. Code that both need belongs to the library.
TEST(Layers, ThePythonPackageIncludesNoHeaderOfTheProgram) {
  const std::filesystem::path apps = std::filesystem::path(test::source_directory()) / "apps";
  int n_includes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(apps / "python")) {
    if (entry.path().extension() != ".cc" && entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const Include& include : includes_of(text)) {
      if (!include.quoted) continue;
      ++n_includes;
      EXPECT_TRUE(include.name.starts_with("floc/") || std::filesystem::exists(apps / "python" / include.name))
          << entry.path() << " includes " << include.name;
    }
  }
  EXPECT_GT(n_includes, 30);
}

TEST(Layers, WhatALayerUsesMayBeUsedThroughIt) {
  EXPECT_FALSE(fault_of("loading", {"floc/contact/contact_law.h", true}));
  EXPECT_FALSE(fault_of("elasticity", {"floc/linalg/symmetric_factor.h", true}));
}

TEST(Layers, AForbiddenIncludeIsRejected) {
  EXPECT_TRUE(fault_of("contact", {"floc/packing/packing.h", true}));
  EXPECT_TRUE(fault_of("network", {"floc/relaxation/relaxation_options.h", true}));
  EXPECT_TRUE(fault_of("loading", {"floc/io/state_file.h", true}));
  EXPECT_TRUE(fault_of("structure", {"floc/elasticity/moduli.h", true}));
  EXPECT_TRUE(fault_of("packing", {"floc/nowhere/thing.h", true}));
  EXPECT_TRUE(fault_of("nowhere", {"vector", false}));
}

TEST(Layers, AForeignLibraryHasOneOwner) {
  EXPECT_FALSE(fault_of("linalg", {"cholmod.h", false}));
  EXPECT_TRUE(fault_of("network", {"cholmod.h", false}));
  EXPECT_TRUE(fault_of("relaxation", {"suitesparse/umfpack.h", false}));
  EXPECT_TRUE(fault_of("contact", {"ceres/jet.h", false}));
  EXPECT_TRUE(fault_of("packing", {"hdf5.h", false}));
  EXPECT_TRUE(fault_of("loading", {"toml++/toml.h", false}));
  EXPECT_TRUE(fault_of("base", {"CLI/CLI.hpp", false}));
  EXPECT_FALSE(fault_of("run_directory", {"nlohmann/json.hpp", false}));
  EXPECT_EQ(fault_of("loading", {"nlohmann/json.hpp", false}),
            "loading may not include <nlohmann/json.hpp>, only io and relaxation and run_directory and tables");
  EXPECT_FALSE(fault_of("io", {"vector", false}));
}

TEST(Layers, AForbiddenIncludeInATreeIsFoundAndNamed) {
  const std::filesystem::path root =
      std::filesystem::temp_directory_path() / ("floc_layers_" + std::to_string(::getpid()));
  std::filesystem::create_directories(root / "contact" / "normal");
  std::ofstream(root / "contact" / "normal" / "bad.h")
      << "#pragma once\n"
         "// #include \"floc/io/table.h\" in a comment is none\n"
         "#include <vector>\n"
         "  #  include \"floc/packing/packing.h\"\n"
         "#include \"floc/base/vec.h\"\n"
         "#include \"bad.h\"\n"
         "#include \"generated.h\"\n";
  const std::vector<std::string> faults = layer_faults(root);
  std::filesystem::remove_all(root);
  EXPECT_THAT(faults, ElementsAre("contact/normal/bad.h: \"bad.h\" is to be included as \"floc/...\"",
                                  "contact/normal/bad.h: contact may not include floc/packing/packing.h"));
}

}  // namespace
}  // namespace floc::test
