#include "commands/run_monitor.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "floc/packing/equilibrium.h"
#include "floc/packing/overlaps.h"
#include "process/output.h"

namespace floc {
namespace {

constexpr double kSecondsBetweenRedraws = 0.5;
constexpr double kSecondsBetweenLines = 10.0;

template <int Dim>
std::string phase_of(const Run<Dim>& run) {
  if (run.point().aggregating)
    return fmt::format("the grains aggregate until they form one cluster; there are now {} clusters",
                       run.n_clusters());
  const RelaxationReport report = run.report();
  const bool finishing = report.phase == "finishing";
  // Steps from rest do not advance the simulated time, so their number shows that the relaxation continues.
  const std::string resting =
      report.n_resting_steps > 0 ? fmt::format(" after {} steps from rest", report.n_resting_steps) : "";
  std::string text = fmt::format("{}{}, {}", report.phase, resting, report.blocking);
  if (finishing && report.decay_rate > 0.0)
    text += fmt::format(", the force residual decays at a rate of {:.2g} per unit of time", report.decay_rate);
  return text;
}

/// Returns a keyword for the end of a relaxation. If mechanisms of a packing between walls prevent an equilibrium, the
/// number of mechanisms is added.
std::string ending_of(const RelaxationReport& report) {
  if (report.n_mechanisms <= 0) return report.ending;
  return fmt::format("{}, not in equilibrium because of {} mechanisms", report.ending, report.n_mechanisms);
}

/// Returns a simulated time as text with a suitable number of digits. The times are about 1e-4 s in SI units, and up to
/// thousands of units of time in reduced units.
std::string time_text(double time) {
  return time < 100.0 ? fmt::format("{:.3g}", time) : fmt::format("{:.0f}", time);
}

}  // namespace

RunMonitor::RunMonitor(int n_steps)
    : n_steps_(n_steps), terminal_(isatty(STDERR_FILENO) == 1), last_line_(Clock::now()) {}

/// Returns the expected wall time of the remaining steps (s): their number times the mean time of the completed steps.
/// Steps in which the packing collapses take longer, but collapses cannot be predicted.
double RunMonitor::expected_seconds_left(int steps_left) const {
  return seconds_done_ / steps_done_ * steps_left;
}

template <int Dim>
void RunMonitor::chunk(const Run<Dim>& run) {
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_line_).count();
  if (since < (terminal_ ? kSecondsBetweenRedraws : kSecondsBetweenLines)) return;
  last_line_ = now;
  const int step = run.point().step;
  std::string line =
      fmt::format("step {}/{} (branch {}, {}): solid fraction {:.4f}, simulated time {}, {}", step + 1,
                  n_steps_, run.target().branch, run.pressure_text(), solid_fraction(run.packing()),
                  time_text(run.point().time + run.point().equilibration_time), phase_of(run));
  if (steps_done_ > 0)
    line += fmt::format("; about {} of wall time left", duration_text(expected_seconds_left(n_steps_ - step)));
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

namespace {

/// Returns a warning if there are many time steps of contact dynamics in which the impulses did not converge to the
/// tolerance; otherwise returns an empty text.
std::string unfinished_warning(const RelaxationReport& report) {
  constexpr double kMany = 0.05;
  const StepCounts& counts = report.counts;
  const double share = counts.n_steps == 0
                           ? 0.0
                           : static_cast<double>(counts.n_unfinished) / static_cast<double>(counts.n_steps);
  if (share <= kMany) return {};
  return fmt::format(
      "in {:.0f} % of the time steps, the impulses were not yet within dynamics.sweep_tolerance after "
      "dynamics.max_sweeps sweeps: {} less accurate than required; give a larger dynamics.max_sweeps or "
      "a larger tolerance",
      100.0 * share,
      report.motion ? "the motion and the forces of this state, which is in motion, are"
                    : "the final forces are balanced, but the motion up to them is");
}

}  // namespace

template <int Dim>
void RunMonitor::equilibrium(const State<Dim>& state, const RelaxationReport& report, double seconds) {
  // The assembly takes longer than a step of the load path, so it is left out of the mean time of a step.
  if (state.path.branch != "assembly") {
    ++steps_done_;
    seconds_done_ += seconds;
  }
  fmt::print(stderr,
             "{}step {}/{} (branch {}, {}): solid fraction {:.5f}, {} contacts, force residual {:.1e} "
             "(ending: {}), {:.1f} s of wall time\n",
             terminal_ ? "\r\033[K" : "", state.path.step + 1, n_steps_, state.path.branch,
             imposed_pressure_text(state), solid_fraction(state.packing), state.packing.contacts.size(),
             state.residuals.force, ending_of(report), seconds);
  if (const std::string warning = overlap_warning(state.packing); !warning.empty())
    fmt::print(stderr, "  warning: {}\n", warning);
  if (const std::string warning = unfinished_warning(report); !warning.empty())
    fmt::print(stderr, "  warning: {}\n", warning);
  if (!report.stability.note.empty()) fmt::print(stderr, "  test of stability: {}\n", report.stability.note);
}

#define FLOC_INSTANTIATE(Dim)                                                                    \
  template void RunMonitor::chunk(const Run<Dim>& run);                                          \
  template void RunMonitor::equilibrium(const State<Dim>& state, const RelaxationReport& report, \
                                        double seconds);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
