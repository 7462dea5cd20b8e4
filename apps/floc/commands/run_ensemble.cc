#include "commands/run_ensemble.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>

#include "commands/next_steps.h"
#include "floc/base/error.h"
#include "process/child_process.h"
#include "process/command.h"
#include "process/output.h"

namespace floc {
namespace {

/// Pause (microseconds) between two checks whether any of the running samples has ended. The pause is short compared
/// with the run of a sample, which takes at least seconds.
constexpr useconds_t kPause = 20000;

class Ensemble {
 public:
  Ensemble(std::string directory, const std::vector<std::string>& arguments, bool append)
      : directory_(std::move(directory)), arguments_(arguments), append_(append) {}

  int n_running() const { return static_cast<int>(seed_of_.size()); }
  int code() const { return code_; }

  void start(std::uint64_t seed) {
    const std::string sample = fmt::format("{}/seed-{}", directory_, seed);
    std::vector<std::string> args = {"run"};
    args.insert(args.end(), arguments_.begin(), arguments_.end());
    args.insert(args.end(), {"-o", sample, "--seed", std::to_string(seed)});
    seed_of_[start_floc(args, {"", "", sample + ".log", append_})] = seed;
  }

  /// Waits until one of the running samples has ended. A signal that arrives in the meantime is passed on to all
  /// samples.
  void wait() {
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(-1, &status, WNOHANG)) == 0) {
      if (was_signalled() && !signal_passed_on_) pass_signal_on();
      ::usleep(kPause);
    }
    const auto found = seed_of_.find(ended);
    if (found == seed_of_.end())
      throw IoError(directory_, "the processes that run the samples of this ensemble can no longer be found");
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : int{kFailure};
    fmt::print(stderr, "seed {}: {}\n", found->second,
               code == kDone ? "done"
                             : fmt::format("failed with exit code {}; its messages are in {}/seed-{}.log", code,
                                           directory_, found->second));
    code_ = worse(code_, code);
    seed_of_.erase(found);
  }

 private:
  void pass_signal_on() {
    for (const auto& [child, seed] : seed_of_) ::kill(child, SIGTERM);
    signal_passed_on_ = true;
  }

  std::string directory_;
  std::vector<std::string> arguments_;
  bool append_;
  std::map<pid_t, std::uint64_t> seed_of_;
  bool signal_passed_on_ = false;
  int code_ = kDone;
};

}  // namespace

SeedRange parse_seeds(const std::string& text) {
  constexpr std::uint64_t kMostSeeds = 1'000'000;
  const auto range = seed_range_of(text);
  if (range && range->last - range->first < kMostSeeds) return *range;
  throw InputError(
      "--seeds " + text,
      fmt::format(
          "this is not a range of seeds: expected A..B with two whole numbers, A <= B, and at most {} seeds",
          kMostSeeds));
}

int run_ensemble(const ClaimedDirectory& claim, const std::string& directory, const SeedRange& seeds, int jobs,
                 const std::vector<std::string>& arguments, bool append) {
  pass_signals_on();
  Ensemble ensemble(directory, arguments, append);
  const auto goes_on = [&claim] { return !was_signalled() && claim.is_held(); };
  for (std::uint64_t n = 0; n <= seeds.last - seeds.first && goes_on(); ++n) {
    while (ensemble.n_running() == jobs) ensemble.wait();
    if (goes_on()) ensemble.start(seeds.first + n);
  }
  while (ensemble.n_running() > 0) ensemble.wait();
  if (was_signalled()) return kInterrupted;
  claim.require_held();
  fmt::print(stderr, "The {} samples are in the directory {}.{}", seeds.last - seeds.first + 1, directory,
             ensemble.code() == kDone ? " You may run next:\n" + next_steps(directory, "seed-*/state-*.h5")
                                      : " Some of the samples have failed.\n");
  return ensemble.code();
}

}  // namespace floc
