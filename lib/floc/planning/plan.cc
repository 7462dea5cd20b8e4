#include "floc/planning/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/base/parse_number.h"
#include "floc/planning/duration.h"
#include "floc/prices/accuracy.h"

namespace floc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Factor by which rounding errors may raise a cost above the budget.
constexpr double kRounding = 1.0 + 1e-12;

/// Ratio of successive numbers of grains in the list from which a plan is chosen.
constexpr double kStepOfGrains = 1.1;

/// Largest error of an observable that counts if the user names none: its smallest error with the largest number of
/// grains and kMostSamples samples. The parameters of a fit have far larger errors if the paths do not determine them.
constexpr double kLargestError = 1.0;

/// Returns a number rounded to two significant digits.
int rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return static_cast<int>(std::lround(std::round(x / unit) * unit));
}

/// Checks that the scatter between samples, without which no error is known, is known for some observable.
void require_scatter(const std::vector<ObservablePrice>& observables) {
  if (observables.empty())
    throw InputError(
        "floc plan",
        "the table of prices has fewer than two samples, so it does not contain the scatter between samples: "
        "expected a table of more samples (--prices FILE), or --pilot, which measures the scatter");
}

std::vector<ObservablePrice> chosen_observables(const PriceModel& model, const PlanRequest& request) {
  require_scatter(model.observables());
  std::vector<ObservablePrice> chosen;
  for (const std::string& name : request.observables) chosen.push_back(model.observable(name, "--observables"));
  for (const auto& [name, error] : request.wants)
    if (std::none_of(chosen.begin(), chosen.end(), [&, &key = name](const auto& o) { return o.name == key; }))
      chosen.push_back(model.observable(name, "--want"));
  return chosen.empty() ? model.observables() : chosen;
}

/// Search for the best plans that fulfil a request.
class PlanSearch {
 public:
  PlanSearch(const PriceModel& model, const PlanRequest& request)
      : model_(model),
        request_(request),
        observables_(chosen_observables(model, request)),
        sizes_(numbers_of_grains(model)) {
    for (const PricedSettings& settings : model.settings())
      if (!settings.is_reference() || model.settings().size() == 1) settings_.push_back(settings);
    for (const auto& [name, error] : request.wants) wanted_.emplace_back(index_of(name), error);
    drop_unpriced();
  }

  PlanChoice best(int n_plans) const {
    require_scatter(observables_);
    if (!wanted_.empty()) require_reachable();
    std::vector<ScoredPlan> found = plans_of_settings(kLeastSamples);
    if (found.empty() || exceeds_budget(found.front().second)) found = plans_of_settings(1);
    if (found.empty()) refuse();
    PlanChoice choice{observables_, {}};
    for (auto& [score, plan] : found)
      if (static_cast<int>(choice.plans.size()) < n_plans) choice.plans.push_back(std::move(plan));
    if (exceeds_budget(choice.plans.front())) refuse_budget(choice.plans.front());
    return choice;
  }

 private:
  /// A plan and its score, by which plans are compared: the plan with the smallest score is the best.
  using ScoredPlan = std::pair<std::pair<bool, double>, Plan>;

  bool exceeds_budget(const Plan& plan) const {
    return request_.budget && plan.wall_seconds > kRounding * *request_.budget;
  }

  /// For each set of numerical settings, returns the best plan if there is a plan. The plan with the best score comes
  /// first.
  std::vector<ScoredPlan> plans_of_settings(int least_samples) const {
    std::vector<ScoredPlan> found;
    for (const PricedSettings& settings : settings_) {
      auto plan = wanted_.empty() ? best_in_budget(settings, least_samples) : cheapest(settings, least_samples);
      if (!plan) continue;
      const auto score = wanted_.empty() ? std::pair(false, mean_log_error(*plan)) : cost_of(*plan);
      found.emplace_back(score, std::move(*plan));
    }
    std::ranges::stable_sort(found, {}, &ScoredPlan::first);
    return found;
  }

  std::size_t index_of(const std::string& name) const {
    return static_cast<std::size_t>(
        std::find_if(observables_.begin(), observables_.end(), [&](const auto& o) { return o.name == name; }) -
        observables_.begin());
  }

  /// Removes the observables whose error is not known for any settings, and those that no number of samples determines,
  /// unless the user has named observables or requested errors.
  void drop_unpriced() {
    if (!wanted_.empty() || !request_.observables.empty()) return;
    std::erase_if(observables_, [&](const ObservablePrice& o) {
      return std::none_of(settings_.begin(), settings_.end(), [&](const PricedSettings& s) {
        return model_.error(o, s, model_.most_grains(), kMostSamples).total() <= kLargestError;
      });
    });
  }

  Plan plan(const PricedSettings& settings, int n_grains, int n_samples) const {
    return plan_of(model_, observables_, settings, n_grains, n_samples, request_.cores);
  }

  static double mean_log_error(const Plan& plan) {
    double sum = 0.0;
    for (const PricedError& error : plan.errors) sum += std::log(error.total());
    return sum / static_cast<double>(plan.errors.size());
  }

