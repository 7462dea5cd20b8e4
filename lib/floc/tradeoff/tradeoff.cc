#include "floc/tradeoff/tradeoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "floc/base/error.h"
#include "floc/scene/derived_groups.h"
#include "floc/tradeoff/fitted_path.h"

namespace floc {
namespace {

/// Number of grains of the small sample whose run measures the speed of this machine. A study uses at least as many
/// grains.
constexpr int kMinGrains = 40;
/// Number of samples that must fit into the budget with every setting; if they do not, the number of grains is reduced.
/// The error of a mean cannot be estimated from fewer than two samples.
constexpr double kSamplesWanted = 2.0;
/// Processor time of a run with the strictest settings over that with the settings of the scene, assumed before it is
/// measured. The strictest settings have shorter time steps, and wait longer before a packing counts as at rest.
constexpr double kReferenceCost = 4.0;
/// Share of the processor time of the study that runs may take; comparing and fitting takes the rest.
constexpr double kShareOfRuns = 0.97;
/// Safety factor on the expected processor time of a run, when it is checked whether the run fits into the budget.
constexpr double kMargin = 1.3;

class Study {
 public:
  Study(Scene scene, const TradeoffOptions& options)
      : scene_(std::move(scene)),
        options_(options),
        deadline_(kShareOfRuns * options.budget),
        settings_(studied_settings(scene_)) {}

  Tradeoff run() {
    fit_size_to_budget();
    settings_ = studied_settings(scene_);
    samples_.resize(settings_.size());
    for (int k = 0; k < options_.max_samples && next_sample_fits(k); ++k) run_seed(k);
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
    // Observables of the states of the reference path with the elastic moduli of this setting, if the setting changes
    // only the computation of the moduli.
    std::vector<Observation> levels;
    // If the setting changes only the computation of the moduli: processor time of the run (s), to which the time of
    // the moduli is added.
    double base_seconds = 0.0;
  };

  /// Returns the expected processor time of one sample with every setting together (s).
  /// @param n_grains  number of grains of the sample
  /// @param speed  processor time measured on this machine over the time that expected_cost() predicts
  double sample_cost(int n_grains, double speed) const {
    Scene sized = scene_;
    sized.grains.count = n_grains;
    double units = kReferenceCost;
    for (const StudiedSetting& s : settings_)
      if (!s.is_reference() && !s.is_moduli_level())
        units += scene_.relaxation.time_step / s.numerical.time_step *
                 (s.is_other_size() ? static_cast<double>(s.n_grains) / scene_.grains.count : 1.0);
    return units * expected_cost(sized) * speed;
  }

  /// Runs a small sample to measure the speed of this machine. Then reduces the number of grains until the study fits
  /// into its budget.
  void fit_size_to_budget() {
    Scene small = scene_;
    small.grains.count = std::min(scene_.grains.count, kMinGrains);
    const StudiedSetting plain = settings_[1];
    const Deadline start(0.0);
    const SamplePath pilot = make_sample(run_options(small, plain, scene_.seed), {}, nullptr, deadline_);
    const double speed = -start.left() / expected_cost(small);
    options_.progress(fmt::format("a sample of {} grains with the settings of the scene took {:.1f} s",
                                  small.grains.count, -start.left()));
    if (!pilot.whole() || scene_.grains.diameter.kind == DiameterDistribution::Kind::list) return;
    const int wanted = scene_.grains.count;
    while (scene_.grains.count > kMinGrains &&
           kSamplesWanted * sample_cost(scene_.grains.count, speed) > deadline_.left())
      scene_.grains.count = std::max(kMinGrains, static_cast<int>(0.9 * scene_.grains.count));
    if (scene_.grains.count < wanted)
      left_out_.push_back(
          fmt::format("some of the grains: the samples have {} grains in place of {}, because more do not fit "
                      "into the budget",
                      scene_.grains.count, wanted));
  }

  bool next_sample_fits(int k) {
    if (k == 0) return true;
    if (!last_seed_whole_) return false;
    if (kMargin * last_seed_seconds_ < deadline_.left()) return true;
    left_out_.push_back(fmt::format(
        "all samples beyond {} of {}, because the next sample would take {:.0f} s, but only {:.0f} s "
        "of the budget are left",
        k, options_.max_samples, last_seed_seconds_, deadline_.left()));
    return false;
  }

  void run_seed(int k) {
    const Deadline start(0.0);
    last_seed_whole_ = false;
    const std::uint64_t seed = scene_.seed + static_cast<std::uint64_t>(k);
    SamplePath reference = make_path(0, seed, nullptr);
    if (!reference.whole()) return fail(0, seed, reference);
    SamplePath base;
    for (std::size_t i = 1; i < settings_.size(); ++i) {
      if (skipped_.contains(i)) continue;
      if (settings_[i].is_moduli_level()) {
        samples_[i].push_back(moduli_level(k, settings_[i], reference, base));
        continue;
      }
      if (!affordable(i, reference)) continue;
      SamplePath path = make_path(i, seed, settings_[i].is_other_size() ? nullptr : &reference);
      if (!path.whole()) {
        fail(i, seed, path);
        continue;
      }
      for (ObservedState& s : path.states) s.state.packing.contacts.clear();
      if (i == 1) base = path;
      samples_[i].push_back({k, std::move(path), {}, 0.0});
    }
    for (ObservedState& s : reference.states) s.state.packing.contacts.clear();
    samples_[0].push_back({k, std::move(reference), {}, 0.0});
    last_seed_whole_ = !deadline_.passed();
    last_seed_seconds_ = -start.left();
  }

