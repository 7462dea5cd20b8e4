#include "plots/state_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "commands/plot_command.h"
#include "floc/base/error.h"
#include "floc/fitting/cut_exponential.h"
#include "floc/fitting/force_distribution.h"
#include "floc/fitting/scattering_fit.h"
#include "floc/network/rattlers.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/picture/drawn_scale.h"
#include "floc/structure/particle_stress.h"
#include "floc/structure/scattering.h"

namespace floc {
namespace {

/// Colours and markers of the samples. Both are easy to distinguish, the markers also if they are printed in grey. The
/// seventh sample has the first colour and marker again.
constexpr const char* kSampleStyles =
    "array color[6] = ['#0072b2', '#d55e00', '#00b377', '#202020', '#cc79a7', '#e69f00']\n"
    "array marker[6] = [7, 8, 4, 12, 10, 2]\n";
constexpr int kDrawsForNoPValue = 1;

/// Returns a bin width for a histogram, chosen so that about twenty bins contain nine tenths of the forces.
double bin_width(std::vector<double> forces) {
  const auto quantile = [&forces](double share) {
    const auto at =
        forces.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(forces.size() - 1));
    std::nth_element(forces.begin(), at, forces.end());
    return *at;
  };
  const double range = quantile(0.95) - quantile(0.05);
  return range > 0.0 ? round_number_below(range / 20.0) : 0.1;
}

/// Fits an exponential tail to the forces f of one sign that exceed a threshold: the mean of the forces of this sign.
/// Adds points of the fitted tail from the threshold to the largest force. The density of the tail is a product of two
/// factors: the fraction of all forces that belong to the tail, and exp[-(f - threshold)/f_0]/f_0 with the fitted force
/// f_0.
void add_tail(const std::vector<double>& forces, double sign, std::vector<std::vector<double>>& rows) {
  std::vector<double> sizes;
  double sum = 0.0;
  for (const double f : forces)
    if (sign * f > 0.0) sizes.push_back(sign * f), sum += sign * f;
  if (sizes.empty()) return;
  ForceFitOptions options;
  options.n_draws = kDrawsForNoPValue;
  const ForceFit fit = fit_exponential_tail("tail", sizes, sum / static_cast<double>(sizes.size()), options);
  if (!fit.found() || !fit.parameters.front().value) return;
  const double f0 = *fit.parameters.front().value;
  const double at_threshold = static_cast<double>(fit.n) / static_cast<double>(forces.size()) / f0;
  const double last = *std::max_element(sizes.begin(), sizes.end());
  if (!rows.empty()) rows.push_back({std::nan(""), std::nan("")});
  for (const double f : {fit.mean, last})
    rows.push_back({sign * f, at_threshold * std::exp(-(f - fit.mean) / f0)});
}

/// Returns one row per bin of a histogram: value, density, lower and upper end of the 68 % interval of the density, and
/// count.
std::vector<std::vector<double>> density_rows(const ForceDistribution& d) {
  std::vector<std::vector<double>> rows;
  for (int b = 0; b < static_cast<int>(d.counts.size()); ++b)
    if (d.counts[b] > 0) {
      // The count n of a bin is a Poisson variable. The next lines give an approximate 68 % confidence interval for the
      // mean of this variable.
      const auto n = static_cast<double>(d.counts[b]);
      const double half = std::sqrt(n + 0.25), density = d.density(b) / n;
      rows.push_back({d.middle(b), n * density, (n + 0.5 - half) * density, (n + 0.5 + half) * density, n});
    }
  return rows;
}

/// Fits an exponential distribution to the values p of one sign, and adds points of the fitted density from zero to the
/// largest value. The density is b exp(-b |p|) times the fraction of values with this sign, where b is the fitted
/// parameter.
void add_exponential(const std::vector<double>& values, double sign, std::vector<std::vector<double>>& rows) {
  const std::vector<double> sizes = sizes_of(values, sign);
  const ExponentEstimate fit = fit_exponent({cut_sample(sizes, 0.0, std::numeric_limits<double>::infinity())});
  if (!fit.found) return;
  const double share = static_cast<double>(sizes.size()) / static_cast<double>(values.size());
  if (!rows.empty()) rows.push_back({std::nan(""), std::nan("")});
  for (const double x : {0.0, *std::max_element(sizes.begin(), sizes.end())})
    rows.push_back({sign * x, share * fit.b * std::exp(-fit.b * x)});
}

std::string symbol_of(ForceKind kind) {
  return kind == ForceKind::normal ? "F_N" : kind == ForceKind::tangential ? "|F_T|" : "|Γ|";
}

}  // namespace