  /// Returns the largest number of samples, of `n_grains` grains each, that fits into the budget; 0 if the budget is
  /// too small for one sample.
  int samples_in_budget(const PricedSettings& settings, int n_grains) const {
    if (!request_.budget) return kMostSamples;
    const double rounds = std::floor(kRounding * *request_.budget / model_.core_seconds(settings, n_grains));
    return static_cast<int>(std::min(rounds * request_.cores, static_cast<double>(kMostSamples)));
  }

  std::optional<Plan> best_in_budget(const PricedSettings& settings, int least_samples) const {
    std::optional<Plan> best;
    for (const int n_grains : sizes_) {
      const int n_samples = samples_in_budget(settings, n_grains);
      if (n_samples < least_samples) continue;
      Plan here = plan(settings, n_grains, n_samples);
      if (!std::isfinite(mean_log_error(here))) continue;
      if (!best || mean_log_error(here) < mean_log_error(*best)) best = std::move(here);
    }
    return best;
  }

  /// Returns the smallest number of samples with which no error exceeds its requested value; 0 if no number of samples
  /// is large enough.
  int samples_for_wants(const PricedSettings& settings, int n_grains) const {
    double needed = 1.0;
    for (const auto& [k, wanted] : wanted_) {
      const PricedError one = model_.error(observables_[k], settings, n_grains, 1);
      const double left = wanted - one.settings - one.size;
      if (!(left > 0.0)) return 0;
      needed = std::max(needed, std::ceil(std::pow(one.scatter / left, 2) * (1.0 - 1e-12)));
    }
    return needed > kMostSamples ? 0 : static_cast<int>(needed);
  }

  /// Returns the plan with the least processor time that reaches the requested errors. Plans within the budget come
  /// before all others, since on several cores the plan with the least processor time may take longer than another.
  std::optional<Plan> cheapest(const PricedSettings& settings, int least_samples) const {
    std::optional<Plan> best;
    for (const int n_grains : sizes_)
      if (const int n = samples_for_wants(settings, n_grains); n > 0)
        if (Plan here = plan(settings, n_grains, std::max(n, least_samples));
            !best || cost_of(here) < cost_of(*best))
          best = std::move(here);
    return best;
  }

  /// Returns a pair by which plans with requested errors are compared: whether the plan exceeds the budget, and its
  /// processor time. Of plans beyond the budget, the elapsed time is compared.
  std::pair<bool, double> cost_of(const Plan& plan) const {
    const bool exceeds = exceeds_budget(plan);
    return {exceeds, exceeds ? plan.wall_seconds : plan.core_seconds};
  }

  /// Returns the smallest error of an observable that can be reached with any settings, numbers of grains and numbers
  /// of samples.
  double least_error(std::size_t k) const {
    double least = kInfinity;
    for (const PricedSettings& settings : settings_)
      for (const int n_grains : sizes_)
        least = std::min(least, model_.error(observables_[k], settings, n_grains, kMostSamples).total());
    return least;
  }

  /// Checks that each requested error can be reached if the other requested errors are ignored.
  /// @throws InputError that names the requested errors that are too small
  void require_reachable() const {
    std::vector<std::string> problems;
    for (const auto& [k, wanted] : wanted_)
      if (const double least = least_error(k); !std::isfinite(least))
        problems.push_back(
            fmt::format("{0}={1:g}: the table does not contain the error of {0} that numerical settings cause; "
                        "leave {0} out",
                        observables_[k].name, wanted));
      else if (wanted < least)
        problems.push_back(
            fmt::format("{}={:g}: expected at least {}, the smallest error that any settings reach with up "
                        "to {} grains and {} samples",
                        observables_[k].name, wanted, rounded_up(least), sizes_.back(), kMostSamples));
    if (!problems.empty()) throw InputError("--want", fmt::format("{}", fmt::join(problems, "; ")));
  }

  [[noreturn]] void refuse() const {
    if (!wanted_.empty()) refuse_all_wants();
    const double least = cheapest_sample();
    throw InputError(
        "--budget " + duration_in_words(*request_.budget),
        std::isfinite(least)
            ? fmt::format(
                  "a single sample of the smallest size, {} grains, takes {}: expected at least this budget",
                  sizes_.front(), duration_in_words(1.005 * least))
            : "the table of prices has no settings for which the errors of all these quantities are known: "
              "expected fewer "
              "quantities (--observables)");
  }

  double cheapest_sample() const {
    double least = kInfinity;
    for (const PricedSettings& settings : settings_)
      if (std::isfinite(mean_log_error(plan(settings, sizes_.front(), 1))))
        least = std::min(least, model_.core_seconds(settings, sizes_.front()));
    return least;
  }

  /// Divides the error of each observable by the requested error of this observable, and returns the largest of the
  /// ratios.
  double worst_over_wanted(const PricedSettings& settings, int n_grains, int n_samples) const {
    double worst = 0.0;
    for (const auto& [k, wanted] : wanted_)
      worst = std::max(worst, model_.error(observables_[k], settings, n_grains, n_samples).total() / wanted);
    return worst;
  }

