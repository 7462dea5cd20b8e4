#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floc/prices/accuracy.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/scene.h"

namespace floc {

/// Parts of the error of a mean over states and samples, or of a fit to a path. All parts are half widths of 95 %
/// intervals divided by the mean.
struct PricedError {
  double settings = 0.0;  ///< error that the numerical settings cause, if the table of prices contains it
  double size = 0.0;      ///< error that the finite number of grains causes
  double scatter = 0.0;   ///< error that the scatter between samples causes

  double total() const { return settings + size + scatter; }
};

/// Properties of one observable, from a table of prices or from a pilot: the scatter between samples, and the effect of
/// the finite number of grains.
struct ObservablePrice {
  std::string name;
  std::string unit;  ///< unit of the observable; empty if it is not known
  /// Standard deviation between samples of `n_grains` grains, divided by the mean, and number of degrees of freedom of
  /// this standard deviation.
  double scatter;
  int dof;
  /// Factor c in the error c/N^q that the finite number N of grains causes. The exponent q depends on the boundary
  /// (PriceModel). Absent if the table contains only one size.
  std::optional<double> size;
  /// Factor by which an error in the table is multiplied to be relative to the mean of the observable. It differs from
  /// 1 for z_plus and z_minus, whose errors in tables are relative to their sum.
  double of_table = 1.0;
};

/// Measurements on samples of a scene, returned by run_pilot().
struct PilotResult {
  int n_grains = 0;      ///< number of grains of a sample
  int n_samples = 0;     ///< number of samples with this number of grains
  double core_seconds;   ///< processor time of a sample (s)
  double cost_exponent;  ///< exponent p: the processor time is proportional to N^p for N grains
  std::vector<ObservablePrice> observables;
  int largest_grains = 0;  ///< number of grains of the largest sample that determines the exponent
};

/// Model of the cost and the errors of runs of a scene, as functions of the number of grains, the number of samples and
/// the settings. It extrapolates from a table of prices, from a pilot, or from both. If both are given, the processor
/// time comes from the pilot, and the dependence of the processor time on the settings from the table. The dependence
/// of the processor time on the number of grains comes from the source with the larger samples. The scatters from both
/// sources are pooled.
///
/// 1. CostModel gives the processor time and the memory of a sample.
/// 2. The scatter s between samples is proportional to N^(-1/2). The error of a mean over n samples is t s/sqrt(n) with
/// Student's factor t.
/// 3. A finite number N of grains changes a mean in proportion to the fraction of grains that the boundary disturbs:
/// 1/N in a periodic cell, and N^(-1/d) between walls in d dimensions.
class PriceModel {
 public:
  /// @param table  table of prices of the kind of the scene; absent if only a pilot is known
  /// @param pilot  measurements on the scene; absent if only a table is known. At least one of `table` and `pilot` must
  /// be given.
  PriceModel(const Scene& scene, std::optional<PriceTable> table, std::optional<PilotResult> pilot = {});

  /// Numerical settings that can be written into the scene, without those with loose sweeps
  /// (PricedSettings::has_loose_sweeps()). The settings refer to rows of the table of this model.
  const std::vector<PricedSettings>& settings() const { return settings_; }
  const std::vector<ObservablePrice>& observables() const { return observables_; }
  /// Returns the observable with this name.
  /// @throws InputError that names the most similar observable, if the model has no observable with this name
  const ObservablePrice& observable(const std::string& name, const std::string& place) const;

  /// Removes settings from the model, so that no plan uses them. The settings of the row "scene" are always kept.
  /// @param is_wrong  function that returns whether settings are removed
  void remove_settings(const std::function<bool(const PricedSettings&)>& is_wrong);

  int measured_grains() const { return cost_.measured_grains(); }
  /// Smallest and largest number of grains for which the model is used. If the scene lists the diameters of its grains,
  /// both are the number of grains of the scene. Otherwise the smallest is the smallest measured number, and the
  /// largest is fifty times the measured number (ten times if there is only a pilot).
  int least_grains() const { return least_grains_; }
  int most_grains() const { return most_grains_; }
  bool knows_settings() const { return table_.has_value(); }
  /// Returns whether the error that a finite number of grains causes is known for any observable. If it is not, plans
  /// have at least as many grains as the scene.
  bool knows_size_errors() const;

  /// See the functions of CostModel.
  double core_seconds(const PricedSettings& settings, double n_grains) const {
    return cost_.core_seconds(settings, n_grains);
  }
  double memory_mb(double n_grains) const { return cost_.memory_mb(n_grains); }
  PricedSettings settings_of_scene() const { return cost_.settings_of_scene(); }
  /// Returns the error of an observable; infinite if the table does not contain the error that the settings cause.
  PricedError error(const ObservablePrice& observable, const PricedSettings& settings, double n_grains,
                    double n_samples) const;
  /// Returns the half width of the 95 % interval of the difference, in the table, between the mean of an observable
  /// with these settings and with the strictest settings, divided by the mean; NaN if it was not measured. The
  /// table cannot tell whether the settings keep a smaller error.
  double unknown_difference(const ObservablePrice& observable, const PricedSettings& settings) const;

 private:
  void take_table();
  void take_pilot(const PilotResult& pilot);
  double size_error(const ObservablePrice& observable, double n_grains) const;

  const Scene& scene_;
  std::optional<PriceTable> table_;
  CostModel cost_;
  std::vector<PricedSettings> settings_, cells_;
  std::vector<ObservablePrice> observables_;
  int least_grains_ = 0, most_grains_ = 0;
  double size_exponent_ = 1.0;
};

}  // namespace floc
