#include "plots/fit_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/plot_command.h"

namespace floc {
namespace {

/// Returns the two end points of the recompression line, as pairs of P* and 1/Phi; empty if the slope of this line was
/// not fitted.
std::vector<std::vector<double>> recompression_points(const ConsolidationFit& fit) {
  const FittedParameter* P0 = fit.find("P0_star");
  if (!fit.line.slopes || !P0 || !P0->value) return {};
  std::vector<std::vector<double>> points;
  for (const double P : {fit.plateau_low, *P0->value}) points.push_back({P, fit.line.at(std::log(P))});
  return points;
}

/// Adds the blocks of data of the gnuplot script, which refers to the blocks by number: fitted points (0), points left
/// out of the fit (1), fitted law (2), unloading and reloading (3), recompression line (4), and the yield point at the
/// end of this line (5).
void add_blocks(const ConsolidationPlot& of, Plot& plot) {
  const ConsolidationCurve& curve = of.curve;
  const ConsolidationFit& fit = of.fit;
  std::vector<std::vector<double>> used, others;
  for (std::size_t k = 0; k < fit.used.size(); ++k) {
    const auto i = static_cast<std::size_t>(fit.used[k]);
    const double y = 1.0 / curve.phi[i];
    used.push_back({curve.P_star[i], y, error_of_mean(curve, i), y - fit.fitted[static_cast<Eigen::Index>(k)]});
  }
  for (std::size_t i = 0; i < curve.phi.size(); ++i)
    if (std::find(fit.used.begin(), fit.used.end(), static_cast<int>(i)) == fit.used.end())
      others.push_back({curve.P_star[i], 1.0 / curve.phi[i], error_of_mean(curve, i)});
  plot.add("points fitted: P_star 1/phi error_of_mean residual", std::move(used));
  plot.add("points left out: P_star 1/phi error_of_mean", std::move(others));
  plot.add("law: P_star 1/phi", law_points(fit));
  plot.add("unloading and reloading: P_star 1/phi", of.loops);
  std::vector<std::vector<double>> recompression = recompression_points(fit);
  std::vector<std::vector<double>> yield;
  if (!recompression.empty()) yield.push_back(recompression.back());
  plot.add("recompression line: P_star 1/phi", std::move(recompression));
  plot.add("yield: P_star 1/phi", std::move(yield));
}

std::string title_of(const ConsolidationPlot& plot) {
  // The title gives only the last two parts of the path of the table, to leave room for the parameters.
  const std::filesystem::path path(plot.title);
  std::string title = (path.parent_path().filename() / path.filename()).string();
  const bool is_line = plot.fit.reported_law == ConsolidationLaw::log;
  for (const char* name : {"lambda", is_line ? "kappa" : "alpha", is_line ? "" : "Phi_max"})
    if (const FittedParameter* p = plot.fit.find(name); p && p->value && p->standard_error)
      title += fmt::format("   {} = {}", name, value_and_error(*p->value, *p->standard_error));
  return title;
}

/// Axis of the residuals: its unit (a power of ten), and half of its range in this unit.
struct ResidualAxis {
  double unit, half;
};

ResidualAxis residual_axis(const Plot& drawn) {
  double largest = 0.0;
  for (const std::vector<double>& row : drawn.blocks.front().rows)
    largest = std::max(largest, std::abs(row.back()));
  const double unit = largest > 0.0 ? std::pow(10.0, std::floor(std::log10(largest))) : 1e-12;
  return {unit, 1.2 * (std::floor(largest / unit) + 1.0)};
}

const char* law_title(const ConsolidationFit& fit) {
  return fit.reported_law == ConsolidationLaw::log ? "virgin line" : "law";
}

std::string script_of(const ConsolidationPlot& plot, const Plot& drawn) {
  // Two panels have the same pressure axis: the upper one shows the curve, and the lower one the residuals. The fitted
  // points are drawn last, so that the law does not cover them.
  const std::string curves = plot_command(
      drawn,
      {{3,
        "using 1:2 with linespoints linewidth 1 pointtype 1 pointsize 0.8 linecolor rgb '#666666' title "
        "'unloading "
        "and reloading'"},
       {2, fmt::format("using 1:2 with lines linewidth 3 linecolor rgb '#c0392b' title '{}'",
                       law_title(plot.fit))},
       {4, "using 1:2 with lines linewidth 3 dashtype 2 linecolor rgb '#27667b' title 'recompression line'"},
       {5, "using 1:2 with points pointtype 12 pointsize 2 linewidth 2 linecolor rgb '#000000' title 'yield'"},
       {1, "using 1:2:3 with yerrorbars pointtype 6 pointsize 1.2 linecolor rgb '#666666' title 'left out'"},
       {0, "using 1:2:3 with yerrorbars pointtype 7 pointsize 1 linecolor rgb '#1f4e79' title 'fitted'"}});
  const ResidualAxis axis = residual_axis(drawn);
  const double low = plot.curve.P_star.front();
  const double high = plot.curve.P_star.back();
  // Without noenhanced, gnuplot would print names in the title, such as Phi_max, with subscripts.
  return fmt::format(
      R"(set termoption noenhanced
set termoption font ',20'
set multiplot
set logscale x
set format x ''
set xrange [{xlow}:{xhigh}]
set lmargin at screen 0.19
set rmargin at screen 0.97
set tmargin at screen 0.94
set bmargin at screen 0.37
set title {title} font ',13' offset 0,-0.4
set ylabel '1/Phi' offset -1,0
set key top right font ',17' samplen 2.5 spacing 1.05 width -1
set arrow 1 from first {wlow}, graph 0 to first {wlow}, graph 1 nohead dashtype 2 linecolor rgb '#888888'
set arrow 2 from first {whigh}, graph 0 to first {whigh}, graph 1 nohead dashtype 2 linecolor rgb '#888888'
{curves}unset title
set format x '%g'
set tmargin at screen 0.35
set bmargin at screen 0.14
set xlabel {xlabel}
set ylabel {residual}
set xzeroaxis linetype 1 linecolor rgb '#c0392b'
set yrange [-{half}:{half}]
set ytics nomirror ({tic}, 0, -{tic})
unset key
plot data index 0 using 1:($4/{unit}) with impulses linecolor rgb '#888888', \
     data index 0 using 1:($4/{unit}) with points pointtype 7 pointsize 1 linecolor rgb '#1f4e79'
unset multiplot
)",
      fmt::arg("xlow", low / 1.2), fmt::arg("xhigh", high * 1.2),
      fmt::arg("title", gnuplot_quoted(title_of(plot))), fmt::arg("curves", curves),
      fmt::arg("half", axis.half), fmt::arg("tic", axis.half / 1.2), fmt::arg("unit", axis.unit),
      fmt::arg("residual", gnuplot_quoted(fmt::format("residual / {:g}", axis.unit))),
      fmt::arg("wlow", plot.fit.window_low), fmt::arg("whigh", plot.fit.window_high),
      fmt::arg("xlabel", gnuplot_quoted(pressure_label(plot.unit, plot.stress))));
}

}  // namespace

