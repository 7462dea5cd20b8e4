#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/seconds_since.h"
#include "floc/tables/consolidation_fits.h"
#include "process/child_process.h"
#include "process/command.h"
#include "process/output.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a file or directory that is installed with floc. Relative to the directory of the program, this
/// path is ../share/floc/NAME.
/// @throws InputError if this file or directory does not exist
std::string shipped(const std::string& name) {
  const fs::path path = (fs::path(this_program()).parent_path() / "../share/floc" / name).lexically_normal();
  if (!fs::exists(path))
    throw InputError(path.string(),
                     "this file or directory does not exist, but floc demo needs it; it is installed with "
                     "floc: install floc again");
  return path.string();
}

/// Prints a command line of floc on stderr and runs it.
/// @param about  purpose of the command, printed above the command line
/// @param shown  whether the output of the command is printed
/// @return exit code of the command
int step(const std::string& about, const std::vector<std::string>& arguments, bool shown) {
  fmt::print(stderr, "\n== {}\n   floc {}\n", about, fmt::join(arguments, " "));
  return run_floc(arguments, {"", shown ? "" : "/dev/null", "", false});
}

/// Prints the parameters of the consolidation law from two fits. One is the fit to the sample of this demonstration; a
/// parameter that this sample does not determine is left empty. The other is the fit to the mean of six larger samples,
/// whose tables are installed with floc.
void print_laws(const std::string& directory, const std::string& tables) {
  fmt::print(
      stderr,
      "\n== Parameters of the consolidation law, fitted to the mean of six samples of 5600 disks, and to "
      "this sample\n   floc fit consolidation {}\n   floc fit consolidation {}\n",
      tables, directory);
  const ConsolidationFit six = consolidation_fit({tables}), one = consolidation_fit({directory});
  Table table{{"parameter", "six samples", "stderr", "this sample"}, {}};
  for (const FittedParameter& p : six.parameters) {
    TableValue own;
    for (const FittedParameter& q : one.parameters)
      if (q.name == p.name && q.value) own = *q.value;
    table.rows.push_back({p.name, p.value ? TableValue(*p.value) : TableValue(),
                          p.standard_error ? TableValue(*p.standard_error) : TableValue(), own});
  }
  write_table(std::cout, table, TableFormat::table);
  for (const FittedParameter& p : six.parameters)
    if (p.name == "lambda" && p.value && p.standard_error)
      fmt::print(
          "A single sample of 400 disks collapses in jumps, at pressures that differ between samples; the mean "
          "of six samples of 5600 disks has lambda = {:.3f} +- {:.3f}\n",
          *p.value, *p.standard_error);
  std::fflush(stdout);
}

int run_demo(const std::string& directory) {
  // The directory `tables` is used only after the run, but shipped() looks for this directory now: if it is missing,
  // the demonstration fails before the run and not after it.
  const std::string scene = shipped("scenes/demo.toml"), tables = shipped("tables/consolidation");
  const auto began = std::chrono::steady_clock::now();
  const std::string picture = directory + "/forces.svg", page = directory + "/report.html";
  pass_signals_on();
  int code = step("400 disks stick together and are consolidated: 40 equilibrium states, in about ten seconds",
                  {"run", scene, "-o", directory, "--resume"}, false);
  if (code == kDone)
    code = step(
        "Bulk modulus B and shear modulus G in units of F0/a (F0: pull-off force, a: diameter), and bounds of "
        "B, which are valid in rows where bounds_hold is "
        "true",
        {"moduli", directory, "--columns", "P_star,phi,z,B_reuss,B_S,B,B_voigt,G,G_voigt,bounds_hold",
         "--format", "table"},
        true);
  if (code == kDone) {
    print_laws(directory, tables);
    code = step("Pictures of the contact forces in three states",
                {"draw", directory, "-o", picture, "--steps", "1,14,26", "--columns", "3"}, false);
  }
  if (code == kDone)
    code = step("A report of the whole run on one page", {"report", directory, "-o", page}, false);
  // A signal may end a child with the exit code 143 (128 plus the number of SIGTERM), but a child that has just
  // finished its work returns kDone. The demonstration was interrupted in both cases, so the exit code of the child
  // does not matter.
  if (was_signalled()) return kInterrupted;
  if (code == kDone)
    fmt::print(stderr,
               "\n== Done in {:.0f} s\n   states and tables   {}/\n   picture             {}\n   report        "
               "      {} (open it in a browser)\n   next command        floc scene new powder\n",
               seconds_since(began), directory, picture, page);
  return code;
}

}  // namespace

Command add_demo(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "demo",
      "Run a demonstration: a powder of 400 disks, its elastic moduli, its consolidation law, and pictures");
  auto directory = std::make_shared<std::string>("demo");
  app.add_option("DIR", *directory,
                 "directory for the state files, tables and pictures; an interrupted demonstration is "
                 "continued there [demo]");
  return {app, [directory] { return run_demo(*directory); }};
}

}  // namespace floc
