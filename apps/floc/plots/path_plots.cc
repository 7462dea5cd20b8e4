#include "plots/path_plots.h"

#include <fmt/format.h>

#include <cmath>

#include "commands/plot_command.h"
#include "floc/fitting/elastic_line.h"
#include "floc/fitting/supported_law.h"
#include "floc/picture/drawn_scale.h"
#include "floc/tables/state_moduli.h"
#include "plots/fit_plot.h"
#include "plots/pressure_text.h"

namespace floc {
namespace {

/// One branch of a load path: the indices of consecutive rows along which the pressure rises (`up`) or falls. The row
/// at which the pressure reverses belongs to two branches. Rows with zero pressure are left out, because the pressure
/// axis is logarithmic.
struct Branch {
  bool up = true;
  std::vector<int> rows;
};

std::vector<Branch> branches_of(const std::vector<double>& P) {
  std::vector<Branch> branches(1);
  for (int i = 0; i < static_cast<int>(P.size()); ++i) {
    if (P[i] <= 0.0) continue;
    Branch& last = branches.back();
    const bool moves = !last.rows.empty() && P[i] != P[last.rows.back()];
    const bool up = moves ? P[i] > P[last.rows.back()] : last.up;
    if (last.rows.size() < 2) last.up = up;
    if (up != last.up) branches.push_back({up, {last.rows.back()}});
    branches.back().rows.push_back(i);
  }
  return branches;
}

/// Returns a point row(i) for each row i of the branches along which the pressure rises (if `up`) or falls. Points of
/// NaN separate the branches, so that no line joins two branches.
template <class Row>
std::vector<std::vector<double>> rows_going(bool up, const std::vector<Branch>& branches, Row&& row) {
  std::vector<std::vector<double>> rows;
  for (const Branch& branch : branches) {
    if (branch.up != up) continue;
    if (!rows.empty()) rows.emplace_back(rows.front().size(), std::nan(""));
    for (const int i : branch.rows) rows.push_back(row(i));
  }
  return rows;
}

std::vector<double> pressures_of(const PathTable& path) {
  std::vector<double> P;
  for (const PathRow& row : path.rows) P.push_back(row.P_star);
  return P;
}

/// Returns the stress that corresponds to the reduced pressure P* = 1 in row `row` of a load path.
double stress_of_unit(const PathTable& path, int row) {
  const PathRow& of = path.rows[static_cast<std::size_t>(row)];
  if (!path.table.has("P") || of.P_star == 0.0) return 1.0;
  const double driven_over_mean = path.stress == "driven" ? of.driven_over_mean : 1.0;
  return path.table.number(row, path.table.column("P")) * driven_over_mean / of.P_star;
}

/// Returns the modulus of the state at the start of an unloading branch, in the unit of the pressures of the path;
/// absent if this state is not available. The modulus is B_S, the bulk modulus for imposed stresses. For an oedometer
/// test it is a modulus for uniaxial strain instead: M if the pressures of the path are stresses on the driven axis,
/// B_uniaxial if they are mean stresses.
std::optional<double> modulus_of_state(const PathTable& path, const Loading& branch) {
  const auto found = moduli_of_row(path, branch.rows.front(), driven_axis(path, branch.rows.back()));
  if (!found) return std::nullopt;
  const std::optional<StateModuli> state = in_unit_of(path, *found);
  const double modulus = !state->M ? state->B_S : path.stress == "driven" ? *state->M : *state->B_uniaxial;
  return path.unit.empty() ? modulus / stress_of_unit(path, branch.rows.front()) : modulus;
}

/// Adds points of the elastic line of an unloading branch, 1/Phi = exp((P_first - P)/B)/phi_first. The line begins at
/// the first point (P_first, phi_first) of the branch and ends at its last pressure. B is the modulus of the state at
/// the first point; if this state is not available, B is fitted to the branch.
void add_elastic_line(const PathTable& path, const Loading& branch, std::vector<std::vector<double>>& points) {
  constexpr int kSteps = 60;
  const double P_first = branch.curve.P_star.front(), P_last = branch.curve.P_star.back();
  const double phi_first = branch.curve.phi.front();
  double B = 0.0;
  if (const auto modulus = modulus_of_state(path, branch))
    B = *modulus;
  else if (const ElasticFit fit = fit_elastic(branch.curve.P_star, branch.curve.phi); fit.found())
    B = fit.parameters.front().value.value_or(0.0);
  if (B <= 0.0 || !(P_last > 0.0)) return;
  if (!points.empty()) points.push_back({std::nan(""), std::nan("")});
  for (int k = 0; k <= kSteps; ++k) {
    const double P = P_first * std::pow(P_last / P_first, static_cast<double>(k) / kSteps);
    points.push_back({P, std::exp((P_first - P) / B) / phi_first});
  }
}

/// Returns the labels above the plot, which name the regimes of the consolidation law: the position and the text of
/// each label. If a regime is too narrow for a label of its own, the label of a neighbouring regime contains both
/// names. Labels therefore do not overlap.
std::vector<std::pair<double, std::string>> regime_labels(
    double low, const std::vector<std::pair<double, const char*>>& regimes) {
  constexpr double kNarrowest = 0.1;  // width of the label "III", as a fraction of the axis
  const double axis = std::log(regimes.back().first / low);
  std::vector<std::pair<double, std::string>> labels;
  double start = low, label_start = low;
  for (const auto& [end, name] : regimes) {
    const bool shared = !labels.empty() && (std::log(end / start) < kNarrowest * axis ||
                                            std::log(start / label_start) < kNarrowest * axis);
    if (shared) {
      labels.back() = {std::sqrt(label_start * end), labels.back().second + ", " + name};
    } else {
      label_start = start;
      labels.emplace_back(std::sqrt(start * end), name);
    }
    start = end;
  }
  return labels;
}

/// Returns gnuplot commands that draw the limits and the names of the regimes of the consolidation law. A limit is
/// drawn only if the data determine it.
std::string regimes_script(const ConsolidationFit& fit, double low, double high) {
  const auto value = [&fit](const char* name) -> std::optional<double> {
    const FittedParameter* p = fit.find(name);
    return p != nullptr && p->identified ? p->value : std::nullopt;
  };
  const auto P0 = value("P0_star"), P1 = value("P1_star");
  std::vector<std::pair<double, const char*>> regimes;  // upper limit and name of each regime
  if (P0 && *P0 > low && *P0 < high) regimes.emplace_back(*P0, "I");
  if (P1 && *P1 > (regimes.empty() ? low : *P0) && *P1 < high) {
    regimes.emplace_back(*P1, "II");
    regimes.emplace_back(high, "III");
  } else {
    regimes.emplace_back(high, "II, III");
  }
  std::string script;
  for (std::size_t k = 0; k + 1 < regimes.size(); ++k)
    script += fmt::format(
        "set arrow from first {0}, graph 0 to first {0}, graph 1 nohead dashtype 2 linecolor rgb '#999999'\n",
        regimes[k].first);
  for (const auto& [place, names] : regime_labels(low, regimes))
    script +=
        fmt::format("set label '{}' at first {}, graph 1.03 center textcolor rgb '#404040'\n", names, place);
  return script;
}

/// Returns the gnuplot command that marks round values of the solid fraction Phi on the right axis. Each mark is at the
/// height of 1/Phi on the left axis.
std::string density_tics(const Plot& plot) {
  double low = 1.0, high = 0.0;
  for (const Plot::Block& block : plot.blocks)
    for (const std::vector<double>& row : block.rows)
      if (row[1] > 0.0) low = std::min(low, 1.0 / row[1]), high = std::max(high, 1.0 / row[1]);
  if (!(low < high)) return "";
  const double step = round_number_below((high - low) / 4.0);
  std::string tics;
  const int first = static_cast<int>(std::floor(low / step)), last = static_cast<int>(std::ceil(high / step));
  for (int n = std::max(first, 1); n <= last; ++n)
    tics += fmt::format("{}'{:.6g}' {}", tics.empty() ? "" : ", ", n * step, 1.0 / (n * step));
  return "set y2tics (" + tics + ")\n";
}

std::string parameters_text(const ConsolidationFit& fit) {
  std::string text;
  constexpr std::pair<const char*, const char*> kNames[] = {
      {"lambda", "λ"}, {"kappa", "κ"}, {"alpha", "α"}, {"Phi_max", "Φ_{max}"}};
  for (const auto& [name, symbol] : kNames)
    if (const FittedParameter* p = fit.find(name); p && p->value && p->standard_error)
      text += fmt::format("{}{} = {}", text.empty() ? "" : "   ", symbol,
                          value_and_error(*p->value, *p->standard_error));
  return text;
}

}  // namespace

FittedConsolidation fitted_consolidation(const std::vector<PathTable>& samples, double phi_limit) {
  std::vector<ConsolidationCurve> curves;
  for (const PathTable& sample : samples) curves.push_back(first_loading(sample.rows).curve);
  FittedConsolidation result;
  result.curve = curves.size() == 1 ? curves.front() : mean_curve(curves);
  ConsolidationOptions options;
  options.phi_limit = phi_limit;
  result.fit = fit_supported_law(result.curve, options);
  return result;
}

Plot consolidation_plot(const std::vector<PathTable>& samples, const FittedConsolidation& fitted) {
  const ConsolidationCurve& curve = fitted.curve;
  Plot plot;
  std::vector<std::vector<double>> each, mean, down, elastic;
  for (const PathTable& sample : samples) {
    const auto point = [&sample](int i) {
      return std::vector<double>{sample.rows[i].P_star, 1.0 / sample.rows[i].phi};
    };
    const std::vector<Branch> branches = branches_of(pressures_of(sample));
    for (const auto& [up, rows] : {std::pair(true, &each), std::pair(false, &down)})
      for (auto& row : rows_going(up, branches, point)) rows->push_back(std::move(row));
    // A row of NaN after each sample ends its line, so that it is not joined to the next sample.
    for (auto* rows : {&each, &down}) rows->push_back({std::nan(""), std::nan("")});
    for (const Loading& branch : unloadings(sample.rows)) add_elastic_line(sample, branch, elastic);
  }
  for (std::size_t i = 0; i < curve.phi.size(); ++i)
    mean.push_back({curve.P_star[i], 1.0 / curve.phi[i], error_of_mean(curve, i)});
  plot.add("loading of each sample: P_star 1/phi", std::move(each));
  plot.add("loading fitted: P_star 1/phi error_of_mean", std::move(mean));
  plot.add("unloading: P_star 1/phi", std::move(down));
  plot.add("elastic lines: P_star 1/phi", std::move(elastic));
  plot.add("law: P_star 1/phi",
           fitted.fit.found() ? law_points(fitted.fit) : std::vector<std::vector<double>>{});
  const std::string& unit = samples.front().unit;
  const std::vector<int> all = {0, 1, 2, 3, 4};
  const std::string y_range = range_script(plot, "y", all, 1, false);
  const double low = curve.P_star.empty() ? 1.0 : curve.P_star.front();
  const double high = curve.P_star.empty() ? 1.0 : curve.P_star.back();
  const bool one = samples.size() == 1;
  // The lines of the samples are drawn first. The mean and its errors are drawn last, so that they lie on top.
  const std::string curves = plot_command(
      plot,
      {{0, fmt::format("using 1:2 with lines linecolor rgb '#bdbdbd' {}", one ? "notitle" : "title 'samples'")},
       {2, "using 1:2 with points pointtype 6 pointsize 0.9 linecolor rgb '#0072b2' title 'unloading'"},
       {3, "using 1:2 with lines dashtype 2 linecolor rgb '#009e73' title 'elastic, dΦ/Φ = dP/B'"},
       {4, "using 1:2 with lines linewidth 2 linecolor rgb '#d55e00' title 'law'"},
       {1, fmt::format("using 1:2:3 with yerrorbars pointtype 7 pointsize 0.9 linecolor rgb '#202020' title {}",
                       one ? "'loading'" : fmt::format("'mean of {} samples'", samples.size()))}});
  plot.script = fmt::format(
      R"(set logscale x
set format x '%g'
{ranges}set xlabel {xlabel}
set ylabel '1/Φ'
set ytics nomirror
set y2label 'Φ'
set key top right
set title {title} offset 0,0.6
{regimes}{curves})",
      // Both vertical axes have the range of 1/Phi. On the right axis, density_tics() puts marks at round values of
      // Phi.
      fmt::arg("ranges", range_script(plot, "x", all, 0, true) + y_range +
                             (y_range.empty() ? "" : "set y2" + y_range.substr(5)) + density_tics(plot)),
      fmt::arg("xlabel", gnuplot_quoted(pressure_label(unit, samples.front().stress))),
      fmt::arg("title", gnuplot_quoted(fitted.fit.found() ? parameters_text(fitted.fit) : "")),
      fmt::arg("regimes", fitted.fit.found() ? regimes_script(fitted.fit, low, high) : ""),
      fmt::arg("curves", curves));
  return plot;
}

