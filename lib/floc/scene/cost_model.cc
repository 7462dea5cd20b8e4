#include "floc/scene/cost_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "floc/base/error.h"
#include "floc/loading/run_plan.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/scene_prices.h"
#include "floc/scene/scene_softening.h"

namespace floc {
namespace {

/// Exponent p of the processor time, which is proportional to N^p for N grains. This value is used if a table of prices
/// contains only one size. The exponent is above 1 because larger packings need more time steps to come to rest.
constexpr double kCostExponent = 1.25;
/// Smallest exponents that are taken from a table, for elastic grains, for elastic spheres (Hertz) and for rigid grains.
/// Tables have small samples, which do not show how the time grows in larger ones. From 1000 to 4000 glass beads
/// (spheres_a), the mean number of time steps grows from 283 000 to 709 000, which makes an exponent of 1.66; from the
/// 200 beads of the table, 1.35 gives the time of 4000 within a factor of 1.4. Samples of cohesionless_cycle with 150
/// and 1200 disks took 1.06 and 10.1 s (exponent 1.08), of biaxial_dense with 150 and 600 disks 6.8 and 34.8 s (1.18).
/// Samples of rigid_disks_demo with 80, 320 and 640 disks took 0.39, 1.39 and 6.0 s, and of polyhedra_demo with 30 and
/// 300 grains 0.53 and 21.5 s.
constexpr double kLeastOfElasticGrains = 1.1, kLeastOfBeads = 1.35, kLeastOfRigidGrains = 1.4;
/// Fraction of the processor time of a run that is proportional to its number of equilibria. This value is used if a
/// table of prices does not contain the fraction. The fraction is small because most of the time is spent in the
/// assembly and in rearrangements; the number of rearrangements depends on the range of the load, not on the number of
/// equilibria. The value was measured on 200 cohesive disks: a load path took 1.6 s with 16 states, and 2.3 s with 40
/// states. kShareOfStrainSteps applies to tests that impose strains: a test of 150 disks took 0.71 s with 21 states and
/// 5.99 s with 251 states at the same final strain.
constexpr double kShareOfSteps = 0.3, kShareOfStrainSteps = 0.68;
/// Shares of the processor time of a run. kShareOfSoft: time that is proportional to the number of time steps; used if
/// a table has no rows of softening or of masses. kShareOfAssembly: time before the first pressure of the load path is
/// reached. Both were measured on 1400 cohesive disks: 0.57 of the time steps were made before the first pressure was
/// reached. Springs softer by a factor of 5 reduced the time to 0.6 of the time with full stiffness, and springs softer
/// by a factor of 10 reduced it to 0.57.
constexpr double kShareOfSoft = 0.7, kShareOfAssembly = 0.57;
/// Memory (MB) of the program itself, and memory (MB) per grain in two and in three dimensions. The values apply to
/// runs that complete equilibria by Newton's method.
constexpr double kProgramMemory = 36.0;
constexpr double kMemoryOfDisk = 0.006, kMemoryOfSphere = 0.03;

/// Returns the slope of the least-squares line through points (x, y).
double slope_of(const std::vector<std::pair<double, double>>& points) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const auto& [x, y] : points) sx += x, sy += y, sxx += x * x, sxy += x * y;
  const auto n = static_cast<double>(points.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Returns the exponent p in the processor time of a sample of N grains, which is proportional to N^p. The exponent is
/// fitted to samples of several sizes.
double exponent_of(const PriceTable& table, const PriceRow& as_it_is, const Law& law) {
  std::vector<std::pair<double, double>> points;
  const auto add = [&](const PriceRow& row) {
    if (row.n_grains > 0 && row.core_seconds > 0.0)
      points.emplace_back(std::log(row.n_grains), std::log(row.core_seconds));
  };
  add(as_it_is);
  for (const PriceRow* row : table.find_all("count", as_it_is.observable)) add(*row);
  const double least = law.is_rigid()                ? kLeastOfRigidGrains
                       : law.force_exponent() != 1.0 ? kLeastOfBeads
                                                     : kLeastOfElasticGrains;
  return points.size() < 2 ? std::max(kCostExponent, least) : std::clamp(slope_of(points), least, 2.0);
}

/// Returns the fraction of the processor time that is proportional to the number of equilibria, from samples with
/// several numbers of steps per decade.
/// @param unknown  result if the table has no such samples
double share_of_steps(const PriceTable& table, const PriceRow& as_it_is, double unknown) {
  std::vector<std::pair<double, double>> points = {{1.0, 1.0}};
  for (const PriceRow* row : table.find_all("steps_per_decade", as_it_is.observable))
    if (const double factor = leading_number(row->value); factor > 0.0 && row->core_seconds > 0.0)
      points.emplace_back(factor, row->core_seconds / as_it_is.core_seconds);
  return points.size() < 2 ? unknown : std::clamp(slope_of(points), 0.0, 1.0);
}

/// Interpolates linearly between points (x, y) in ascending order of x. Beyond the first and the last point, returns
/// the y of this point.
double interpolated(const std::vector<std::pair<double, double>>& points, double x) {
  if (x <= points.front().first) return points.front().second;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (x <= points[k].first)
      return std::lerp(points[k - 1].second, points[k].second,
                       (x - points[k - 1].first) / (points[k].first - points[k - 1].first));
  return points.back().second;
}

int number_of_states(const Scene& scene) {
  return static_cast<int>(plan_run(scene.assembly, scene.law, scene.load, scene.dimension).size());
}

/// Returns the first row of a table for the settings of its scene.
/// @throws InputError if there is none, or if it lacks the number of grains or the processor time
const PriceRow& row_of_scene(const PriceTable& table) {
  const auto row = std::ranges::find(table.rows, "scene", &PriceRow::parameter);
  if (row == table.rows.end() || row->n_grains <= 0 || !(row->core_seconds > 0.0))
    throw InputError(table.place,
                     "this table has no row with \"scene\" in the column knob, or this row lacks n_grains or "
                     "core_seconds: "
                     "expected a table that floc tradeoff --format csv of this version of floc has written");
  return *row;
}

/// Returns the memory of a run (MB), divided by the number of grains.
double least_memory_of_grain(const Scene& scene) {
  return scene.dimension == 2 ? kMemoryOfDisk : kMemoryOfSphere;
}

}  // namespace

CostModel::CostModel(const Scene& scene, const PriceTable& table)
    : scene_(scene), settings_(settable_prices(table)), memory_of_grain_(least_memory_of_grain(scene)) {
  const PriceRow& row = row_of_scene(table);
  n_grains_ = row.n_grains;
  for (const PriceRow& other : table.rows)
    if (other.parameter == "scene" && other.memory_mb > 0.0 && other.n_grains > 0)
      memory_of_grain_ = std::max(memory_of_grain_, other.memory_mb / other.n_grains);
  exponent_ = exponent_of(table, row, scene.law);
  // The time of this scene, divided by the time of the scene of the table, is 1 - b + b n/n0. Here n and n0 are the
  // numbers of equilibria of the two scenes, and b is the share of the time that is proportional to this number.
  if (row.n_states > 0) {
    const double share = share_of_steps(
        table, row, std::ranges::count(strained_stages(scene), true) > 0 ? kShareOfStrainSteps : kShareOfSteps);
    factor_ = 1.0 - share + share * number_of_states(scene) / row.n_states;
  }
  // Stiffer contacts need shorter time steps: the step is proportional to the inverse root of the stiffness.
  if (const auto kappa = stiffness_number(scene); kappa && row.kappa > 0.0)
    factor_ *= std::sqrt(*kappa / row.kappa);
}

CostModel::CostModel(const Scene& scene, int n_grains, double core_seconds, double exponent)
    : scene_(scene), n_grains_(n_grains), memory_of_grain_(least_memory_of_grain(scene)), exponent_(exponent) {
  PricedSettings as_it_is;
  as_it_is.parameter = "scene";
  as_it_is.value = "as it is";
  as_it_is.settings = settings_of(scene);
  as_it_is.cost_ratio = 1.0;
  as_it_is.core_seconds = core_seconds;
  settings_ = {as_it_is};
}

void CostModel::correct(int n_grains, double core_seconds, std::optional<double> exponent) {
  // The exponent is set first, because CostModel::core_seconds() uses it to convert the time of the table to this
  // number of grains.
  exponent_ = exponent.value_or(exponent_);
  factor_ *= core_seconds / this->core_seconds(settings_of_scene(), n_grains);
}

double CostModel::core_seconds(const PricedSettings& settings, double n_grains) const {
  return settings.core_seconds * factor_ * std::pow(n_grains / n_grains_, exponent_);
}

double CostModel::memory_mb(double n_grains) const {
  return kProgramMemory + memory_of_grain_ * n_grains;
}

/// Returns the processor time of a run with softer springs, divided by the time without softening. The ratio is
/// interpolated between the rows of softening in the table, separately for the assembly and for the load path. The
/// assembly takes a fixed share of the time.
/// @param plain  settings of the scene of the table
double CostModel::time_with_softening(const PricedSettings& plain, const Softening& softening) const {
  std::vector<std::pair<double, double>> measured = {{0.0, 0.0}};
  for (const PricedSettings& row : settings_)
    if (row.parameter == "softening")
      measured.emplace_back(std::log(row.settings.softening.load),
                            std::log(row.core_seconds / plain.core_seconds));
  std::ranges::sort(measured);
  const auto time = [&](double factor) {
    if (measured.size() > 1) return std::exp(interpolated(measured, std::log(factor)));
    return 1.0 - kShareOfSoft + kShareOfSoft * std::pow(factor, -0.5 / scene_.law.force_exponent());
  };
  return kShareOfAssembly * time(softening.assembly) + (1.0 - kShareOfAssembly) * time(softening.load);
}

/// Returns the processor time of a run, divided by the time if no part of the run had its own time step. The assembly
/// takes a fixed share of the time, and the stages of the load path take equal parts of the rest.
double CostModel::time_with_steps_of_parts() const {
  const auto time = [&](const CellResponse& cell) {
    return scene_.relaxation.time_step / cell.applied_to(scene_.relaxation).time_step;
  };
  const double assembly = time(scene_.assembly.cell);
  if (scene_.load.empty()) return assembly;
  double load = 0.0;
  for (const LoadStage& stage : scene_.load) load += time(stage.cell);
  return kShareOfAssembly * assembly +
         (1.0 - kShareOfAssembly) * load / static_cast<double>(scene_.load.size());
}

/// Returns the processor time of a run in which grains move with equal masses, divided by the time with their own
/// masses. The time step is proportional to the root of the smallest mass.
/// @param plain  settings of the scene of the table
double CostModel::time_with_equal_masses(const PricedSettings& plain) const {
  const auto row = std::ranges::find(settings_, "masses", &PricedSettings::parameter);
  if (row != settings_.end() && !plain.settings.equal_masses) return row->core_seconds / plain.core_seconds;
  const double ratio = scene_.grains.smallest() / scene_.grains.largest();
  return 1.0 - kShareOfSoft + kShareOfSoft * std::pow(ratio, 0.5 * scene_.dimension);
}

/// Returns the processor time with a value of a parameter, divided by the time with the settings `plain`. The ratio is
/// interpolated by power laws between the rows of the table; it is 1 if the table has no such rows.
/// @param value_of_table  value of the parameter in the settings `plain`; absent if it is not known
double CostModel::time_ratio(const PricedSettings& plain, const std::string& parameter, double value,
                             std::optional<double> value_of_table) const {
  std::vector<std::pair<double, double>> measured;
  if (value_of_table) measured.emplace_back(std::log(*value_of_table), 0.0);
  for (const PricedSettings& row : settings_)
    if (const double x = leading_number(row.value); row.parameter == parameter && x > 0.0)
      measured.emplace_back(std::log(x), std::log(row.core_seconds / plain.core_seconds));
  std::ranges::sort(measured);
  return measured.empty() ? 1.0 : std::exp(interpolated(measured, std::log(value)));
}

/// Converts the processor time of the settings `plain` to the settings of contact dynamics of the scene. If several of
/// them differ from those of the table, their ratios are multiplied.
PricedSettings CostModel::settings_of_rigid_grains(PricedSettings plain) const {
  const ContactDynamicsOptions& own = scene_.relaxation.contact_dynamics;
  double ratio =
      time_ratio(plain, "time_step", own.time_step, plain.settings.time_step) *
      time_ratio(plain, "sweep_tolerance", own.sweep_tolerance, ContactDynamicsOptions{}.sweep_tolerance);
  // The default of the gap tolerance depends on the shapes of the grains; the settings `plain` have this default.
  if (own.gap_tolerance) ratio *= time_ratio(plain, "gap_tolerance", *own.gap_tolerance, std::nullopt);
  const std::string forces = kRigidForcesKeywords[static_cast<std::size_t>(own.forces)];
  for (const PricedSettings& row : settings_)
    if (row.parameter == "finish" && row.value == forces) ratio *= row.core_seconds / plain.core_seconds;
  plain.core_seconds *= ratio;
  return plain;
}

PricedSettings CostModel::settings_of_scene() const {
  const PricedSettings& plain = *std::ranges::find(settings_, "scene", &PricedSettings::parameter);
  if (scene_.law.is_rigid()) return settings_of_rigid_grains(plain);
  const NumericalSettings own = settings_of(scene_);
  for (const PricedSettings& settings : settings_)
    if (!settings.is_reference() && settings.settings == own) {
      PricedSettings found = settings;
      found.core_seconds *= time_with_steps_of_parts();
      return found;
    }
  PricedSettings converted = plain;
  converted.core_seconds *= plain.settings.time_step / own.time_step;
  converted.core_seconds *=
      time_with_softening(plain, own.softening) / time_with_softening(plain, plain.settings.softening);
  converted.core_seconds *= time_with_steps_of_parts();
  if (own.equal_masses != plain.settings.equal_masses)
    converted.core_seconds *=
        own.equal_masses ? time_with_equal_masses(plain) : 1.0 / time_with_equal_masses(plain);
  return converted;
}

RunCost cost_of_run(const Scene& scene, const std::string& prices) {
  const RunCost rough{expected_cost(scene), std::nullopt};
  if (scene.starts_from_state()) return rough;
  ScenePrices found;
  try {
    found = prices_of(scene, prices);
  } catch (const InputError&) {
    // The tables may not be installed beside the library; a table that the user names must be valid.
    if (!prices.empty()) throw;
    return rough;
  }
  if (!found.table && !prices.empty()) throw InputError(prices, found.problem);
  if (!found.table) return rough;
  const CostModel model(scene, *found.table);
  const double n = scene.grains.count;
  return {model.core_seconds(model.settings_of_scene(), n), model.memory_mb(n)};
}

}  // namespace floc
