#include "floc/tradeoff/tradeoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <variant>

#include "floc/base/error.h"
#include "floc/scene/derived_groups.h"
#include "floc/tradeoff/path_fits.h"
#include "floc/tradeoff/peak_memory.h"

namespace floc {
namespace {

/// Numbers of disks and of spheres in the small sample whose run measures the speed of this machine. These numbers are
/// also the smallest numbers of grains in the samples of a study.
constexpr int kMinDisks = 40;
constexpr int kMinSpheres = 100;
/// The number of grains is reduced until this number of samples fits into the budget with every setting. The error of a
/// mean can only be estimated from two or more samples.
constexpr double kSamplesWanted = 2.0;
/// Processor time of a run with the strictest settings, divided by the processor time of a run with the settings of the
/// scene. This value is assumed until the ratio has been measured. With the strictest settings, time steps are shorter,
/// and more time passes before a packing counts as at rest.
constexpr double kReferenceCost = 4.0;
/// Largest fraction of the processor time of the study that may be spent on runs. The rest is left for comparisons and
/// fits.
constexpr double kShareOfRuns = 0.97;
/// A run is stopped, and its setting left out of the study, if its processor time exceeds this number times the
/// processor time with the strictest settings.
constexpr double kLongestRun = 1.5;
/// Safety factor by which the expected processor time of a run is multiplied before it is compared with the remaining
/// budget.
constexpr double kMargin = 1.3;

class Study {
 public:
  Study(Scene scene, const TradeoffOptions& options)
      : scene_(std::move(scene)),
        options_(options),
        deadline_(kShareOfRuns * options.budget),
        max_samples_(number_of_samples(scene_, options, left_out_)) {
    list_settings();
  }

  Tradeoff run() {
    fit_size_to_budget();
    list_settings();
    samples_.resize(settings_.size());
    for (int k = 0; k < max_samples_ && next_sample_fits(k); ++k) run_seed(k);
    Tradeoff out;
    out.n_grains = scene_.grains.count;
    measure(out);
    out.left_out = left_out_;
    return out;
  }

 private:
  struct Sample {
    int index;
    SamplePath path;
    // Observables of the states of the reference path, with moduli computed by this setting. Used only if the setting
    // changes nothing but the computation of the moduli; otherwise empty.
    std::vector<Observation> levels;
    // Processor time of the run (s) without the moduli. The time of the moduli with this setting is added to it. Used
    // only if the setting changes nothing but the computation of the moduli.
    double base_seconds = 0.0;
  };

  /// Lists the settings that are compared, for the present number of grains.
  void list_settings() {
    settings_ = studied_settings(scene_);
    keep_parameters(options_.parameters, settings_);
  }

  /// Returns the expected ratio of the processor time of a sample with a setting to that of a sample with the settings
  /// of the scene.
  double relative_cost(const StudiedSetting& s) const {
    const double steps = time_step_of(scene_, settings_[1]) / time_step_of(scene_, s);
    const double size = s.n_grains > 0 ? static_cast<double>(s.n_grains) / scene_.grains.count : 1.0;
    return steps * size * s.steps_factor;
  }

  /// Returns the expected processor time (s) of making one sample with every setting.
  /// @param n_grains  number of grains of the sample
  /// @param speed  ratio of the processor time measured on this machine to the time that expected_cost() predicts
  double sample_cost(int n_grains, double speed) const {
    Scene sized = scene_;
    sized.grains.count = n_grains;
    double units = kReferenceCost;
    for (const StudiedSetting& s : settings_)
      if (!s.is_reference() && !s.is_moduli_level()) units += relative_cost(s);
    return units * expected_cost(sized) * speed;
  }

  int least_grains() const { return scene_.dimension == 2 ? kMinDisks : kMinSpheres; }

  /// Makes a sample. If this fails, for example because the cell would be too small, the member `failure` of the result
  /// gives the reason.
  static SamplePath tried_sample(const RunOptions& options, const ModuliOptions& moduli,
                                 const SamplePath* reference, const Deadline& deadline) {
    try {
      return make_sample(options, moduli, reference, deadline);
    } catch (const InputError& reason) {
      SamplePath path;
      path.failure = reason.what();
      return path;
    }
  }

