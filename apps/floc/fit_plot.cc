#include "fit_plot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "floc/base/error.h"

extern char** environ;

namespace floc {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text << std::flush;
  if (!out) throw IoError(path.string(), "cannot be written");
}

/// Standard error of the mean over samples at one pressure; 0 for a single curve.
double error_of_mean(const ConsolidationCurve& curve, std::size_t i) {
  const Eigen::Index m = curve.samples.cols();
  if (m < 2) return 0.0;
  const Eigen::ArrayXd y = curve.samples.row(static_cast<Eigen::Index>(i)).array();
  return std::sqrt((y - y.mean()).square().sum() / static_cast<double>(m * (m - 1)));
}

/// Blocks of the data file, in the order in which the script names them by index.
std::string data_of(const ConsolidationPlot& plot) {
  const ConsolidationCurve& curve = plot.curve;
  const ConsolidationFit& fit = plot.fit;
  std::string text = "# points fitted: P_star 1/phi error_of_mean residual\n";
  for (std::size_t k = 0; k < fit.used.size(); ++k) {
    const auto i = static_cast<std::size_t>(fit.used[k]);
    const double y = 1.0 / curve.phi[i];
    text += fmt::format("{} {} {} {}\n", curve.P_star[i], y, error_of_mean(curve, i),
                        y - fit.fitted[static_cast<Eigen::Index>(k)]);
  }
  text += "\n\n# points left out: P_star 1/phi error_of_mean\n";
  std::string others;
  for (std::size_t i = 0; i < curve.phi.size(); ++i)
    if (std::find(fit.used.begin(), fit.used.end(), static_cast<int>(i)) == fit.used.end())
      others += fmt::format("{} {} {}\n", curve.P_star[i], 1.0 / curve.phi[i], error_of_mean(curve, i));
  text += others.empty() ? "NaN NaN NaN\n" : others;
  text += "\n\n# law: P_star 1/phi\n";
  constexpr int kSteps = 200;
  const double first = std::log(fit.window_low);
  const double range = std::log(fit.window_high) - first;
  for (int k = 0; k <= kSteps; ++k) {
    const double log_P = first + range * k / kSteps;
    text += fmt::format("{} {}\n", std::exp(log_P), fit.value(log_P));
  }
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string title_of(const ConsolidationPlot& plot) {
  std::string title = plot.title;
  for (const char* name : {"lambda", "alpha", "Phi_max"})
    if (const FittedParameter* p = plot.fit.find(name); p && p->value && p->standard_error)
      title += fmt::format("   {} = {:.3g} ± {:.2g}", name, *p->value, *p->standard_error);
  return title;
}

std::string script_of(const ConsolidationPlot& plot, const std::string& svg, const std::string& data) {
  const double low = plot.curve.P_star.front();
  const double high = plot.curve.P_star.back();
  return fmt::format(
      R"(set terminal svg size 720,640 font 'DejaVu Sans,13' background 'white' noenhanced
set output {svg}
data = {data}
set multiplot
set logscale x
set format x ''
set xrange [{xlow}:{xhigh}]
set lmargin at screen 0.13
set rmargin at screen 0.97
set tmargin at screen 0.93
set bmargin at screen 0.36
set title {title}
set ylabel '1/Phi'
set key top right
set arrow 1 from first {wlow}, graph 0 to first {wlow}, graph 1 nohead dashtype 2 linecolor rgb '#888888'
set arrow 2 from first {whigh}, graph 0 to first {whigh}, graph 1 nohead dashtype 2 linecolor rgb '#888888'
plot data index 2 using 1:2 with lines linewidth 2 linecolor rgb '#c0392b' title 'law', \
     data index 1 using 1:2:3 with yerrorbars pointtype 6 linecolor rgb '#888888' title 'left out', \
     data index 0 using 1:2:3 with yerrorbars pointtype 7 pointsize 0.7 linecolor rgb '#1f4e79' title 'fitted; window dashed'
unset title
set format x '%g'
set tmargin at screen 0.33
set bmargin at screen 0.11
set xlabel {xlabel}
set ylabel 'residual'
set xzeroaxis linetype 1 linecolor rgb '#c0392b'
set ytics nomirror autofreq
unset key
plot data index 0 using 1:4 with impulses linecolor rgb '#888888', \
     data index 0 using 1:4 with points pointtype 7 pointsize 0.7 linecolor rgb '#1f4e79'
unset multiplot
)",
      fmt::arg("svg", quoted(svg)), fmt::arg("data", quoted(data)), fmt::arg("xlow", low / 1.2),
      fmt::arg("xhigh", high * 1.2), fmt::arg("title", quoted(title_of(plot))),
      fmt::arg("wlow", plot.fit.window_low), fmt::arg("whigh", plot.fit.window_high),
      fmt::arg("xlabel", quoted(plot.unit.empty() ? "P*" : "pressure (" + plot.unit + ")")));
}

/// Runs gnuplot on a script in its directory. @throws IoError if it is missing or fails
void run_gnuplot(const fs::path& script) {
  const std::string name = script.filename().string();
  const std::string directory = script.has_parent_path() ? script.parent_path().string() : ".";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  std::string program = "gnuplot";
  std::string argument = name;
  char* const argv[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failure != 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) == 127)
    throw IoError("gnuplot",
                  fmt::format("cannot be started (package gnuplot-nox); the script is {}", script.string()));
  if (WEXITSTATUS(status) != 0) throw IoError("gnuplot", fmt::format("failed on {}", script.string()));
}

}  // namespace

void plot_consolidation(const std::string& file, const ConsolidationPlot& plot) {
  const fs::path svg(file);
  if (svg.extension() != ".svg" || svg.stem().empty())
    throw InputError("--plot " + file, "expected a name that ends in .svg");
  const fs::path data = fs::path(svg).replace_extension(".dat");
  const fs::path script = fs::path(svg).replace_extension(".gp");
  write_file(data, data_of(plot));
  write_file(script, script_of(plot, svg.filename().string(), data.filename().string()));
  run_gnuplot(script);
}

}  // namespace floc
