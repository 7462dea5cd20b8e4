#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/prices/accuracy.h"
#include "floc/scene/scene.h"

namespace floc {

/// Model of the processor time and the memory of runs of a scene, as functions of the number of grains and of the
/// numerical settings. The model extrapolates from a table of prices, or from samples of the scene.
///
/// The processor time of a sample of N grains is proportional to N^p sqrt(kappa/kappa0) (1 - b + b n/n0) for a run with
/// n equilibria and the stiffness number kappa of stiffness_number(), where n0 and kappa0 are those of the table and b
/// is the fraction of the time that is proportional to the number of equilibria.
class CostModel {
 public:
  /// Model from a table of prices of the kind of the scene, whose rows must exist as long as the model.
  /// @throws InputError if the table lacks the processor time or the number of grains of the parameter "scene"
  CostModel(const Scene& scene, const PriceTable& table);
  /// Model from samples of the scene.
  /// @param n_grains  number of grains of a sample
  /// @param core_seconds  processor time of a sample (s)
  /// @param exponent  exponent p: the processor time is proportional to N^p for N grains
  CostModel(const Scene& scene, int n_grains, double core_seconds, double exponent);

  /// Corrects a model from a table by samples of the scene.
  /// @param exponent  exponent p; absent if the exponent of the table is kept
  void correct(int n_grains, double core_seconds, std::optional<double> exponent);

  /// Numerical settings whose cost is known. They refer to rows of the table.
  const std::vector<PricedSettings>& settings() const { return settings_; }
  /// Number of grains of the samples on which the processor time was measured.
  int measured_grains() const { return n_grains_; }

  /// Returns the processor time (s) of a sample of `n_grains` grains.
  double core_seconds(const PricedSettings& settings, double n_grains) const;
  /// Returns the largest memory (MB) of a run of `n_grains` grains.
  double memory_mb(double n_grains) const;
  /// Returns the row of the table that has the same settings as the scene. If there is no such row, returns the row
  /// for the parameter "scene", with the processor time converted to the settings of the scene: for elastic grains to
  /// its time step and softening, for rigid grains to its settings of contact dynamics.
  PricedSettings settings_of_scene() const;

 private:
  double time_with_steps_of_parts() const;
  double time_with_softening(const PricedSettings& plain, const Softening& softening) const;
  double time_with_equal_masses(const PricedSettings& plain) const;
  PricedSettings settings_of_rigid_grains(PricedSettings plain) const;
  double time_ratio(const PricedSettings& plain, const std::string& parameter, double value,
                    std::optional<double> value_of_table) const;

  const Scene& scene_;
  std::vector<PricedSettings> settings_;
  int n_grains_ = 0;
  double memory_of_grain_ = 0.0;  ///< memory of a run (MB), divided by the number of grains
  double exponent_ = 0.0;
  /// Processor time of this scene divided by the processor time of the scene from which the table was made.
  double factor_ = 1.0;
};

/// Expected processor time and memory of one run of a scene.
struct RunCost {
  double core_seconds;  ///< processor time on one core (s)
  /// largest memory (MB); absent if no table of prices applies to the scene
  std::optional<double> memory_mb;

  /// Whether a table of prices gives the processor time; otherwise it is the rough estimate of expected_cost().
  bool is_priced() const { return memory_mb.has_value(); }
};

/// Returns the expected cost of one run of a scene with its own settings and number of grains: that of the table of
/// prices of its kind or, if no table applies, the rough estimate of expected_cost(). Tables do not apply to scenes
/// that start from a saved state, because a large part of the measured time was spent in the assembly.
/// @param prices  file of a table that floc tradeoff has written; empty: the table shipped with floc
/// @throws InputError if the file `prices` is not valid, or does not apply to the scene
RunCost cost_of_run(const Scene& scene, const std::string& prices = "");

}  // namespace floc