  /// Runs a small sample to measure the speed of this machine. Then reduces the number of grains until the study fits
  /// into its budget.
  void fit_size_to_budget() {
    Scene small = scene_;
    if (has_any_number_of_grains(scene_)) small.grains.count = std::min(scene_.grains.count, least_grains());
    const StudiedSetting plain = settings_[1];
    const Deadline start(0.0);
    const SamplePath pilot = tried_sample(run_options(small, plain, scene_.seed), {}, nullptr, deadline_);
    const double speed = -start.left() / expected_cost(small);
    options_.progress(fmt::format("a sample of {} grains with the settings of the scene took {:.1f} s",
                                  small.grains.count, -start.left()));
    if (!pilot.whole() || !has_any_number_of_grains(scene_)) return;
    const int wanted = scene_.grains.count;
    while (scene_.grains.count > least_grains() &&
           kSamplesWanted * sample_cost(scene_.grains.count, speed) > deadline_.left())
      scene_.grains.count = std::max(least_grains(), static_cast<int>(0.9 * scene_.grains.count));
    if (scene_.grains.count < wanted)
      left_out_.push_back(
          fmt::format("some of the grains: the samples have {} grains instead of {}, because more grains do "
                      "not fit into the budget",
                      scene_.grains.count, wanted));
  }

  bool next_sample_fits(int k) {
    if (k == 0) return true;
    if (!last_seed_whole_) return false;
    if (kMargin * last_seed_seconds_ < deadline_.left()) return true;
    left_out_.push_back(fmt::format(
        "all samples after the first {} of {}, because the next sample would take {:.0f} s, but only {:.0f} s "
        "of the budget are left",
        k, max_samples_, last_seed_seconds_, deadline_.left()));
    return false;
  }

  void run_seed(int k) {
    const Deadline start(0.0);
    last_seed_whole_ = false;
    const std::uint64_t seed = scene_.seed + static_cast<std::uint64_t>(k);
    // The run with the strictest settings comes first. Its states are compared with the states of the other runs, and
    // its processor time sets their time limits. If this run fails, nothing can be compared, so the seed is left out.
    SamplePath reference = make_path(0, seed, nullptr, deadline_);
    if (!reference.whole()) return fail(0, seed, reference);
    SamplePath base;
    for (std::size_t i = 1; i < settings_.size(); ++i) {
      if (skipped_.contains(i)) continue;
      if (settings_[i].is_moduli_level()) {
        // The moduli are computed for the states of the reference. The run `base` with the settings of the scene gives
        // only the processor time of making such states.
        samples_[i].push_back(moduli_level(k, settings_[i], reference, base));
        continue;
      }
      if (!affordable(i, reference)) continue;
      const double longest = kLongestRun * std::max(1.0, settings_[i].steps_factor) * reference.core_seconds;
      SamplePath path =
          make_path(i, seed, settings_[i].has_other_states() ? nullptr : &reference, deadline_.within(longest));
      if (!path.whole()) {
        fail(i, seed, path);
        continue;
      }
      path.drop_packings();
      if (i == 1) base = path;
      samples_[i].push_back({k, std::move(path), {}, 0.0});
    }
    // The packings of the reference are freed only now, because the other settings needed them.
    reference.drop_packings();
    samples_[0].push_back({k, std::move(reference), {}, 0.0});
    last_seed_whole_ = !deadline_.passed();
    last_seed_seconds_ = -start.left();
  }

  /// Makes a sample with setting number i.
  /// @param reference  see make_sample()
  /// @param deadline  deadline of the run, before its states are relaxed with the strictest settings
  SamplePath make_path(std::size_t i, std::uint64_t seed, const SamplePath* reference,
                       const Deadline& deadline) {
    const StudiedSetting& setting = settings_[i];
    SamplePath path = tried_sample(run_options(scene_, setting, seed), setting.moduli, reference, deadline);
    if (setting.is_reference()) {
      for (ObservedState& s : path.states) s.settled = s.observation;
    } else if (path.whole() && !setting.has_other_states()) {
      settle(run_options(scene_, settings_[0], seed).relaxation, deadline_, path);
    }
    options_.progress(fmt::format("seed {}, setting {} {}: this sample took {:.2f} s", seed, setting.parameter,
                                  setting.value, path.core_seconds));
    return path;
  }

