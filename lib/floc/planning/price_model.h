#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floc/prices/accuracy.h"
#include "floc/scene/scene.h"

namespace floc {

/// Parts of the error of a mean over states and samples, or of a fit to a path. All are relative half widths of 95 %
/// intervals.
struct PricedError {
  double settings = 0.0;  ///< error that the numerical settings cause, as far as the table of prices shows one
  double size = 0.0;      ///< error that the finite number of grains causes
  double scatter = 0.0;   ///< error by the scatter between samples

  double total() const { return settings + size + scatter; }
};

/// Scatter and finite size of one observable, from a table of prices or from a pilot.
struct ObservablePrice {
  std::string name;
  std::string unit;  ///< unit of the observable; empty if it is not known
  /// Standard deviation between samples of `n_grains` grains over the mean, and its number of degrees of freedom.
  double scatter;
  int dof;
  /// Error of the finite size: it is size/N^q for N grains, with the exponent q of the boundary. Absent if the table has
  /// no samples of another size.
  std::optional<double> size;
};

/// Measurements on samples of a scene: see run_pilot().
struct PilotResult {
  int n_grains = 0;      ///< number of grains of a sample
  int n_samples = 0;     ///< number of samples of this size
  double core_seconds;   ///< processor time of a sample (s)
  double cost_exponent;  ///< exponent p of the processor time, which is proportional to N^p
  std::vector<ObservablePrice> observables;
};

/// Cost and errors of runs of a scene, by their number of grains, their number of samples and their settings. They are
/// extrapolated from a table of prices, from a pilot, or from both. With both the processor time is that of the pilot, with
/// the table's dependence on size and settings, and the scatter is pooled.
///
/// 1. The processor time of a sample is proportional to N^p. Of it the share b/(1 - b + b n/n0) is proportional to the
/// number n of equilibria of the scene, over the number n0 in the table; the rest is that of the assembly.
/// 2. The scatter between samples is proportional to N^(-1/2), and that of a mean over them is Student's t s/sqrt(n).
/// 3. A finite size changes a mean in proportion to the share of grains that a boundary or an image disturbs:
/// 1/N in a periodic cell, N^(-1/d) between walls in d dimensions.
class PriceModel {
 public:
  /// @param table  table of prices of the kind of the scene; absent if only a pilot is known
  /// @param pilot  measurements on the scene; absent if only a table is known. One of both has to be there
  PriceModel(const Scene& scene, std::optional<PriceTable> table, std::optional<PilotResult> pilot = {});

  /// Numerical settings that the scene can have. The rows of the settings are in the table of this model.
  const std::vector<PricedSettings>& settings() const { return settings_; }
  const std::vector<ObservablePrice>& observables() const { return observables_; }
  /// @throws InputError that names the nearest observable, if the model does not have this one
  const ObservablePrice& observable(const std::string& name, const std::string& place) const;

  /// Removes settings from those among which plans are chosen.
  /// @param is_wrong  whether settings are removed; the settings of the row "scene" are kept in any case
  void remove_settings(const std::function<bool(const PricedSettings&)>& is_wrong);

  int measured_grains() const { return n_grains_; }
  /// Smallest and largest number of grains for which the model is used: not fewer than were measured, and not more than
  /// fifty times as many (ten times after a pilot alone). Both are that of the scene if its diameters are listed.
  int least_grains() const { return least_grains_; }
  int most_grains() const { return most_grains_; }
  bool knows_settings() const { return table_.has_value(); }

  /// Returns the processor time of a sample (s) of `n_grains` grains.
  double core_seconds(const PricedSettings& settings, double n_grains) const;
  /// Returns the largest memory of a run (MB) of `n_grains` grains.
  double memory_mb(double n_grains) const;
  /// Returns the error of an observable. It is infinite if the table does not say what error the settings cause.
  PricedError error(const ObservablePrice& observable, const PricedSettings& settings, double n_grains,
                    double n_samples) const;
  /// Returns the settings of the table that are those of the scene, or those of the row "scene" with the processor time
  /// of the scene's time step and softening.
  PricedSettings settings_of_scene() const;
  /// Returns the processor time of a run with softer springs over that without: interpolated among the rows of softening
  /// in the table; the assembly takes a fixed share of it.
  double time_with_softening(const Softening& softening) const;

 private:
  void take_table();
  void take_pilot(const PilotResult& pilot);
  double size_error(const ObservablePrice& observable, double n_grains) const;

  const Scene& scene_;
  std::optional<PriceTable> table_;
  std::vector<PricedSettings> settings_, cells_;
  std::vector<ObservablePrice> observables_;
  int n_grains_ = 0, least_grains_ = 0, most_grains_ = 0;
  double cost_exponent_ = 0.0;
  double cost_factor_ = 1.0;  ///< processor time for the scene over that for the scene of the table
  double size_exponent_ = 1.0;
};

/// Expected price of one run of a scene.
struct ExpectedPrice {
  double core_seconds;
  double memory_mb;
};

/// Returns the expected price of one run of a scene with its own settings and number of grains.
ExpectedPrice expected_price(const PriceModel& model, const Scene& scene);

}  // namespace floc