template <int Dim>
ForceSample force_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                         ForceKind kind, ForceUnit unit) {
  ForceSample sample{name, {}, contact_forces(packing, kind)};
  const double size = force_unit(packing, kind, unit);
  if (sample.forces.empty() || size <= 0.0)
    throw InputError(
        place,
        fmt::format("this state has no {} contact forces, or their unit in this plot is "
                    "zero: expected a state with contact forces of this kind and with a unit that is not zero",
                    name_of(kind)));
  for (double& f : sample.forces) f /= size;
  sample.distribution = force_distribution(packing, kind, unit, bin_width(sample.forces));
  return sample;
}

namespace {

/// Returns the ends of the axis that the curves of all samples share. The axis shows 99 % of the values of each sample,
/// but is at most three times as wide as the curve of the sample with the narrowest range needs. On a wider axis, this
/// curve would become a spike.
/// @param samples  values of each sample
std::pair<double, double> shown_values(std::vector<std::vector<double>> samples) {
  constexpr double kLeftOut = 0.005, kWidest = 3.0;
  std::vector<std::pair<double, double>> held;
  for (std::vector<double>& values : samples) {
    std::sort(values.begin(), values.end());
    const auto at = [&values](double share) {
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    held.emplace_back(std::min(0.0, at(kLeftOut)), std::max(0.0, at(1.0 - kLeftOut)));
  }
  double narrowest = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : held)
    if (high > low) narrowest = std::min(narrowest, high - low);
  std::pair<double, double> shown(0.0, 0.0);
  for (auto [low, high] : held) {
    const double excess = std::max(1.0, (high - low) / (kWidest * narrowest));
    shown = {std::min(shown.first, low / excess), std::max(shown.second, high / excess)};
  }
  const double margin = 0.05 * (shown.second - shown.first);
  return {shown.first < 0.0 ? shown.first - margin : 0.0, shown.second + margin};
}

/// Returns the name of a sample in the legend, with the number of its values that lie beyond the ends of the axis.
/// @param what  word for the values, such as "forces"
std::string name_in_legend(const std::string& name, const std::vector<double>& values, const char* what,
                           const std::pair<double, double>& shown) {
  const auto n =
      std::ranges::count_if(values, [&shown](double f) { return f < shown.first || f > shown.second; });
  return n == 0 ? name : fmt::format("{} ({} of {} {} not shown)", name, n, values.size(), what);
}

/// Returns gnuplot commands that set the ranges of both axes. The x axis shows the range `shown`, the y axis the
/// densities of all points in this range. Fitted curves are cut at the ends of the axes.
std::string density_axes(const Plot& plot, const std::vector<int>& points,
                         const std::pair<double, double>& shown) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const int b : points)
    for (const auto& row : plot.blocks[static_cast<std::size_t>(b)].rows)
      if (row[0] >= shown.first && row[0] <= shown.second)
        low = std::min(low, row[2]), high = std::max(high, row[3]);
  std::string script =
      shown.second > shown.first ? fmt::format("set xrange [{}:{}]\n", shown.first, shown.second) : "";
  if (high > low) script += fmt::format("set yrange [{}:{}]\n", 0.7 * low, 2.0 * high);
  return script;
}

/// A distribution to draw: the values of a sample, the rows of their histogram, and points of the fitted exponentials.
struct DensityCurve {
  std::string name;
  const std::vector<double>& values;
  std::vector<std::vector<double>> rows, fits;
};

/// Words for the labels of a plot of densities: the words for one value ("force"), for several values ("forces") and
/// for the fitted exponentials.
struct DensityWords {
  const char *value, *values, *fits;
};