/// Returns whether path.csv has rows in which one axis is driven.
bool has_driven_rows(const CsvTable& path) {
  if (!path.has("control")) return false;
  const int control = path.column("control");
  for (int row = 0; row < path.n_rows(); ++row)
    if (!path.is_empty(row, control)) return true;
  return false;
}

Plot coordination_plot(const CsvTable& path) {
  const int P = path.column("P_star");
  const std::vector<int> columns = {path.column("z"), path.column("z_plus"), path.column("z_minus"),
                                    path.column("z_zero")};
  std::vector<double> pressures;
  for (int i = 0; i < path.n_rows(); ++i) pressures.push_back(path.number(i, P));
  const auto row = [&](int i) {
    std::vector<double> values = {pressures[i]};
    for (const int column : columns) values.push_back(path.number(i, column));
    return values;
  };
  Plot plot;
  const std::vector<Branch> branches = branches_of(pressures);
  // The loop over k in the script draws columns 2 to 5 of a block. For unloading, only the curve of z (column 2) has an
  // entry in the legend.
  plot.add("loading: P_star z z_plus z_minus z_zero", rows_going(true, branches, row));
  plot.add("unloading: P_star z z_plus z_minus z_zero", rows_going(false, branches, row));
  plot.script = "set logscale x\n" + range_script(plot, "x", {0, 1}, 0, true) + R"(set format x '%g'
set xlabel ')" + mean_pressure_label(has_driven_rows(path)) +
                R"('
set ylabel 'coordination number'
set yrange [0:*]
set key outside top center horizontal maxrows 2
array color[4] = ['#202020', '#0072b2', '#d55e00', '#8a8a8a']
array marker[4] = [7, 9, 11, 5]
array name[4] = ['z', 'z_+  compression', 'z_−  tension', 'z_0  zero']
)" +
                plot_command(plot,
                             {{0,
                               "using 1:k+1 with linespoints pointtype marker[k] pointsize 0.9 linecolor "
                               "rgb color[k] title name[k]",
                               "for [k=1:4]"},
                              {1,
                               "using 1:k+1 with linespoints pointtype marker[k]-1 pointsize 0.9 dashtype 2 "
                               "linecolor rgb color[k] title k == 1 ? 'unloading: open' : ''",
                               "for [k=1:4]"}});
  return plot;
}

