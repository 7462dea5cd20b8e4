#include "floc/planning/price_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/fitting/student_t.h"
#include "floc/scene/scene_prices.h"

namespace floc {
namespace {

/// Prices are extrapolated at most to this multiple of the measured number of grains: kExtrapolation with a table of
/// prices, kExtrapolationOfPilot with only a pilot.
constexpr int kExtrapolation = 50, kExtrapolationOfPilot = 10;

/// Returns the standard deviation between samples of `n_grains` grains, divided by the mean; NaN if the table does not
/// contain it.
double scatter_of(const PriceTable& table, const std::string& observable, int n_grains) {
  for (const PriceRow& row : table.rows)
    if (row.observable == observable && row.sample_scatter > 0.0) return row.sample_scatter;
  // Older tables contain the standard error of a mean over n samples instead.
  for (const PriceRow* row : table.find_all("samples", observable))
    if (row->mean_stderr > 0.0) return row->mean_stderr * std::sqrt(leading_number(row->value));
  // For fits, older tables contain the difference between two fits to independent sets of n samples: one set with N
  // grains per sample, the other with n0 grains. If s is the scatter between samples of n0 grains, the difference has
  // the variance s^2 (n0/N + 1)/n.
  double squares = 0.0;
  int n = 0;
  for (const PriceRow* row : table.find_all("count", observable)) {
    if (!(row->mean_stderr > 0.0) || row->n_grains <= 0) continue;
    const double ratio = static_cast<double>(n_grains) / row->n_grains;
    squares += std::pow(row->mean_stderr, 2) * row->n_samples / (ratio + 1.0);
    ++n;
  }
  return n > 0 ? std::sqrt(squares / n) : std::numeric_limits<double>::quiet_NaN();
}

/// Returns the factor c in the error c/N^q that a finite number N of grains causes; absent if the table contains only
/// one size. A value c0 of the factor is fitted by weighted least squares to the differences from the samples of
/// `n_grains` grains. The returned factor is sqrt(c0^2 + h^2), with the half width h of the 95 % interval of c0, so
/// that it includes the uncertainty of the fit.
std::optional<double> size_of_table(const PriceTable& table, const std::string& observable, int n_grains,
                                    double exponent) {
  double xx = 0.0, xy = 0.0;
  int dof = 0;
  for (const PriceRow* row : table.find_all("count", observable)) {
    if (!(row->mean_stderr > 0.0) || row->n_grains == n_grains || row->n_grains <= 0) continue;
    const double x = std::pow(row->n_grains, -exponent) - std::pow(n_grains, -exponent);
    const double weight = 1.0 / (row->mean_stderr * row->mean_stderr);
    xx += weight * x * x;
    xy += weight * x * row->mean_difference;
    dof = std::max(dof, row->n_samples - 1);
  }
  if (xx == 0.0 || dof < 1) return std::nullopt;
  return std::hypot(xy / xx, student_t_95(dof) / std::sqrt(xx));
}

/// Returns the factor ObservablePrice::of_table. It is 1 if the table does not contain the means of z_plus and z_minus.
double factor_of_table(const PriceTable& table, const std::string& observable) {
  if (observable != "z_plus" && observable != "z_minus") return 1.0;
  const auto mean = [&](const char* name) {
    const PriceRow* row = table.find("strict", "all", name);
    return row ? row->reference_value : std::numeric_limits<double>::quiet_NaN();
  };
  const double z_plus = mean("z_plus"), z_minus = mean("z_minus"),
               own = observable == "z_plus" ? z_plus : z_minus;
  return own > 0.0 && std::isfinite(z_plus + z_minus) ? (z_plus + z_minus) / own : 1.0;
}

/// Returns the model of the cost of a scene, from a table of prices or, without a table, from a pilot.
CostModel cost_of(const Scene& scene, const std::optional<PriceTable>& table,
                  const std::optional<PilotResult>& pilot) {
  return table ? CostModel(scene, *table)
               : CostModel(scene, pilot->n_grains, pilot->core_seconds, pilot->cost_exponent);
}

}  // namespace

PriceModel::PriceModel(const Scene& scene, std::optional<PriceTable> table, std::optional<PilotResult> pilot)
    : scene_(scene),
      table_(std::move(table)),
      cost_(cost_of(scene, table_, pilot)),
      settings_(cost_.settings()) {
  std::erase_if(settings_, [](const PricedSettings& s) { return s.has_loose_sweeps(); });
  if (scene.assembly.box) size_exponent_ = 1.0 / scene.dimension;
  // take_table() uses `size_exponent_` in a fit, so this exponent must be set before. take_pilot() corrects and extends
  // the numbers from the table, so the table must be read before.
  if (table_) take_table();
  if (pilot) take_pilot(*pilot);
  if (scene.grains.diameter.kind == DiameterDistribution::Kind::list)
    least_grains_ = most_grains_ = scene.grains.count;
}

void PriceModel::take_table() {
  cells_ = cell_prices(*table_, cells_of(scene_));
  const int n_grains = least_grains_ = measured_grains();
  for (const PriceRow& other : table_->rows)
    if (other.parameter == "count" && other.n_grains > 0)
      least_grains_ = std::min(least_grains_, other.n_grains);
  most_grains_ = n_grains * kExtrapolation;
  for (const std::string& name : table_->observables()) {
    const PriceRow* reference = table_->find("strict", "all", name);
    const double scatter = scatter_of(*table_, name, n_grains);
    // Without the reference row or the scatter between samples, the error of a mean is not known, so the model leaves
    // the observable out. A scatter that the table does not contain is NaN; the negated comparison is true for NaN,
    // too.
    if (reference == nullptr || !(scatter > 0.0) || reference->n_samples < 2) continue;
    ObservablePrice price{name,
                          reference->unit,
                          scatter,
                          reference->n_samples - 1,
                          size_of_table(*table_, name, n_grains, size_exponent_),
                          factor_of_table(*table_, name)};
    if (price.size) *price.size *= price.of_table;
    observables_.push_back(std::move(price));
  }
  // Where the table does not know what few grains change, small samples would seem to be as good as large ones.
  if (!knows_size_errors()) least_grains_ = std::clamp(scene_.grains.count, n_grains, most_grains_);
}

void PriceModel::take_pilot(const PilotResult& pilot) {
  if (!table_) {
    least_grains_ = pilot.n_grains;
    most_grains_ = pilot.n_grains * kExtrapolationOfPilot;
  } else {
    const bool has_more_grains = pilot.largest_grains > measured_grains();
    cost_.correct(pilot.n_grains, pilot.core_seconds,
                  has_more_grains ? std::optional(pilot.cost_exponent) : std::nullopt);
  }
  for (const ObservablePrice& measured : pilot.observables) {
    // The scatter is proportional to N^(-1/2) for N grains. The scatter of the pilot is converted to the number of
    // grains of the model before two scatters are pooled.
    ObservablePrice scaled = measured;
    scaled.scatter *= std::sqrt(static_cast<double>(pilot.n_grains) / measured_grains());
    const auto known = std::find_if(observables_.begin(), observables_.end(),
                                    [&](const ObservablePrice& o) { return o.name == measured.name; });
    if (known != observables_.end()) {
      // The pooled variance of the scatters s1 and s2 with n1 and n2 degrees of freedom is (n1 s1^2 + n2 s2^2)/(n1 +
      // n2).
      const double squares =
          known->dof * std::pow(known->scatter, 2) + scaled.dof * std::pow(scaled.scatter, 2);
      known->dof += scaled.dof;
      known->scatter = std::sqrt(squares / known->dof);
    } else {
      observables_.push_back(scaled);
    }
  }
}

void PriceModel::remove_settings(const std::function<bool(const PricedSettings&)>& is_wrong) {
  std::erase_if(settings_, [&](const PricedSettings& s) { return s.parameter != "scene" && is_wrong(s); });
}

const ObservablePrice& PriceModel::observable(const std::string& name, const std::string& place) const {
  std::vector<std::string> names;
  for (const ObservablePrice& o : observables_) {
    if (o.name == name) return o;
    names.push_back(o.name);
  }
  throw InputError(
      place,
      fmt::format("{} is not a quantity of this scene that {} contains: expected one of {}; the nearest is {}",
                  name, table_ ? "the " + table_->name() : "the pilot", fmt::join(names, ", "),
                  nearest_name(name, names)));
}

bool PriceModel::knows_size_errors() const {
  return std::ranges::any_of(observables_, [](const ObservablePrice& o) { return o.size.has_value(); });
}

double PriceModel::size_error(const ObservablePrice& observable, double n_grains) const {
  return observable.size ? *observable.size * std::pow(n_grains, -size_exponent_) : 0.0;
}

PricedError PriceModel::error(const ObservablePrice& observable, const PricedSettings& settings,
                              double n_grains, double n_samples) const {
  PricedError error;
  if (table_) {
    error.settings = settings_error(settings, observable.name);
    for (const PricedSettings& cell : cells_) error.settings += settings_error(cell, observable.name);
    error.settings *= observable.of_table;
    if (std::isnan(error.settings)) error.settings = std::numeric_limits<double>::infinity();
  }
  error.size = size_error(observable, n_grains);
  error.scatter =
      student_t_95(observable.dof) * observable.scatter * std::sqrt(measured_grains() / (n_grains * n_samples));
  return error;
}

double PriceModel::unknown_difference(const ObservablePrice& observable, const PricedSettings& settings) const {
  const auto row = settings.of.find(observable.name);
  return row == settings.of.end() ? std::numeric_limits<double>::quiet_NaN()
                                  : row->second->mean_error * observable.of_table;
}

}  // namespace floc