/// Plots probability densities on a logarithmic axis, with the fitted exponentials, in one colour per sample.
Plot density_plot(std::vector<DensityCurve> densities, const DensityWords& words, const std::string& xlabel) {
  Plot plot;
  std::vector<Curve> curves, fits;
  std::vector<int> all;
  std::vector<std::vector<double>> values;
  for (const DensityCurve& d : densities) values.push_back(d.values);
  // All samples have the same x axis. Its range is limited: otherwise a sample with widely spread values would reduce
  // the curve of another sample to a spike.
  const std::pair<double, double> shown = shown_values(std::move(values));
  for (std::size_t s = 0; s < densities.size(); ++s) {
    DensityCurve& d = densities[s];
    const std::size_t color = s % 6 + 1;
    // The legend has a single entry for all fitted exponentials: that of the first sample with such a fit.
    const bool named = d.fits.empty() || !fits.empty();
    all.push_back(
        plot.add(fmt::format("{}: {} density low high count", d.name, words.value), std::move(d.rows)));
    curves.push_back(
        {all.back(),
         fmt::format("using 1:2:3:4 with yerrorbars pointtype marker[{0}] pointsize 0.8 linecolor rgb "
                     "color[{0}] title {1}",
                     color, gnuplot_quoted(name_in_legend(d.name, d.values, words.values, shown)))});
    const int lines =
        plot.add(fmt::format("{}: {}: {} density", d.name, words.fits, words.value), std::move(d.fits));
    if (plot.blocks.back().rows.empty()) continue;
    fits.push_back({lines, fmt::format("using 1:2 with lines linewidth 1.5 linecolor rgb color[{}] {}", color,
                                       named ? "notitle" : fmt::format("title '{}'", words.fits))});
  }
  std::ranges::move(fits, std::back_inserter(curves));
  plot.script =
      fmt::format(R"(set logscale y
set bars 0.4
{axes}set format y '10^{{%T}}'
set xlabel {xlabel}
set ylabel 'probability density'
set key tmargin center vertical font ',16'
{styles}{curves})",
                  fmt::arg("axes", density_axes(plot, all, shown)), fmt::arg("xlabel", gnuplot_quoted(xlabel)),
                  fmt::arg("styles", kSampleStyles), fmt::arg("curves", plot_command(plot, curves)));
  return plot;
}

}  // namespace

Plot forces_plot(const std::vector<ForceSample>& samples, ForceKind kind, ForceUnit unit) {
  std::vector<DensityCurve> densities;
  for (const ForceSample& sample : samples) {
    std::vector<std::vector<double>> tails;
    add_tail(sample.forces, 1.0, tails);
    if (kind == ForceKind::normal) add_tail(sample.forces, -1.0, tails);
    densities.push_back({sample.name, sample.forces, density_rows(sample.distribution), std::move(tails)});
  }
  const std::string scale = unit == ForceUnit::mean
                                ? fmt::format("⟨|{}|⟩", kind == ForceKind::normal       ? "F_N"
                                                        : kind == ForceKind::tangential ? "F_T"
                                                                                        : "Γ")
                            : kind == ForceKind::rolling ? "(F_0 a)"
                                                         : "F_0";
  return density_plot(std::move(densities), {"force", "forces", "exponential tails"},
                      symbol_of(kind) + " / " + scale);
}

template <int Dim>
PressureSample pressure_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                               double zero_force) {
  PressureSample sample{name, {}, packing.law.adheres()};
  const std::vector<bool> rattler = find_rattlers(packing, zero_force);
  const std::vector<double> pressure = particle_pressure(packing);
  double diameter = 0.0;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    diameter += 2.0 * packing.grains.radius[i] / static_cast<double>(pressure.size());
    if (!rattler[i]) sample.pressures.push_back(pressure[i]);
  }
  const double unit = sample.over_adhesion ? pull_off_force(packing) / std::pow(diameter, Dim - 1)
                                           : static_stress(packing).trace() / Dim;
  if (sample.pressures.empty() || !(unit > 0.0) || (!sample.over_adhesion && pressure_is_noise(packing)))
    throw InputError(place,
                     "the particle pressures of this state cannot be plotted: either no grain carries a "
                     "force, or the packing has neither adhesion nor pressure, so that there is no unit "
                     "of pressure");
  for (double& p : sample.pressures) p /= unit;
  return sample;
}

Plot pressures_plot(const std::vector<PressureSample>& samples) {
  std::vector<DensityCurve> densities;
  for (const PressureSample& sample : samples) {
    const std::vector<double>& p = sample.pressures;
    std::vector<std::vector<double>> laws;
    add_exponential(p, 1.0, laws);
    add_exponential(p, -1.0, laws);
    densities.push_back({sample.name, p, density_rows(distribution_of(p, 1.0, bin_width(p))), std::move(laws)});
  }
  return density_plot(std::move(densities), {"pressure", "pressures", "exponentials"},
                      samples.front().over_adhesion ? "pressure of a grain / p_0" : "pressure of a grain / P");
}