std::string stress_unit(const std::string& units, int dimension, bool cohesive) {
  if (units == "SI") return dimension == 2 ? "N/m" : "Pa";
  if (cohesive) return dimension == 2 ? "F_0/a" : "F_0/a^2";
  return "units of the state";
}

ModuliPoint ModuliPoint::with_bounds(bool hold, bool stable) const {
  ModuliPoint point = *this;
  if (!hold) point.B_reuss = point.B_voigt = std::nan("");
  if (!hold && !stable) point.G_voigt = std::nan("");
  return point;
}

ModuliPoint moduli_point(double P_star, const Moduli& m) {
  return ModuliPoint{P_star, m.B, m.B_S, m.G, m.bounds.B_reuss, m.bounds.B_voigt, m.bounds.G_voigt}.with_bounds(
      m.bounds_hold(), m.n_negative == 0);
}

Plot moduli_plot(const std::vector<ModuliPoint>& points, const std::string& unit) {
  std::vector<double> pressures;
  for (const ModuliPoint& p : points) pressures.push_back(p.P_star);
  const auto row = [&](int i) {
    const ModuliPoint& p = points[static_cast<std::size_t>(i)];
    return std::vector<double>{p.P_star, p.B, p.B_S, p.G, p.B_reuss, p.B_voigt, p.G_voigt};
  };
  Plot plot;
  const std::vector<Branch> branches = branches_of(pressures);
  plot.add("loading: P_star B B_S G B_reuss B_voigt G_voigt", rows_going(true, branches, row));
  plot.add("unloading: P_star B B_S G B_reuss B_voigt G_voigt", rows_going(false, branches, row));
  // The Reuss and Voigt bounds are drawn for loading only. They are drawn first, so that the moduli cover them. Bounds
  // that do not hold are NaN, which gnuplot does not draw.
  const std::string curves = plot_command(
      plot,
      {{0, "using 1:5:6 with filledcurves fillcolor rgb '#e3eef6' title 'Reuss and Voigt bounds of B'"},
       {0, "using 1:5 with lines linecolor rgb '#9cc3de' notitle"},
       {0, "using 1:6 with lines linecolor rgb '#9cc3de' notitle"},
       {0, "using 1:7 with lines dashtype 3 linecolor rgb '#d55e00' title 'Voigt bound of G'"},
       {0, "using 1:2 with linespoints pointtype 7 pointsize 0.9 linecolor rgb '#0072b2' title 'B'"},
       {0, "using 1:4 with linespoints pointtype 5 pointsize 0.9 linecolor rgb '#d55e00' title 'G'"},
       {1,
        "using 1:2 with linespoints pointtype 6 pointsize 0.9 dashtype 2 linecolor rgb '#0072b2' title 'B, "
        "unloading'"},
       {1,
        "using 1:4 with linespoints pointtype 4 pointsize 0.9 dashtype 2 linecolor rgb '#d55e00' title 'G, "
        "unloading'"}});
  plot.script =
      fmt::format(R"(set logscale xy
{range}set format x '%g'
set format y '10^{{%T}}'
set xlabel '{xlabel}'
set ylabel {ylabel}
set key bottom right font ',16'
{curves})",
                  fmt::arg("range", range_script(plot, "x", {0, 1}, 0, true)), fmt::arg("curves", curves),
                  fmt::arg("xlabel", mean_pressure_label(std::ranges::any_of(points, &ModuliPoint::is_driven))),
                  fmt::arg("ylabel", gnuplot_quoted("modulus (" + unit + ")")));
  return plot;
}

}  // namespace floc