  /// Returns whether one more sample with a setting fits into the budget. If not even the first sample with this
  /// setting fits, the setting is left out of the whole study.
  /// @param i  index of the setting
  /// @param reference  path with the strictest settings from the same seed
  bool affordable(std::size_t i, const SamplePath& reference) {
    const double share = relative_cost(settings_[i]) / kReferenceCost;
    const double expected =
        samples_[i].empty() ? share * reference.core_seconds : samples_[i].back().path.core_seconds;
    if (kMargin * expected < deadline_.left()) return true;
    if (samples_[i].empty()) {
      skipped_.insert(i);
      left_out_.push_back(fmt::format(
          "{} {}: a sample with this setting would take {:.0f} s, but only {:.0f} s of the budget are left",
          settings_[i].parameter, settings_[i].value, expected, std::max(0.0, deadline_.left())));
    }
    return false;
  }

  void fail(std::size_t i, std::uint64_t seed, const SamplePath& path) {
    const bool budget_is_used_up = path.out_of_time && (i == 0 || deadline_.passed());
    const std::string reason =
        budget_is_used_up  ? "the run was stopped because the budget was used up"
        : path.out_of_time ? "the run was stopped because it took longer than with the strictest settings"
                           : path.failure;
    left_out_.push_back(
        fmt::format("{} {}, seed {}: {}", settings_[i].parameter, settings_[i].value, seed, reason));
    if (budget_is_used_up) return;
    skipped_.insert(i);  // later samples are made without this setting, because it may fail again
  }

  Sample moduli_level(int k, const StudiedSetting& setting, const SamplePath& reference,
                      const SamplePath& base) {
    Sample sample{k, {}, {}, base.core_seconds - base.moduli_seconds};
    const PeakMemory memory;
    const double start = processor_seconds();
    if (scene_.dimension == 2)
      sample.levels = levels_of<2>(setting.moduli, reference);
    else
      sample.levels = levels_of<3>(setting.moduli, reference);
    sample.path.memory = memory.megabytes();
    sample.path.moduli_seconds = processor_seconds() - start;
    sample.path.core_seconds = sample.base_seconds + sample.path.moduli_seconds;
    return sample;
  }

  /// Returns the observables of all states of a path, with elastic moduli computed by the method in `options`.
  template <int Dim>
  static std::vector<Observation> levels_of(const ModuliOptions& options, const SamplePath& path) {
    ModuliSequence<Dim> sequence(options);
    std::vector<Observation> levels;
    for (const ObservedState& s : path.states)
      levels.push_back(observe_moduli(std::get<State<Dim>>(s.state), sequence, s.observation));
    return levels;
  }

  void measure(Tradeoff& out) const {
    std::map<int, const SamplePath*> reference_of;
    std::vector<const SamplePath*> all;
    for (const Sample& s : samples_[0]) all.push_back(reference_of[s.index] = &s.path);
    if (all.empty()) return;
    const std::optional<PressureWindow> window = fit_window(all);
    describe_reference(all, window, out);
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      std::vector<const SamplePath*> references, paths;
      std::vector<std::vector<Observation>> levels;
      for (const Sample& s : samples_[i]) {
        if (!reference_of.contains(s.index)) continue;
        references.push_back(reference_of[s.index]);
        paths.push_back(&s.path);
        levels.push_back(s.levels);
      }
      if (references.empty()) continue;
      MeasuredSetting m = cost_of(scene_, settings_[i], references, paths);
      m.errors = settings_[i].is_moduli_level()    ? compare_levels(references, levels)
                 : settings_[i].has_other_states() ? compare_means(references, paths, window)
                                                   : compare(references, paths, window);
      out.settings.push_back(std::move(m));
    }
    add_sample_numbers(scene_, settings_[0], all, window, out);
  }