double error_of_mean(const ConsolidationCurve& curve, std::size_t i) {
  const Eigen::Index m = curve.samples.cols();
  if (m < 2) return 0.0;
  const Eigen::ArrayXd y = curve.samples.row(static_cast<Eigen::Index>(i)).array();
  return std::sqrt((y - y.mean()).square().sum() / static_cast<double>(m * (m - 1)));
}

std::vector<std::vector<double>> law_points(const ConsolidationFit& fit) {
  constexpr int kSteps = 200;
  // The line of regime II begins at its intersection with the recompression line. The intersection may lie between two
  // rows.
  const FittedParameter* P0 = fit.find("P0_star");
  const bool meets = fit.line.slopes && P0 && P0->value && *P0->value < fit.window_low;
  const double first = std::log(meets ? *P0->value : fit.window_low);
  const double range = std::log(fit.window_high) - first;
  std::vector<std::vector<double>> points;
  for (int k = 0; k <= kSteps; ++k) {
    const double log_P = first + range * k / kSteps;
    points.push_back({std::exp(log_P), fit.value(log_P)});
  }
  return points;
}

std::string pressure_label(const std::string& unit, const std::string& stress) {
  const std::string name = stress.empty()     ? ""
                           : stress == "mean" ? " of the mean stress"
                                              : " of the driven stress";
  return unit.empty() ? "P*" + name : "pressure" + name + " (" + unit + ")";
}

Plot plot_of_fit(const ConsolidationPlot& of) {
  Plot plot;
  plot.height = 680;
  add_blocks(of, plot);
  plot.script = script_of(of, plot);
  return plot;
}

}  // namespace floc