  /// Reports that the requested errors cannot all be reached at once. The message names the nearest errors that can be
  /// reached: the requested errors, all multiplied by the smallest factor with which a plan can reach them.
  [[noreturn]] void refuse_all_wants() const {
    double nearest = kInfinity;
    for (const PricedSettings& settings : settings_)
      for (const int n_grains : sizes_)
        nearest = std::min(nearest, worst_over_wanted(settings, n_grains, kMostSamples));
    throw InputError(
        "--want", "no settings reach all of these errors at once; the nearest errors that can be reached are " +
                      scaled_wants(nearest));
  }

  std::string scaled_wants(double factor) const {
    std::vector<std::string> nearest;
    for (const auto& [k, wanted] : wanted_)
      nearest.push_back(fmt::format("{}={}", observables_[k].name, rounded_up(wanted * factor, 3)));
    return fmt::format("{}", fmt::join(nearest, ","));
  }

  /// Reports that the requested errors cost more than the budget. The message also names the nearest errors that the
  /// budget allows.
  [[noreturn]] void refuse_budget(const Plan& least) const {
    double nearest = kInfinity;
    for (const PricedSettings& settings : settings_)
      for (const int n_grains : sizes_) {
        const int n_samples = samples_in_budget(settings, n_grains);
        if (n_samples >= 1) nearest = std::min(nearest, worst_over_wanted(settings, n_grains, n_samples));
      }
    throw InputError(
        "--budget " + duration_in_words(*request_.budget),
        fmt::format(
            "the requested errors take {} on {} core{}: expected at least this budget{}",
            duration_in_words(least.wall_seconds), request_.cores, request_.cores == 1 ? "" : "s",
            std::isfinite(nearest)
                ? ", or larger errors; the nearest errors that the budget allows are " + scaled_wants(nearest)
                : ""));
  }

  const PriceModel& model_;
  const PlanRequest& request_;
  std::vector<ObservablePrice> observables_;
  std::vector<int> sizes_;
  std::vector<PricedSettings> settings_;
  std::vector<std::pair<std::size_t, double>> wanted_;  ///< index of an observable, and its requested error
};

}  // namespace

Plan plan_of(const PriceModel& model, const std::vector<ObservablePrice>& observables,
             const PricedSettings& settings, int n_grains, int n_samples, int cores) {
  const double seconds = model.core_seconds(settings, n_grains);
  // Each core computes one sample at a time. The last round of samples takes as long as the others, even if some cores
  // are idle in it. Therefore n_samples/cores without rounding up would be too small.
  const double rounds = std::ceil(static_cast<double>(n_samples) / cores);
  Plan plan{settings,
            n_grains,
            n_samples,
            seconds * n_samples,
            seconds * rounds,
            model.memory_mb(n_grains) * std::min(cores, n_samples),
            {}};
  for (const ObservablePrice& o : observables)
    plan.errors.push_back(model.error(o, settings, n_grains, n_samples));
  return plan;
}

std::vector<int> numbers_of_grains(const PriceModel& model) {
  std::vector<int> sizes = {model.least_grains(), model.most_grains()};
  for (double n = model.least_grains(); n < model.most_grains(); n *= kStepOfGrains)
    sizes.push_back(std::max(model.least_grains(), rounded(n)));
  std::sort(sizes.begin(), sizes.end());
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  return sizes;
}

PlanChoice choose_plans(const PriceModel& model, const PlanRequest& request, int n_plans) {
  return PlanSearch(model, request).best(n_plans);
}

std::vector<std::pair<std::string, double>> wants_of(const std::vector<std::string>& texts,
                                                     const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, double>> wants;
  const std::vector<std::string> keys = accuracy_keys();
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const auto error =
        equals == std::string::npos ? std::nullopt : parse_number<double>(text.substr(equals + 1));
    if (!error || !(*error > 0.0) || !std::isfinite(*error))
      throw InputError("--want " + text,
                       "expected NAME=ERROR with a positive relative error, such as phi=0.003");
    // A name may be both an observable and a key of [accuracy], such as phi. The observable then takes precedence.
    std::vector<std::string> meant = {name};
    if (std::find(names.begin(), names.end(), name) == names.end() &&
        std::find(keys.begin(), keys.end(), name) != keys.end())
      meant = observables_of(name);
    // A key may stand for observables that this scene lacks; they are ignored. An unknown name leaves `meant` empty.
    std::erase_if(meant,
                  [&](const auto& m) { return std::find(names.begin(), names.end(), m) == names.end(); });
    if (meant.empty())
      throw InputError("--want " + text, fmt::format("{} is not a quantity of this scene whose error is in the "
                                                     "table of prices: expected one of {}; the nearest is {}",
                                                     name, fmt::join(names, ", "), nearest_name(name, names)));
    for (const std::string& m : meant) {
      // A key and one of its observables, or two texts, may request different errors of one observable.
      if (std::any_of(wants.begin(), wants.end(), [&](const auto& w) { return w.first == m; }))
        throw InputError("--want " + text, m + " is requested twice: expected each quantity once");
      wants.emplace_back(m, *error);
    }
  }
  return wants;
}

}  // namespace floc
