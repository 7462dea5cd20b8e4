#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/range.h"
#include "floc/planning/price_model.h"

namespace floc {

/// Wishes of a user for a scene: errors that are wanted, or the time that may be spent.
struct PlanRequest {
  std::optional<double> budget;  ///< wall time (s) on `cores` cores; absent: as much as the wanted errors take
  int cores = 1;
  /// Names of observables with the largest accepted relative error of each.
  std::vector<std::pair<std::string, double>> wants;
  /// Names of the observables whose errors count where no errors are wanted; empty: all.
  std::vector<std::string> observables;

  static constexpr WholeRange kCores{.least = 1, .most = 1024};
};

/// Numbers of grains and of samples with numerical settings: what they cost, and the errors that they leave.
struct Plan {
  PricedSettings settings;
  int n_grains = 0, n_samples = 0;
  double core_seconds = 0.0;        ///< processor time of all samples (s)
  double wall_seconds = 0.0;        ///< wall time of all samples on the cores of the request (s)
  double memory_mb = 0.0;           ///< largest memory of the samples that run at the same time (MB)
  std::vector<PricedError> errors;  ///< one for each of PlanChoice::observables
};

/// The best plans for a request, the best first, each with other settings.
struct PlanChoice {
  std::vector<ObservablePrice> observables;
  std::vector<Plan> plans;
};

/// Smallest and largest number of samples of a plan. Fewer would not tell how large the scatter between them is; a plan
/// has fewer only if its budget does not allow this number with the smallest samples.
inline constexpr int kLeastSamples = 4, kMostSamples = 10'000;

/// Returns the error that a plan with these numbers leaves, and its cost.
/// @param observables  observables of the model whose errors are given
Plan plan_of(const PriceModel& model, const std::vector<ObservablePrice>& observables,
             const PricedSettings& settings, int n_grains, int n_samples, int cores);

/// Returns the numbers of grains among which choose_plans() chooses, in ascending order: from the least to the most of
/// the model, each at most about a tenth larger than the one before.
std::vector<int> numbers_of_grains(const PriceModel& model);

/// Chooses the number of grains, the number of samples and the settings.
/// 1. Where errors are wanted, the plans are those that keep all of them at the smallest processor time.
/// 2. Otherwise they are those whose errors are smallest within the budget: the mean of the logarithms of the errors of
/// the observables is smallest, so that each observable counts alike, whatever its scale.
/// @param n_plans  largest number of plans
/// @throws InputError if the model lacks an observable, if a wanted error is below what can be had, if the wanted errors
/// do not fit into the budget, or if the budget is below one sample; the message names the nearest that can be had
PlanChoice choose_plans(const PriceModel& model, const PlanRequest& request, int n_plans);

/// Returns the errors that a text such as "phi=0.003,B=0.03" wants: names of observables, or keys of [accuracy], which
/// stand for several.
/// @param names  names of all observables of the scene
/// @throws InputError if a part is not of this form, its name is none of them, or its error is not positive
std::vector<std::pair<std::string, double>> wants_of(const std::vector<std::string>& texts,
                                                     const std::vector<std::string>& names);

}  // namespace floc
