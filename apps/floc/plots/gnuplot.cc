#include "plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/transient_file.h"
#include "process/output_files.h"
#include "process/scratch_directory.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

std::string data_of(const Plot& plot) {
  std::string text;
  for (const Plot::Block& block : plot.blocks) {
    text += fmt::format("{}# {}\n", text.empty() ? "" : "\n\n", block.columns);
    for (const std::vector<double>& row : block.rows) text += fmt::format("{}\n", fmt::join(row, " "));
    if (block.rows.empty()) text += "NaN NaN NaN NaN\n";
  }
  return text;
}

/// Returns the gnuplot terminal for the extension of a file name; empty if the extension is not supported.
std::string terminal_for(const std::string& extension, const Plot& plot) {
  // In a figure that is printed 85 mm wide, letters are 2 mm high and markers 1.5 mm wide. This is large enough to
  // distinguish them.
  constexpr const char* kFont = "font 'DejaVu Sans,{}'";
  constexpr double kPixelsPerInch = 96.0;
  if (extension == ".svg")
    return fmt::format("svg size {},{} {} background 'white' linewidth 1.5", plot.width, plot.height,
                       fmt::format(kFont, 18));
  if (extension == ".png")
    return fmt::format("pngcairo size {},{} {} fontscale 2 linewidth 2 pointscale 1.5", 2 * plot.width,
                       2 * plot.height, fmt::format(kFont, 14));
  if (extension == ".pdf")
    return fmt::format("pdfcairo size {:.3f}in,{:.3f}in {} fontscale 0.75 linewidth 1.5",
                       plot.width / kPixelsPerInch, plot.height / kPixelsPerInch, fmt::format(kFont, 18));
  return "";
}

std::string script_of(const Plot& plot, const fs::path& picture, const fs::path& data) {
  return fmt::format(
      "if (!exists('picture')) picture = {}\ndata = {}\nset encoding utf8\nset terminal {}\nset output "
      "picture\n{}",
      gnuplot_quoted(picture.filename().string()), gnuplot_quoted(data.filename().string()),
      terminal_for(picture.extension().string(), plot), plot.script);
}

/// Runs gnuplot on a script, in the directory of the script. The messages of gnuplot go to the file `words`. They are
/// shown only if gnuplot fails: otherwise they only warn about the appearance of plots with few points.
/// @throws IoError if gnuplot is missing or fails
void run_gnuplot(const fs::path& script, const fs::path& picture, const fs::path& words) {
  const std::string directory = script.has_parent_path() ? script.parent_path().string() : ".";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, words.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  std::string program = "gnuplot", option = "-e", name = script.filename().string();
  std::string assignment = "picture = " + gnuplot_quoted(picture.filename().string());
  char* const argv[] = {program.data(), option.data(), assignment.data(), name.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failure != 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) == 127)
    throw IoError(
        "gnuplot",
        fmt::format(
            "this program cannot be started: install the package gnuplot-nox; the script of the plot is {}",
            script.string()));
  if (WEXITSTATUS(status) != 0)
    throw IoError("gnuplot", fmt::format("this program failed on the script {} with the message: {}",
                                         script.string(), read_file(words.string())));
}

/// Overwrites the creation time in a pdf file with blanks, so that equal plots give equal files. The positions of all
/// other bytes must not change, because the pdf file refers to them.
void blank_creation_date(std::string& bytes) {
  const std::string key = "/CreationDate (";
  const std::size_t first = bytes.find(key);
  if (first == std::string::npos) return;
  const std::size_t end = bytes.find(')', first);
  if (end != std::string::npos) bytes.replace(first, end + 1 - first, end + 1 - first, ' ');
}

}  // namespace

int Plot::add(const std::string& columns, std::vector<std::vector<double>> rows) {
  blocks.push_back({columns, std::move(rows)});
  return static_cast<int>(blocks.size()) - 1;
}

std::pair<double, double> value_range(const Plot& plot, const std::vector<int>& blocks, int column,
                                      bool positive) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const int b : blocks)
    for (const std::vector<double>& row : plot.blocks[static_cast<std::size_t>(b)].rows) {
      const double x = row[static_cast<std::size_t>(column)];
      if (!std::isfinite(x) || (positive && x <= 0.0)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
    }
  return {low, high};
}

std::string range_script(const Plot& plot, const std::string& axis, const std::vector<int>& blocks, int column,
                         bool logarithmic) {
  const auto [low, high] = value_range(plot, blocks, column, logarithmic);
  // Without any finite value, `low` is infinite and larger than `high`. If all values are equal, the range would have
  // no width. In both cases gnuplot chooses the range itself.
  if (!(low < high)) return "";
  const double factor = std::pow(10.0, 0.1);
  const double margin = 0.05 * (high - low);
  return logarithmic ? fmt::format("set {}range [{}:{}]\n", axis, low / factor, high * factor)
                     : fmt::format("set {}range [{}:{}]\n", axis, low - margin, high + margin);
}

std::string value_and_error(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return fmt::format("{:.3g}", value);
  // The first significant digit of the error e is at the decimal -floor(log10(e)), and the second digit is at the next
  // decimal. An error of 100 or more would give a negative number of decimals, so the number is at least 0.
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

void require_plot_name(const std::string& file) {
  const fs::path picture(file);
  if (terminal_for(picture.extension().string(), Plot{}).empty() || picture.stem().empty())
    throw InputError(file,
                     "the format of the picture cannot be told from this name: expected a name that ends in "
                     ".svg, .pdf or .png");
  if (const fs::path folder = picture.parent_path(); !folder.empty() && !fs::is_directory(folder))
    throw IoError(file, fmt::format("there is no directory {}", folder.string()));
}

void write_plot(const std::string& file, const Plot& plot) {
  require_plot_name(file);
  const fs::path picture(file);
  const fs::path data = fs::path(picture).replace_extension(".dat");
  const fs::path script = fs::path(picture).replace_extension(".gp");
  write_output(data.string(), data_of(plot));
  write_output(script.string(), script_of(plot, picture, data));
  // gnuplot draws to a temporary file: if gnuplot fails or is interrupted, an older picture with the final name does
  // not change.
  const TransientFile drawn(file + ".drawn"), words(file + ".words");
  run_gnuplot(script, drawn.path(), words.path());
  std::string bytes = read_file(drawn.path());
  blank_creation_date(bytes);
  write_output(file, bytes);
}

std::string plot_as_svg(const Plot& plot) {
  const ScratchDirectory directory;
  const std::string file = directory.path() + "/plot.svg";
  write_plot(file, plot);
  return read_file(file);
}

}  // namespace floc
