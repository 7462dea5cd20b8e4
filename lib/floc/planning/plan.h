#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/range.h"
#include "floc/planning/price_model.h"

namespace floc {

/// Request of a user for a scene: the largest accepted relative errors of the results, or the time that may be spent.
struct PlanRequest {
  std::optional<double> budget;  ///< wall time (s) on `cores` cores; if absent, the time is not limited
  int cores = 1;
  /// Names of observables, each with its largest accepted relative error.
  std::vector<std::pair<std::string, double>> wants;
  /// Names of the observables whose errors are minimised if `wants` is empty. If this list is empty too, the errors of
  /// all observables are minimised.
  std::vector<std::string> observables;

  static constexpr WholeRange kCores{.least = 1, .most = 1024};
};

/// Number of grains, number of samples and numerical settings, with their cost and the errors that remain.
struct Plan {
  PricedSettings settings;
  int n_grains = 0, n_samples = 0;
  double core_seconds = 0.0;        ///< processor time of all samples (s)
  double wall_seconds = 0.0;        ///< wall time of all samples on the cores of the request (s)
  double memory_mb = 0.0;           ///< largest memory of all samples that run at the same time (MB)
  std::vector<PricedError> errors;  ///< error of each observable in PlanChoice::observables
};

/// Best plans for a request, the best first. No two plans have the same numerical settings.
struct PlanChoice {
  std::vector<ObservablePrice> observables;
  std::vector<Plan> plans;
};

/// Smallest and largest number of samples of a plan. If four samples of the smallest size exceed the budget, a plan may
/// have fewer than the smallest number of samples. The reason for the smallest number is that fewer than four samples
/// do not determine the scatter well enough.
inline constexpr int kLeastSamples = 4, kMostSamples = 10'000;

/// Returns the plan with the given numbers and settings, with its cost and its errors.
/// @param observables  observables of the model whose errors are given
Plan plan_of(const PriceModel& model, const std::vector<ObservablePrice>& observables,
             const PricedSettings& settings, int n_grains, int n_samples, int cores);

/// Returns the numbers of grains among which choose_plans() chooses, in ascending order. The numbers range from the
/// smallest to the largest number of grains of the model; each number is about a tenth larger than the one before.
std::vector<int> numbers_of_grains(const PriceModel& model);

/// Chooses the number of grains, the number of samples and the settings.
/// 1. If errors are requested, no error of a plan may exceed its requested value, and the plan with the smallest
/// processor time is the best.
/// 2. Otherwise a plan must fit into the budget. The logarithms of the errors are averaged over the observables, and
/// the plan with the smallest mean is the best. Therefore the order of the plans does not depend on the scales of the
/// observables.
/// @param n_plans  largest number of plans
/// @throws InputError if the model lacks an observable, if a requested error is smaller than any plan can reach, if the
/// requested errors cost more than the budget, or if the budget is below the cost of one sample. The message names the
/// nearest values that are possible
PlanChoice choose_plans(const PriceModel& model, const PlanRequest& request, int n_plans);

/// Returns the requested errors in texts such as "phi=0.003,B=0.03". A name in a text is the name of an observable, or
/// a key of the table [accuracy] that covers several observables.
/// @param names  names of all observables of the scene
/// @throws InputError if a text does not have this form, a name is unknown, or an error is not positive
std::vector<std::pair<std::string, double>> wants_of(const std::vector<std::string>& texts,
                                                     const std::vector<std::string>& names);

}  // namespace floc