  Scene scene_;
  const TradeoffOptions& options_;
  Deadline deadline_;
  std::vector<std::string> left_out_;
  int max_samples_;
  std::vector<StudiedSetting> settings_;
  std::vector<std::vector<Sample>> samples_;  // for each setting, its samples
  std::set<std::size_t> skipped_;
  double last_seed_seconds_ = 0.0;
  bool last_seed_whole_ = true;
};

}  // namespace

void require_study(const TradeoffOptions& options) {
  require_in_range("budget", options.budget, kPositiveNumber);
  require_in_range("samples", options.max_samples, TradeoffOptions::kSamples);
}

int number_of_samples(const Scene& scene, const TradeoffOptions& options, std::vector<std::string>& left_out) {
  if (scene.is_random() || options.max_samples == 1) return options.max_samples;
  left_out.push_back(
      "all samples beyond the first, because the run starts from a saved packing at rest, so that every seed "
      "makes the same states");
  return 1;
}

Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options) {
  require_study(options);
  return Study(std::move(scene), options).run();
}

void describe_reference(const std::vector<const SamplePath*>& references,
                        const std::optional<PressureWindow>& window, Tradeoff& out) {
  out.n_states = static_cast<int>(references.front()->states.size());
  out.reference = mean_values(references, window);
  out.scatter.fill(std::numeric_limits<double>::quiet_NaN());
  if (references.size() < 2) return;
  const ObservableErrors one = sampling_errors(references, 1, window);
  for (std::size_t k = 0; k < kObservables; ++k)
    if (one[k].mean.n > 0) out.scatter[k] = one[k].mean.standard_error;
}

MeasuredSetting cost_of(const Scene& scene, const StudiedSetting& setting,
                        const std::vector<const SamplePath*>& references,
                        const std::vector<const SamplePath*>& paths) {
  const auto total = [](const std::vector<const SamplePath*>& of, double SamplePath::*seconds) {
    return std::accumulate(of.begin(), of.end(), 0.0,
                           [&](double sum, const SamplePath* p) { return sum + p->*seconds; });
  };
  const auto n = static_cast<double>(paths.size());
  const double seconds = total(paths, &SamplePath::core_seconds);
  double memory = 0.0;
  for (const SamplePath* path : paths) memory = std::max(memory, path->memory);
  return {setting,
          setting.n_grains > 0 ? setting.n_grains : scene.grains.count,
          static_cast<int>(paths.size()),
          seconds / n,
          total(paths, &SamplePath::moduli_seconds) / n,
          seconds / total(references, &SamplePath::core_seconds),
          memory,
          {}};
}

void add_sample_numbers(const Scene& scene, const StudiedSetting& strict,
                        const std::vector<const SamplePath*>& references,
                        const std::optional<PressureWindow>& window, Tradeoff& out) {
  if (references.size() < 2) return;
  for (int n = 1; n <= static_cast<int>(references.size()); n *= 2) {
    StudiedSetting setting = strict;
    setting.parameter = "samples";
    setting.value = std::to_string(n);
    MeasuredSetting m = cost_of(scene, setting, references, references);
    m.core_seconds *= n;
    m.moduli_seconds *= n;
    m.cost_ratio = n;
    m.n_samples = n;
    m.errors = sampling_errors(references, n, window);
    out.settings.push_back(std::move(m));
  }
}

double single_state_error(const ObservableError& error) {
  if (error.before.n + error.after.n == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::max(error.before.high, error.after.high);
}

std::vector<bool> pareto_front(const Tradeoff& tradeoff, std::size_t observable) {
  const auto error = [&](const MeasuredSetting& m) { return single_state_error(m.errors[observable]); };
  std::vector<bool> front;
  for (const MeasuredSetting& m : tradeoff.settings)
    front.push_back(
        std::isfinite(error(m)) &&
        std::none_of(tradeoff.settings.begin(), tradeoff.settings.end(), [&](const MeasuredSetting& other) {
          return other.core_seconds <= m.core_seconds && error(other) <= error(m) &&
                 (other.core_seconds < m.core_seconds || error(other) < error(m));
        }));
  return front;
}

}  // namespace floc
