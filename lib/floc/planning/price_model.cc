#include "floc/planning/price_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/base/parse_number.h"
#include "floc/fitting/student_t.h"
#include "floc/loading/run_plan.h"
#include "floc/scene/scene_prices.h"
#include "floc/scene/scene_softening.h"

namespace floc {
namespace {

/// Exponent p of the processor time, which is proportional to N^p for N grains. This value is used if a table of prices
/// contains only one size. The exponent is above 1 because larger packings need more time steps to come to rest.
constexpr double kCostExponent = 1.25;
/// Smallest exponents that are taken from a table, for elastic and for rigid grains. Tables have small samples, which
/// do not show how the time grows in larger ones. Samples of cohesionless_cycle with 150 and 1200 disks took 1.06 and
/// 10.1 s (exponent 1.08), of biaxial_dense with 150 and 600 disks 6.8 and 34.8 s (1.18), of rigid_disks_demo with 80,
/// 320 and 640 disks 0.39, 1.39 and 6.0 s, and of polyhedra_demo with 30 and 300 grains 0.53 and 21.5 s.
constexpr double kLeastOfElasticGrains = 1.1, kLeastOfRigidGrains = 1.4;
/// Fraction of the processor time of a run that is proportional to its number of equilibria. This value is used if a
/// table of prices does not contain the fraction. The fraction is small because most of the time is spent in the
/// assembly and in rearrangements; the number of rearrangements depends on the range of the load, not on the number of
/// equilibria. The value was measured on 200 cohesive disks: a load path took 1.6 s with 16 states, and 2.3 s with 40
/// states. kShareOfStrainSteps applies to tests that impose strains: a test of 150 disks took 0.71 s with 21 states and
/// 5.99 s with 251 states at the same final strain.
constexpr double kShareOfSteps = 0.3, kShareOfStrainSteps = 0.68;
/// Shares of the processor time of a run. kShareOfSoft: time during which springs may be soft; used if a table has no
/// rows of softening. kShareOfAssembly: time before the first pressure of the load path is reached. Both were measured
/// on 1400 cohesive disks: 0.57 of the time steps were made before the first pressure was reached. Springs softer by a
/// factor of 5 reduced the time to 0.6 of the time with full stiffness, and springs softer by a factor of 10 reduced it
/// to 0.57.
constexpr double kShareOfSoft = 0.7, kShareOfAssembly = 0.57;
/// Prices are extrapolated at most to this multiple of the measured number of grains: kExtrapolation with a table of
/// prices, kExtrapolationOfPilot with only a pilot.
constexpr int kExtrapolation = 50, kExtrapolationOfPilot = 10;
/// Memory (MB) of the program itself, and memory (MB) per grain in two and in three dimensions. The values apply to
/// runs that complete equilibria by Newton's method.
constexpr double kProgramMemory = 36.0;
constexpr double kMemoryOfDisk = 0.006, kMemoryOfSphere = 0.03;

double number_or_nan(const std::string& text) {
  return parse_number<double>(text.substr(0, text.find(' ')))
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Returns the rows of a table for one observable and one parameter.
std::vector<const PriceRow*> rows_of(const PriceTable& table, const std::string& parameter,
                                     const std::string& observable) {
  std::vector<const PriceRow*> found;
  for (const PriceRow& row : table.rows)
    if (row.parameter == parameter && row.observable == observable) found.push_back(&row);
  return found;
}

/// Returns the standard deviation between samples of `n_grains` grains, divided by the mean; NaN if the table does not
/// contain it.
double scatter_of(const PriceTable& table, const std::string& observable, int n_grains) {
  for (const PriceRow& row : table.rows)
    if (row.observable == observable && row.sample_scatter > 0.0) return row.sample_scatter;
  // Older tables contain the standard error of a mean over n samples instead.
  for (const PriceRow* row : rows_of(table, "samples", observable))
    if (row->mean_stderr > 0.0) return row->mean_stderr * std::sqrt(number_or_nan(row->value));
  // For fits, older tables contain the difference between two fits to independent sets of n samples: one set with N
  // grains per sample, the other with n0 grains. If s is the scatter between samples of n0 grains, the difference has
  // the variance s^2 (n0/N + 1)/n.
  double squares = 0.0;
  int n = 0;
  for (const PriceRow* row : rows_of(table, "count", observable)) {
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
  for (const PriceRow* row : rows_of(table, "count", observable)) {
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

/// Returns the slope of the least-squares line through points (x, y).
double slope_of(const std::vector<std::pair<double, double>>& points) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const auto& [x, y] : points) sx += x, sy += y, sxx += x * x, sxy += x * y;
  const auto n = static_cast<double>(points.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Returns the exponent p in the processor time of a sample of N grains, which is proportional to N^p. The exponent is
/// fitted to samples of several sizes.
/// @param is_rigid  whether the contacts are rigid
double exponent_of(const PriceTable& table, const PriceRow& as_it_is, bool is_rigid) {
  std::vector<std::pair<double, double>> points;
  const auto add = [&](const PriceRow& row) {
    if (row.n_grains > 0 && row.core_seconds > 0.0)
      points.emplace_back(std::log(row.n_grains), std::log(row.core_seconds));
  };
  add(as_it_is);
  for (const PriceRow* row : rows_of(table, "count", as_it_is.observable)) add(*row);
  const double least = is_rigid ? kLeastOfRigidGrains : kLeastOfElasticGrains;
  return points.size() < 2 ? std::max(kCostExponent, least) : std::clamp(slope_of(points), least, 2.0);
}

/// Returns the fraction of the processor time that is proportional to the number of equilibria, from samples with
/// several numbers of steps per decade.
/// @param unknown  result if the table has no such samples
double share_of_steps(const PriceTable& table, const PriceRow& as_it_is, double unknown) {
  std::vector<std::pair<double, double>> points = {{1.0, 1.0}};
  for (const PriceRow* row : rows_of(table, "steps_per_decade", as_it_is.observable))
    if (const double factor = number_or_nan(row->value); factor > 0.0 && row->core_seconds > 0.0)
      points.emplace_back(factor, row->core_seconds / as_it_is.core_seconds);
  return points.size() < 2 ? unknown : std::clamp(slope_of(points), 0.0, 1.0);
}

/// Interpolates linearly between points (x, y) in ascending order of x. Beyond the last point, returns the y of the
/// last point.
double interpolated(const std::vector<std::pair<double, double>>& points, double x) {
  for (std::size_t k = 1; k < points.size(); ++k)
    if (x <= points[k].first)
      return std::lerp(points[k - 1].second, points[k].second,
                       (x - points[k - 1].first) / (points[k].first - points[k - 1].first));
  return points.back().second;
}

int number_of_states(const Scene& scene) {
  return static_cast<int>(plan_run(scene.assembly, scene.law, scene.load, scene.dimension).size());
}

}  // namespace

PriceModel::PriceModel(const Scene& scene, std::optional<PriceTable> table, std::optional<PilotResult> pilot)
    : scene_(scene), table_(std::move(table)) {
  if (scene.assembly.box) size_exponent_ = 1.0 / scene.dimension;
  // take_table() uses `size_exponent_` in a fit, so this exponent must be set before. take_pilot() corrects and extends
  // the numbers from the table, so the table must be read before.
  if (table_) take_table();
  if (pilot) take_pilot(*pilot);
  if (scene.grains.diameter.kind == DiameterDistribution::Kind::list)
    least_grains_ = most_grains_ = scene.grains.count;
}

void PriceModel::take_table() {
  settings_ = settable_prices(*table_);
  cells_ = cell_prices(*table_, cells_of(scene_));
  const auto row = std::find_if(table_->rows.begin(), table_->rows.end(),
                                [](const PriceRow& r) { return r.parameter == "scene"; });
  if (row == table_->rows.end() || row->n_grains <= 0 || !(row->core_seconds > 0.0))
    throw InputError(table_->place,
                     "this table has no row with \"scene\" in the column knob, or this row lacks n_grains or "
                     "core_seconds: "
                     "expected a table that floc tradeoff --format csv of this version of floc has written");
  n_grains_ = least_grains_ = row->n_grains;
  for (const PriceRow& other : table_->rows)
    if (other.parameter == "count" && other.n_grains > 0)
      least_grains_ = std::min(least_grains_, other.n_grains);
  most_grains_ = n_grains_ * kExtrapolation;
  cost_exponent_ = exponent_of(*table_, *row, scene_.law.is_rigid());
  // The time of this scene, divided by the time of the scene of the table, is 1 - b + b n/n0. Here n and n0 are the
  // numbers of equilibria of the two scenes, and b is the share of the time that is proportional to this number.
  if (row->n_states > 0) {
    const double share = share_of_steps(
        *table_, *row,
        std::ranges::count(strained_stages(scene_), true) > 0 ? kShareOfStrainSteps : kShareOfSteps);
    cost_factor_ = 1.0 - share + share * number_of_states(scene_) / row->n_states;
  }
  // Stiffer contacts need shorter time steps: the step is proportional to the inverse root of the stiffness.
  if (const auto kappa = stiffness_number(scene_); kappa && row->kappa > 0.0)
    cost_factor_ *= std::sqrt(*kappa / row->kappa);
  for (const std::string& name : table_->observables()) {
    const PriceRow* reference = table_->find("strict", "all", name);
    const double scatter = scatter_of(*table_, name, n_grains_);
    // Without the reference row or the scatter between samples, the error of a mean is not known, so the model leaves
    // the observable out. A scatter that the table does not contain is NaN; the negated comparison is true for NaN,
    // too.
    if (reference == nullptr || !(scatter > 0.0) || reference->n_samples < 2) continue;
    ObservablePrice price{name,
                          reference->unit,
                          scatter,
                          reference->n_samples - 1,
                          size_of_table(*table_, name, n_grains_, size_exponent_),
                          factor_of_table(*table_, name)};
    if (price.size) *price.size *= price.of_table;
    observables_.push_back(std::move(price));
  }
  // Where the table does not know what few grains change, small samples would seem to be as good as large ones.
  if (!knows_size_errors()) least_grains_ = std::clamp(scene_.grains.count, n_grains_, most_grains_);
}

void PriceModel::take_pilot(const PilotResult& pilot) {
  if (!table_) {
    PricedSettings as_it_is;
    as_it_is.parameter = "scene";
    as_it_is.value = "as it is";
    as_it_is.settings = settings_of(scene_);
    as_it_is.cost_ratio = 1.0;
    as_it_is.core_seconds = pilot.core_seconds;
    settings_ = {as_it_is};
    n_grains_ = least_grains_ = pilot.n_grains;
    most_grains_ = n_grains_ * kExtrapolationOfPilot;
    cost_exponent_ = pilot.cost_exponent;
  } else {
    // After this factor is applied, core_seconds() returns the measured time for the number of grains of the pilot. The
    // exponent is set first, because core_seconds() uses the exponent to convert the time of the table to this number
    // of grains.
    if (pilot.largest_grains > n_grains_) cost_exponent_ = pilot.cost_exponent;
    cost_factor_ *= pilot.core_seconds / core_seconds(settings_of_scene(), pilot.n_grains);
  }
  for (const ObservablePrice& measured : pilot.observables) {
    // The scatter is proportional to N^(-1/2) for N grains. The scatter of the pilot is converted to the number of
    // grains of the model before two scatters are pooled.
    ObservablePrice scaled = measured;
    scaled.scatter *= std::sqrt(static_cast<double>(pilot.n_grains) / n_grains_);
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

double PriceModel::core_seconds(const PricedSettings& settings, double n_grains) const {
  return settings.core_seconds * cost_factor_ * std::pow(n_grains / n_grains_, cost_exponent_);
}

double PriceModel::memory_mb(double n_grains) const {
  double of_grain = scene_.dimension == 2 ? kMemoryOfDisk : kMemoryOfSphere;
  if (table_)
    for (const PriceRow& row : table_->rows)
      if (row.parameter == "scene" && row.memory_mb > 0.0 && row.n_grains > 0)
        of_grain = std::max(of_grain, row.memory_mb / row.n_grains);
  return kProgramMemory + of_grain * n_grains;
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
      student_t_95(observable.dof) * observable.scatter * std::sqrt(n_grains_ / (n_grains * n_samples));
  return error;
}

double PriceModel::time_with_softening(const Softening& softening) const {
  std::vector<std::pair<double, double>> measured = {{0.0, 0.0}};
  const auto scene_row = std::ranges::find(settings_, "scene", &PricedSettings::parameter);
  for (const PricedSettings& row : settings_)
    if (row.parameter == "softening" && scene_row != settings_.end())
      measured.emplace_back(std::log(row.settings.softening.load),
                            std::log(row.core_seconds / scene_row->core_seconds));
  std::ranges::sort(measured);
  const auto time = [&](double factor) {
    if (measured.size() > 1) return std::exp(interpolated(measured, std::log(factor)));
    return 1.0 - kShareOfSoft + kShareOfSoft * std::pow(factor, -0.5 / scene_.law.force_exponent());
  };
  return kShareOfAssembly * time(softening.assembly) + (1.0 - kShareOfAssembly) * time(softening.load);
}

PricedSettings PriceModel::settings_of_scene() const {
  const NumericalSettings own = settings_of(scene_);
  for (const PricedSettings& settings : settings_)
    if (!settings.is_reference() && settings.settings == own) return settings;
  PricedSettings scaled = *std::find_if(settings_.begin(), settings_.end(),
                                        [](const PricedSettings& s) { return s.parameter == "scene"; });
  if (!scene_.law.is_rigid()) scaled.core_seconds *= scaled.settings.time_step / own.time_step;
  scaled.core_seconds *= time_with_softening(own.softening) / time_with_softening(scaled.settings.softening);
  return scaled;
}

ExpectedPrice expected_price(const PriceModel& model, const Scene& scene) {
  const double n = scene.grains.count;
  return {model.core_seconds(model.settings_of_scene(), n), model.memory_mb(n)};
}

}  // namespace floc
