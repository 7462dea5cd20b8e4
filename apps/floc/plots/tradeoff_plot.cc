#include "plots/tradeoff_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "plots/gnuplot.h"

namespace floc {
namespace {

/// Smallest relative error on the logarithmic axis. Smaller errors are drawn at this value.
constexpr double kSmallest = 1e-10;

/// One curve of the plot: the errors and costs measured for several values of one parameter, in the order of increasing
/// cost. One of these values is the value in the scene.
struct ParameterCurve {
  std::string parameter;
  std::vector<const MeasuredSetting*> settings;
};

bool is_compared(const MeasuredSetting& m, Observable observable) {
  return std::isfinite(single_state_error(m.errors[observable]));
}

/// Returns the first of the `candidates` for which errors of single states were measured. If there is no such
/// candidate, returns the last candidate.
Observable first_compared(const Tradeoff& tradeoff, std::initializer_list<Observable> candidates) {
  for (const Observable candidate : candidates)
    if (std::any_of(tradeoff.settings.begin(), tradeoff.settings.end(),
                    [&](const MeasuredSetting& m) { return is_compared(m, candidate); }))
      return candidate;
  return *std::prev(candidates.end());
}

/// Observables whose errors the two panels of the plot show.
struct Panels {
  Observable first, second;
};

Panels panels_of(const Tradeoff& tradeoff) {
  return {first_compared(tradeoff, {kPhi, kLatticeE}), first_compared(tradeoff, {kB, kZ, kTailGrain})};
}

std::string title_of(Observable observable) {
  return observable == kPhi ? "Phi" : declared_observables()[observable].name;
}

std::vector<ParameterCurve> curves_of(const Tradeoff& tradeoff, Observable observable) {
  std::vector<ParameterCurve> curves;
  for (const MeasuredSetting& m : tradeoff.settings) {
    if (!is_compared(m, observable) || m.setting.is_reference() || m.setting.parameter == "scene") continue;
    auto curve = std::find_if(curves.begin(), curves.end(),
                              [&](const ParameterCurve& c) { return c.parameter == m.setting.parameter; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), {m.setting.parameter, {}});
    curve->settings.push_back(&m);
  }
  for (ParameterCurve& c : curves)
    std::sort(c.settings.begin(), c.settings.end(),
              [](const auto* x, const auto* y) { return x->core_seconds < y->core_seconds; });
  return curves;
}

/// Returns a plot with one block of data per curve. Each row of a block belongs to one value of the parameter. The row
/// contains the relative cost and the errors of the two observables that the panels show.
Plot blocks_of(const std::vector<ParameterCurve>& curves, const Panels& panels) {
  const auto drawn = [](const MeasuredSetting& m, Observable k) {
    return std::max(single_state_error(m.errors[k]), kSmallest);
  };
  Plot plot;
  for (const ParameterCurve& c : curves) {
    std::vector<std::vector<double>> rows;
    for (const MeasuredSetting* m : c.settings)
      rows.push_back({m->cost_ratio, drawn(*m, panels.first), drawn(*m, panels.second)});
    const auto name = [](Observable k) { return declared_observables()[k].name; };
    plot.add(
        fmt::format("{}: cost_ratio error_{} error_{}", c.parameter, name(panels.first), name(panels.second)),
        rows);
  }
  return plot;
}

std::string panel(const std::vector<ParameterCurve>& curves, int column) {
  std::string text;
  for (std::size_t i = 0; i < curves.size(); ++i)
    text += fmt::format(
        "{}data index {} using 1:{} with linespoints linewidth 1.5 pointtype {} linecolor {} title {}",
        i == 0 ? "plot " : ", \\\n     ", i, column, 5 + i % 9, i + 1, gnuplot_quoted(curves[i].parameter));
  return text;
}

}  // namespace

void plot_tradeoff(const std::string& file, const Tradeoff& tradeoff) {
  const Panels panels = panels_of(tradeoff);
  const std::vector<ParameterCurve> curves = curves_of(tradeoff, panels.second);
  Plot plot = blocks_of(curves, panels);
  plot.height *= 2;
  plot.script = fmt::format(R"(set multiplot layout 2,1
set logscale xy
set format y '%.0e'
set yrange [{0}/2:*]
set xlabel 'processor time of a sample, relative to the strict settings'
set ylabel 'relative error of a state (at least {0})'
set title '{4}' noenhanced
set key off
{1}
set title '{3}' noenhanced
set key bottom left samplen 1.5 font ',14' noenhanced
{2}
unset multiplot
)",
                            kSmallest, panel(curves, 2), panel(curves, 3), title_of(panels.second),
                            title_of(panels.first));
  write_plot(file, plot);
}

}  // namespace floc
