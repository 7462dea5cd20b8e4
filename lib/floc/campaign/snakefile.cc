#include "floc/campaign/snakefile.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/shell_word.h"
#include "floc/base/string_literal.h"

namespace floc {
namespace {

/// Returns a text as a Python string literal that can be a shell command in a Snakefile. Braces are doubled, because
/// snakemake replaces words in single braces.
std::string command_quoted(const std::string& text) {
  std::string doubled;
  for (const char c : text) {
    if (c == '{' || c == '}') doubled += c;
    doubled += c;
  }
  return string_literal(doubled);
}

constexpr const char* kHead =
    R"(# Runs of the campaign {}, written by floc campaign plan. Run that command again if the campaign changes.
#
#   snakemake --cores 4      makes the tables and index.html; after an interruption, continues the runs
#   snakemake --unlock       is needed after snakemake itself was killed; then run snakemake --rerun-incomplete

FLOC = config.get("floc", {})
OUTCOMES = [
{}]

localrules: all, page, table_runs, table_means, table_fits, table_outcomes

# Lists the runs and the fits that failed. If there are any, this rule fails. The next call of snakemake repeats the
# runs that failed; snakemake --forcerun table_fits repeats the fits.
rule all:
    input: "index.html", OUTCOMES
    output: "complete"
    shell: "{{FLOC}} campaign outcome . --forget > {{output}}"

rule page:
    input: "runs.csv", "means.csv", "fits.csv", "outcomes.csv"
    output: "index.html"
    shell: "{{FLOC}} campaign page . -o {{output}}"

rule table_runs:
    input: "campaign.toml", "scene.toml", OUTCOMES
    output: "runs.csv"
    shell: "{{FLOC}} campaign collect . --table runs --format csv > {{output}}"

rule table_means:
    input: "campaign.toml", "scene.toml", "runs.csv"
    output: "means.csv"
    shell: "{{FLOC}} campaign collect . --table means --format csv > {{output}}"

rule table_fits:
    input: "campaign.toml", "scene.toml", OUTCOMES
    output: "fits.csv"
    shell: "{{FLOC}} campaign collect . --table fits --keep-going --format csv > {{output}}"

rule table_outcomes:
    input: "campaign.toml", "scene.toml", OUTCOMES
    output: "outcomes.csv"
    shell: "{{FLOC}} campaign collect . --table outcomes --format csv > {{output}}"
)";

/// Returns the floc command, without the word floc, that prints the table of a collection for one run. The command has
/// to be called in the directory of this run.
std::string command_of(const Collection& collection, const CampaignCase& one, const CasePlan& plan) {
  const auto file = [](int step) { return fmt::format(" state-{:04}.h5", step); };
  std::string command = collection.table;
  if (collection.table == "compare") command += file(chosen_states(collection.before, one, plan).front());
  for (const int step : chosen_states(collection.states, one, plan)) command += file(step);
  for (const std::string& option : collection.options) command += " " + option;
  return command;
}

/// For a collection, returns the values of the option `--table` of `floc campaign run`. A value consists of the name of
/// a file and the floc command that prints the table in this file, such as "1-moduli.csv: moduli state-0003.h5". For
/// the table "compare" there is one value per state, because one call of floc compare compares only two states.
std::vector<std::string> commands_of(const Campaign& campaign, int number, const CampaignCase& one,
                                     const CasePlan& plan) {
  Collection collection = campaign.collections[static_cast<std::size_t>(number)];
  if (collection.table == "path") return {};
  const std::string file = collected_file(campaign, number);
  if (collection.table != "compare") return {file + ": " + command_of(collection, one, plan)};
  std::vector<std::string> commands;
  for (const int step : chosen_states(collection.states, one, plan)) {
    collection.states.kind = StateChoice::steps;
    collection.states.numbers = {step};
    commands.push_back(fmt::format("{:04}-{}: {}", step, file, command_of(collection, one, plan)));
  }
  return commands;
}

std::string run_rule(const Campaign& campaign, const CampaignRun& run, int number, const CasePlan& plan) {
  const CampaignCase& one = campaign.cases[static_cast<std::size_t>(run.case_number)];
  std::string rule =
      fmt::format(R"(
rule run_{}:
    input: "scene.toml"
    output: {}
    threads: {}
    shell:
        "exec {{FLOC}} campaign run scene.toml --with-parent --seed {} --threads {{threads}}"
)",
                  number, string_literal(run.directory + "/outcome.csv"), plan.threads, run.seed);
  const auto add = [&rule](const std::string& option, const std::string& value) {
    rule += "        " + command_quoted(" " + option + " " + shell_quoted(value)) + "\n";
  };
  for (const SceneChange& change : one.changes) add("--set", change.text());
  add("-o", run.directory);
  for (int k = 0; k < static_cast<int>(campaign.collections.size()); ++k)
    for (const std::string& command : commands_of(campaign, k, one, plan)) add("--table", command);
  return rule;
}

}  // namespace

std::string collected_file(const Campaign& campaign, int number) {
  return fmt::format("{}-{}.csv", number + 1, campaign.collections[static_cast<std::size_t>(number)].table);
}

std::string snakefile_of(const Campaign& campaign, const std::vector<CasePlan>& plans,
                         const std::string& program) {
  const std::vector<CampaignRun> runs = runs_of(campaign);
  std::string outcomes, rules;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    outcomes += "    " + string_literal(runs[k].directory + "/outcome.csv") + ",\n";
    rules += run_rule(campaign, runs[k], static_cast<int>(k) + 1,
                      plans[static_cast<std::size_t>(runs[k].case_number)]);
  }
  std::string name = campaign.name;
  std::replace(name.begin(), name.end(), '\n', ' ');
  return fmt::format(fmt::runtime(kHead), name, string_literal(shell_quoted(program)), outcomes) + rules;
}

}  // namespace floc