template <int Dim>
ScatteringSample scattering_sample(const std::string& name, const Packing<Dim>& packing) {
  constexpr double kLargestFitted = 0.5;
  const double a = largest_diameter(packing.grains);
  const double unit = 2.0 * std::numbers::pi / a, unit_I = std::pow(a, Dim);
  const Scattering s = scattering(packing);
  std::vector<ScatteredPoint> points;
  ScatteringSample sample;
  sample.name = name;
  sample.dimension = Dim;
  for (std::size_t b = 0; b < s.k.size(); ++b) {
    points.push_back({s.k[b], s.I[b], s.n_vectors[b]});
    sample.k.push_back(s.k[b] / unit);
    sample.I.push_back(s.I[b] / unit_I);
    // The intensity at a single wave vector has an exponential distribution, so the mean over n wave vectors has a
    // relative error of 1/sqrt(n).
    sample.error.push_back(sample.I.back() / std::sqrt(static_cast<double>(s.n_vectors[b])));
  }
  const ScatteringFit fit = fit_scattering(points, 0.0, kLargestFitted * unit);
  sample.failure_reason = fit.failure_reason;
  if (!fit.found()) return sample;
  // The law of fractal aggregates is drawn only if the data determine all its parameters.
  for (const FittedParameter& p : fit.parameters)
    if (!p.value) {
      sample.failure_reason = p.name + " is not identified by these data";
      return sample;
    }
  const double I0 = *fit.parameters[0].value, xi = *fit.parameters[1].value, dF = *fit.parameters[2].value;
  constexpr int kSteps = 60;
  for (int n = 0; n <= kSteps; ++n) {
    const double k = fit.low * std::pow(fit.high / fit.low, static_cast<double>(n) / kSteps);
    sample.fit_k.push_back(k / unit);
    sample.fit_I.push_back(scattered_intensity(I0, xi, dF, k) / unit_I);
  }
  sample.parameters =
      fmt::format("d_F = {}, ξ/a = {}", value_and_error(dF, fit.parameters[2].standard_error.value_or(0.0)),
                  value_and_error(xi / a, fit.parameters[1].standard_error.value_or(0.0) / a));
  return sample;
}

Plot scattering_plot(const std::vector<ScatteringSample>& samples) {
  Plot plot;
  std::vector<Curve> curves, laws;
  std::vector<int> all;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const ScatteringSample& sample = samples[s];
    std::vector<std::vector<double>> rows, law;
    for (std::size_t b = 0; b < sample.k.size(); ++b)
      rows.push_back({sample.k[b], sample.I[b], sample.error[b]});
    for (std::size_t b = 0; b < sample.fit_k.size(); ++b) law.push_back({sample.fit_k[b], sample.fit_I[b]});
    const int points = plot.add(sample.name + ": k I error", std::move(rows));
    const int line = plot.add(sample.name + ": law: k I", std::move(law));
    all.push_back(points);
    const std::size_t color = s % 6 + 1;
    curves.push_back(
        {points, fmt::format("using 1:2:3 with yerrorbars pointtype marker[{0}] pointsize 0.8 linecolor rgb "
                             "color[{0}] title {1}",
                             color,
                             gnuplot_quoted(sample.name +
                                            (sample.parameters.empty() ? "" : ":  " + sample.parameters)))});
    laws.push_back(
        {line, fmt::format("using 1:2 with lines linewidth 1.5 linecolor rgb color[{}] notitle", color)});
  }
  // The fitted laws come after the points, so that gnuplot draws them above the points of all samples.
  std::ranges::move(laws, std::back_inserter(curves));
  plot.script = fmt::format(R"(set logscale xy
set bars 0.4
{range}set format x '%g'
set format y '10^{{%T}}'
set xlabel 'k a/2π'
set ylabel 'I(k)/a^{dimension}'
set key tmargin center vertical font ',16'
{styles}{curves})",
                            fmt::arg("range", range_script(plot, "x", all, 0, true)),
                            fmt::arg("dimension", samples.front().dimension), fmt::arg("styles", kSampleStyles),
                            fmt::arg("curves", plot_command(plot, curves)));
  return plot;
}

template ForceSample force_sample(const std::string&, const std::string&, const Packing<2>&, ForceKind,
                                  ForceUnit);
template ForceSample force_sample(const std::string&, const std::string&, const Packing<3>&, ForceKind,
                                  ForceUnit);
template PressureSample pressure_sample(const std::string&, const std::string&, const Packing<2>&, double);
template PressureSample pressure_sample(const std::string&, const std::string&, const Packing<3>&, double);
template ScatteringSample scattering_sample(const std::string&, const Packing<2>&);
template ScatteringSample scattering_sample(const std::string&, const Packing<3>&);

}  // namespace floc
