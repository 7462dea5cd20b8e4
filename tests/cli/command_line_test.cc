#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

struct Misspelt {
  const char* arguments;
  const char* message;
};

TEST(CommandLine, UnknownNamesGetTheNearestThereIs) {
  const Misspelt lines[] = {
      {"modli x.h5", "floc has no command modli; the nearest is moduli"},
      {"modli demo", "floc has no command modli; the nearest is moduli"},
      {"help modli", "floc has no command modli; the nearest is moduli"},
      {"fit consolidatoin demo", "floc fit has no command consolidatoin; the nearest is consolidation"},
      {"scene chek x.toml", "floc scene has no command chek; the nearest is check"},
      {"moduli --prestres x.h5", "floc moduli has no option --prestres; the nearest is --prestress"},
      {"moduli --tolerence=1e-3 x.h5", "floc moduli has no option --tolerence; the nearest is --tolerance"},
      {"run x.toml -o y --resum", "floc run has no option --resum; the nearest is --resume"},
      {"fit elastic x.csv --frmat csv", "floc fit elastic has no option --frmat; the nearest is --format"},
      {"--versoin", "floc has no option --versoin; the nearest is --version"},
  };
  for (const Misspelt& line : lines) {
    const Outcome o = run_floc(line.arguments);
    EXPECT_EQ(o.code, 2) << line.arguments;
    EXPECT_THAT(o.err, HasSubstr(line.message)) << line.arguments;
    EXPECT_EQ(o.out, "") << line.arguments;
  }
}

TEST(CommandLine, OtherFaultsKeepTheirWords) {
  EXPECT_THAT(run_floc("moduli").err, HasSubstr("STATE is required"));
  EXPECT_THAT(run_floc("moduli x.h5 --strains half").err, HasSubstr("--strains"));
  EXPECT_THAT(run_floc("structure x.h5 --reach 0").err,
              HasSubstr("--reach: expected a positive number, not 0"));
  EXPECT_EQ(run_floc("moduli --help").code, 0);
  EXPECT_EQ(run_floc("--help").code, 0);
  EXPECT_EQ(run_floc("--version").code, 0);
}

TEST(CommandLine, MissingEmptyAndDirectoryInputsAreToldApart) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.file("d"));
  for (const char* name : {"e.toml", "e.h5", "e.csv"}) write_text(scratch.file(name), "");
  const Misspelt lines[] = {
      {"scene check n.toml", "n.toml: there is no such file; expected a scene file (TOML)"},
      {"scene check e.toml", "e.toml: this file is empty; expected a scene file (TOML)"},
      {"scene check d", "d: this is a directory; expected a scene file (TOML)"},
      {"run e.toml -o r", "e.toml: this file is empty; expected a scene file (TOML)"},
      {"moduli n.h5", "n.h5: No such file or directory"},
      {"moduli e.h5", "e.h5: the file is empty, expected a floc state"},
      {"moduli d",
       "d: this directory holds no state-0000.h5: expected state files or a directory that floc run wrote"},
      {"info d", "d: this directory holds no state-0000.h5"},
      {"fit elastic n.csv", "n.csv: No such file or directory"},
      {"fit elastic e.csv", "e.csv: the file is empty, expected a table"},
      {"fit elastic d", "d: this directory contains neither path.csv nor seed-N/path.csv"},
      {"plot e.csv -o p.svg", "e.csv: the file is empty, expected a table"},
      {"convert d s.h5", "d: this is a directory, but a file is expected"},
  };
  for (const Misspelt& line : lines) {
    const Outcome o = run_floc(line.arguments, scratch.path());
    EXPECT_EQ(o.code, 4) << line.arguments;
    EXPECT_THAT(o.err, HasSubstr(line.message)) << line.arguments;
  }
}

}  // namespace
}  // namespace floc::test
