#include <fmt/format.h>

#include <chrono>
#include <exception>

#include "arguments.h"
#include "floc/packing/equilibrium.h"
#include "floc/run_directory/scene_run.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_warnings.h"

namespace floc::python {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenSignals{50};

/// Reports the progress of a run to a Python callback, and tells the run when to stop. If the callback raises an
/// exception, the run writes a checkpoint and stops.
class Watch {
 public:
  /// @param told  Python callback that receives reports of progress; None: no reports
  /// @param interval  wall time between two reports inside a step (s)
  Watch(py::object told, double interval) : told_(std::move(told)), interval_(interval) {}

  bool stops() {
    if (thrown_) return true;
    if (const auto now = Clock::now(); now - last_look_ >= kBetweenSignals) {
      last_look_ = now;
      call(check_signals);
    }
    return thrown_ != nullptr;
  }

  template <int Dim>
  void chunk(const Run<Dim>& run) {
    const auto now = Clock::now();
    if (told_.is_none() || std::chrono::duration<double>(now - last_told_).count() < interval_) return;
    last_told_ = now;
    tell(run, run.packing(), run.point().step, run.target().branch, run.pressure(),
         run.point().time + run.point().equilibration_time, false);
  }

  template <int Dim>
  void equilibrium(const Run<Dim>& run, const State<Dim>& state) {
    tell(run, state.packing, state.path.step, state.path.branch, state.target_stress.mean(), state.path.time,
         true);
  }

  /// Throws the exception that the Python callback raised, if there is one.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  template <class Work>
  void call(const Work& work) {
    if (thrown_) return;
    const py::gil_scoped_acquire acquired;
    try {
      work();
    } catch (const py::error_already_set&) {
      thrown_ = std::current_exception();
    }
  }

  template <int Dim>
  void tell(const Run<Dim>& run, const Packing<Dim>& packing, int step, const std::string& branch,
            double pressure, double time, bool equilibrium) {
    if (told_.is_none()) return;
    const double phi = solid_fraction(packing);
    call([&] { told_(step, run.plan().size(), branch, pressure, phi, time, equilibrium); });
  }

  py::object told_;
  double interval_;
  Clock::time_point last_look_ = Clock::now(), last_told_ = Clock::now();
  std::exception_ptr thrown_;
};

/// Runs a scene to its end.
/// @return reason why the run is not complete; empty if the run is complete or was stopped by Python
template <int Dim>
std::string drive_scene(const Scene& scene, const SceneRunOptions& asked, Watch& watch) {
  SceneRun<Dim> scene_run(scene, asked);
  DriveOptions<Dim> options;
  options.stop = [&watch] { return watch.stops(); };
  options.chunk = [&watch](const Run<Dim>& run) { watch.chunk(run); };
  options.equilibrium = [&](const State<Dim>& state, const RelaxationReport&, double) {
    watch.equilibrium(scene_run.run, state);
  };
  const DriveReport report = scene_run.drive(options);
  return report.outcome == DriveReport::gave_up ? ending_of(report, scene_run.run) : "";
}

[[noreturn]] void refuse_pair(const char* argument, const char* other) {
  throw InputError(
      argument,
      fmt::format("this argument cannot be combined with the argument {}: expected only one of them", other));
}

void run(const std::string& scene_file, const std::string& directory, const std::vector<std::string>& changes,
         const std::string& prices, const py::object& seed, const py::object& threads, const py::object& until,
         const py::object& track_contacts, const py::object& track_energy, const py::object& resume,
         const py::object& overwrite, const py::object& timing, const py::object& told,
         const py::object& interval) {
  SceneRunOptions asked;
  asked.directory = directory;
  if (!seed.is_none()) asked.seed = seed_of("seed", seed);
  asked.threads = whole_if_any("threads", threads, RunOptions::kThreads);
  asked.until = whole_if_any("until", until, DriveOptions<2>::kUntil);
  asked.track_contacts = number_if_any("track_contacts", track_contacts, kPositiveNumber);
  asked.track_energy = flag_of("track_energy", track_energy);
  asked.resume = flag_of("resume", resume);
  asked.overwrite = flag_of("overwrite", overwrite);
  asked.no_timing = !flag_of("timing", timing);
  if (asked.resume && asked.overwrite) refuse_pair("resume", "overwrite");
  if (asked.track_energy && asked.track_contacts) refuse_pair("track_energy", "track_contacts");
  Watch watch(told, number_of("interval", interval, kNotNegativeNumber));
  const Scene scene = read_scene(scene_file, changes, prices);
  Warnings warnings;
  for (const std::string& words : scene_warnings(scene))
    warnings.push_back(fmt::format("{}: {}", scene_file, words));
  if (const std::string words = unused_threads(scene, asked); !words.empty())
    warnings.push_back(fmt::format("{}: {}", scene_file, words));
  issue(warnings);
  const std::string ending = without_gil([&] {
    return scene.dimension == 3 ? drive_scene<3>(scene, asked, watch) : drive_scene<2>(scene, asked, watch);
  });
  watch.rethrow();
  if (!ending.empty()) throw NumericalError(directory + ": " + ending);
}

}  // namespace

void bind_run(py::module_& module) {
  module.def("run", &run, py::arg("scene"), py::arg("directory"), py::kw_only(), py::arg("changes"),
             py::arg("prices"), py::arg("seed"), py::arg("threads"), py::arg("until"),
             py::arg("track_contacts"), py::arg("track_energy"), py::arg("resume"), py::arg("overwrite"),
             py::arg("timing"), py::arg("told"), py::arg("interval"));
}

}  // namespace floc::python
