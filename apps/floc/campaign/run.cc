#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <sstream>

#include "campaign/commands.h"
#include "campaign/log_reason.h"
#include "floc/base/error.h"
#include "floc/campaign/campaign_tables.h"
#include "floc/loading/run_options.h"
#include "process/child_process.h"
#include "process/output.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct CampaignRunArguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  int threads = 1;
  std::string directory;
  std::vector<std::string> tables;
  bool with_parent = false;
};

/// A table that is made after a run: the name of its file, and the words of the floc command that prints the table.
struct TableCommand {
  std::string file;
  std::vector<std::string> words;
};

TableCommand table_command(const std::string& text) {
  TableCommand command;
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos || colon == 0 || text.find('/') < colon)
    throw InputError("--table " + text, "expected FILE: COMMAND, such as \"moduli.csv: moduli state-0003.h5\"");
  command.file = text.substr(0, colon);
  std::istringstream words(text.substr(colon + 2));
  for (std::string word; words >> word;) command.words.push_back(word);
  if (command.words.empty())
    throw InputError(
        "--table " + text,
        "the command is missing: expected FILE: COMMAND, such as \"moduli.csv: moduli state-0003.h5\"");
  return command;
}

double children_seconds() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Makes one table in the directory of a run. @return exit code of the floc command that prints the table
int make_table(const TableCommand& command, const CampaignRunArguments& arguments, const std::string& log) {
  const std::string file = arguments.directory + "/" + command.file, part = file + ".part";
  std::vector<std::string> words = command.words;
  words.insert(words.end(), {"--format", "csv"});
  const int code = run_floc(words, {arguments.directory, part, log, true});
  if (code == kDone) fs::rename(part, file);
  return code;
}

/// Runs one sample of a campaign and makes its tables.
/// @return exit code: 0 also if the run failed, because snakemake has to go on with the other runs; outcome.csv records
/// the failure
int run_sample(const CampaignRunArguments& arguments) {
  // With the option --with-parent, this process is killed when the snakemake that started it ends. Otherwise the next
  // snakemake would start a second process in the same run directory.
  if (arguments.with_parent) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::vector<TableCommand> tables;
  for (const std::string& text : arguments.tables) tables.push_back(table_command(text));
  std::error_code failed;
  fs::create_directories(arguments.directory, failed);
  if (failed) throw IoError(arguments.directory, "this directory cannot be made: " + failed.message());
  fs::remove(fs::path(arguments.directory) / kOutcomeFile);
  fs::remove(fs::path(arguments.directory) / kFailureFile);
  pass_signals_on();

  const std::string log = arguments.directory + ".log";
  std::vector<std::string> words = {"run", arguments.scene};
  for (const std::string& change : arguments.overrides) words.insert(words.end(), {"--set", change});
  words.insert(words.end(), {"--seed", std::to_string(arguments.seed), "--threads",
                             std::to_string(arguments.threads), "-o", arguments.directory, "--resume"});
  RunOutcome outcome;
  outcome.exit_code = run_floc(words, {"", "", log, false});
  if (outcome.exit_code != kDone) outcome.command = "run";
  const double before = children_seconds();
  outcome.run_seconds = before;
  for (const TableCommand& table : tables) {
    if (outcome.exit_code != kDone || was_signalled()) break;
    outcome.exit_code = make_table(table, arguments, log);
    if (outcome.exit_code != kDone) outcome.command = table.words.front();
  }
  outcome.seconds = children_seconds() - before;
  if (was_signalled()) return kInterrupted;  // no outcome is written, because the run will be resumed
  if (outcome.exit_code != kDone) outcome.words = reason_of_failure(outcome.exit_code, log);
  write_csv(arguments.directory + "/" + kOutcomeFile, table_of(outcome));
  if (outcome.exit_code != kDone)
    fmt::print(stderr, "{}: floc {} failed with exit code {}: {} (see the log {})\n", arguments.directory,
               outcome.command, outcome.exit_code, outcome.words, log);
  return kDone;
}

}  // namespace

Command add_campaign_run(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand(
      "run",
      "make one run of a campaign, as its Snakefile does: call floc run --resume, make tables of the states, "
      "and write DIR/outcome.csv, which records whether one of these commands failed");
  auto arguments = std::make_shared<CampaignRunArguments>();
  app.add_option("SCENE", arguments->scene, "scene file (TOML)").required();
  app.add_option("-o,--output", arguments->directory, "directory of the run; the log of the run is DIR.log")
      .required();
  app.add_option("--seed", arguments->seed, "seed of the random numbers").required();
  app.add_option("--threads", arguments->threads, "number of threads of the run").within(RunOptions::kThreads);
  app.add_option("--set", arguments->overrides, "KEY=VALUE: change the value of one key of the scene")
      .one_argument_each();
  app.add_option(
         "--table", arguments->tables,
         "\"FILE: COMMAND\": run floc COMMAND in the directory of the run and write its table to FILE, as csv")
      .one_argument_each();
  app.add_flag("--with-parent", arguments->with_parent, "exit at once when the parent process exits");
  return {app, [arguments] { return run_sample(*arguments); }};
}

}  // namespace floc