  SamplePath make_path(std::size_t i, std::uint64_t seed, const SamplePath* reference) {
    const StudiedSetting& setting = settings_[i];
    SamplePath path = make_sample(run_options(scene_, setting, seed), setting.moduli, reference, deadline_);
    RelaxationOptions strict = run_options(scene_, settings_[0], seed).relaxation;
    if (path.whole()) settle(strict, deadline_, path);
    options_.progress(fmt::format("seed {}, setting {} {}: this sample took {:.2f} s", seed, setting.parameter,
                                  setting.value, path.core_seconds));
    return path;
  }

  /// Returns whether one more sample with a setting fits into the budget. If not even its first sample fits, the
  /// setting is left out of the whole study.
  /// @param i  index of the setting
  /// @param reference  path with the strictest settings from the same seed
  bool affordable(std::size_t i, const SamplePath& reference) {
    const double share = scene_.relaxation.time_step / settings_[i].numerical.time_step / kReferenceCost;
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
    left_out_.push_back(
        fmt::format("{} {}, seed {}: {}", settings_[i].parameter, settings_[i].value, seed,
                    path.out_of_time ? "the run was stopped because the budget was used up" : path.failure));
    if (path.out_of_time) return;
    skipped_.insert(i);  // later samples leave this setting out, because it may fail in them as well
  }

  Sample moduli_level(int k, const StudiedSetting& setting, const SamplePath& reference,
                      const SamplePath& base) {
    Sample sample{k, {}, {}, base.core_seconds - base.moduli_seconds};
    ModuliSequence<2> sequence(setting.moduli);
    const double start = processor_seconds();
    for (const ObservedState& s : reference.states)
      sample.levels.push_back(observe_moduli(s.state, sequence, s.observation));
    sample.path.moduli_seconds = processor_seconds() - start;
    sample.path.core_seconds = sample.base_seconds + sample.path.moduli_seconds;
    return sample;
  }

  void measure(Tradeoff& out) const {
    std::map<int, const SamplePath*> reference_of;
    std::vector<const SamplePath*> all;
    for (const Sample& s : samples_[0]) all.push_back(reference_of[s.index] = &s.path);
    const std::optional<PressureWindow> window = fit_window(all);
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
      MeasuredSetting m = cost_of(settings_[i], references, paths);
      m.errors = settings_[i].is_moduli_level() ? compare_levels(references, levels)
                 : settings_[i].is_other_size() ? compare_means(references, paths, window)
                                                : compare(references, paths, window);
      out.settings.push_back(std::move(m));
    }
    add_sample_numbers(out);
  }

  MeasuredSetting cost_of(const StudiedSetting& setting, const std::vector<const SamplePath*>& references,
                          const std::vector<const SamplePath*>& paths) const {
    const auto total = [](const std::vector<const SamplePath*>& of, double SamplePath::*seconds) {
      return std::accumulate(of.begin(), of.end(), 0.0,
                             [&](double sum, const SamplePath* p) { return sum + p->*seconds; });
    };
    const auto n = static_cast<double>(paths.size());
    const double seconds = total(paths, &SamplePath::core_seconds);
    return {setting,
            setting.is_other_size() ? setting.n_grains : scene_.grains.count,
            static_cast<int>(paths.size()),
            seconds / n,
            total(paths, &SamplePath::moduli_seconds) / n,
            seconds / total(references, &SamplePath::core_seconds),
            {}};
  }

  /// Adds to the results, under the parameter "samples", the error of a mean over 1, 2, 4, ... samples. It is the
  /// scatter between samples with the strictest settings.
  void add_sample_numbers(Tradeoff& out) const {
    std::vector<const SamplePath*> references;
    for (const Sample& s : samples_[0]) references.push_back(&s.path);
    if (references.size() < 2) return;
    for (int n = 1; n <= static_cast<int>(references.size()); n *= 2) {
      StudiedSetting setting = settings_[0];
      setting.parameter = "samples";
      setting.value = std::to_string(n);
      MeasuredSetting m = cost_of(setting, references, references);
      m.core_seconds *= n;
      m.moduli_seconds *= n;
      m.cost_ratio = n;
      m.n_samples = n;
      m.errors = sampling_errors(references, n);
      out.settings.push_back(std::move(m));
    }
  }

  Scene scene_;
  const TradeoffOptions& options_;
  Deadline deadline_;
  std::vector<StudiedSetting> settings_;
  std::vector<std::vector<Sample>> samples_;  // for each setting, its samples
  std::set<std::size_t> skipped_;
  std::vector<std::string> left_out_;
  double last_seed_seconds_ = 0.0;
  bool last_seed_whole_ = true;
};

}  // namespace

Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options) {
  require_in_range("budget", options.budget, kPositiveNumber);
  require_in_range("samples", options.max_samples, TradeoffOptions::kSamples);
  if (scene.starts_from_state())
    throw InputError(
        "assembly.protocol = \"state\"",
        "the study makes samples with different numbers of grains, which requires a gas in place of a saved "
        "state: expected \"direct\" or \"aggregation\"");
  if (scene.law.is_rigid())
    throw InputError(
        "contact.normal.law = \"rigid\"",
        "the study varies the settings of the dynamics of elastic grains: expected elastic contacts");
  return Study(std::move(scene), options).run();
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
