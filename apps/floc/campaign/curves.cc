#include "campaign/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "floc/base/parse_number.h"
#include "plots/html.h"

namespace floc {
namespace {

/// One point of a curve: the mean of a quantity over the samples of a case, with the lowest and the highest value among
/// the samples. The points of a curve are in the order of the load path.
struct Point {
  std::string branch;
  double P_star, mean, low, high;
};

/// The curves of one quantity, each a list of points. The key is the label of the case.
using Curves = std::map<std::string, std::vector<Point>>;

Curves curves_of(const CsvTable& means, const std::string& quantity) {
  Curves curves;
  const int name = means.column("quantity"), label = means.column("case"), P_star = means.column("P_star");
  for (int row = 0; row < means.n_rows(); ++row) {
    const auto P = parse_number<double>(means.text(row, P_star));
    if (means.text(row, name) != quantity || !P || *P <= 0.0) continue;
    curves[means.text(row, label)].push_back(
        {means.text(row, means.column("branch")), *P, means.number(row, means.column("mean")),
         means.number(row, means.column("low")), means.number(row, means.column("high"))});
  }
  return curves;
}

/// One axis of a plot of curves.
struct Axis {
  double low, high;   ///< values at the ends of the axis
  double begin, end;  ///< coordinates of the ends of the axis on the page (svg user units)
  bool logarithmic = false;

  double place(double value) const {
    const double share =
        logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return begin + share * (end - begin);
  }
};

/// Returns an axis that contains the values from `low` to `high`, with a margin at both ends.
Axis axis_of(double low, double high, double begin, double end, bool logarithmic) {
  if (logarithmic) {
    const double air = std::max(std::pow(high / low, 0.04), 1.05);
    return {low / air, high * air, begin, end, true};
  }
  const double air = high > low ? 0.06 * (high - low) : high != 0.0 ? 0.05 * std::abs(high) : 1.0;
  return {low - air, high + air, begin, end, false};
}

/// Returns the values at which an axis has tick marks: four to ten round numbers. A logarithmic axis has marks at
/// powers of ten and, if it is short, at 2 and 5 times powers of ten.
std::vector<double> marks_of(const Axis& axis) {
  std::vector<double> marks;
  if (axis.logarithmic) {
    const bool wide = axis.high / axis.low > 30.0;
    for (int decade = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, decade) <= axis.high;
         ++decade)
      for (const double factor : {1.0, 2.0, 5.0})
        if (const double x = factor * std::pow(10.0, decade);
            x >= axis.low && x <= axis.high && (factor == 1.0 || !wide))
          marks.push_back(x);
    return marks;
  }
  const double size = std::pow(10.0, std::floor(std::log10((axis.high - axis.low) / 4.0)));
  const double span = (axis.high - axis.low) / size;
  const double step = size * (span > 20.0 ? 5.0 : span > 10.0 ? 2.0 : 1.0);
  for (double k = std::ceil(axis.low / step); k * step <= axis.high; ++k) marks.push_back(k * step);
  return marks;
}

constexpr double kWidth = 560.0, kHeight = 380.0, kLeft = 70.0, kRight = 14.0, kTop = 14.0, kBottom = 50.0;

std::string axes_svg(const Axis& x, const Axis& y, const std::string& quantity, const std::string& pressure) {
  std::string out =
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#555\"/>\n", kLeft,
                  kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  for (const double mark : marks_of(x))
    out += fmt::format(
        "<path d=\"M{0:.1f} {1} v-5\" stroke=\"#555\"/><text x=\"{0:.1f}\" y=\"{2}\" "
        "text-anchor=\"middle\">{3:.6g}</text>\n",
        x.place(mark), kHeight - kBottom, kHeight - kBottom + 17.0, mark);
  for (const double mark : marks_of(y))
    out += fmt::format(
        "<path d=\"M{1} {0:.1f} h5\" stroke=\"#555\"/><text x=\"{2}\" y=\"{3:.1f}\" "
        "text-anchor=\"end\">{4:.6g}</text>\n",
        y.place(mark), kLeft, kLeft - 6.0, y.place(mark) + 4.0, mark == 0.0 ? 0.0 : mark);
  const double middle = 0.5 * (kTop + kHeight - kBottom);
  return out + fmt::format(
                   "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n<text transform=\"translate(16 "
                   "{}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                   0.5 * (kLeft + kWidth - kRight), kHeight - 10.0, pressure, middle, html_text(quantity));
}

/// Draws the points of one branch of the load path: a band from the lowest to the highest value of the samples, a line
/// through the means, and a mark at each mean.
std::string branch_svg(const std::vector<Point>& points, const Axis& x, const Axis& y,
                       const std::string& colour, bool dashed) {
  std::string up, down, line, marks;
  for (const Point& p : points) {
    up += fmt::format("{:.2f},{:.2f} ", x.place(p.P_star), y.place(p.high));
    down = fmt::format("{:.2f},{:.2f} ", x.place(p.P_star), y.place(p.low)) + down;
    line += fmt::format("{:.2f},{:.2f} ", x.place(p.P_star), y.place(p.mean));
    marks += fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.4\" fill=\"{}\"><title>P* = {:.4g}: {:.6g} ({:.6g} "
        "to {:.6g})</title></circle>\n",
        x.place(p.P_star), y.place(p.mean), dashed ? "white\" stroke=\"" + colour : colour, p.P_star, p.mean,
        p.low, p.high);
  }
  return fmt::format(
             "<polygon class=\"band\" points=\"{}{}\" fill=\"{}\" fill-opacity=\"0.18\"/>\n<polyline "
             "points=\"{}\" "
             "fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{}/>\n",
             up, down, colour, line, colour, dashed ? " stroke-dasharray=\"5 3\"" : "") +
         marks;
}

/// Draws the curve of one case. Branches of the load path after the first loading are dashed.
std::string curve_svg(const std::vector<Point>& points, const Axis& x, const Axis& y, const std::string& label,
                      const std::string& colour) {
  std::string out = fmt::format("<g class=\"curve\" data-case=\"{}\">\n", html_text(label));
  std::string first;
  for (std::size_t k = 0; k < points.size();) {
    std::vector<Point> branch;
    const std::string name = points[k].branch;
    for (; k < points.size() && points[k].branch == name; ++k) branch.push_back(points[k]);
    if (first.empty() && name != "assembly") first = name;
    out += branch_svg(branch, x, y, colour, name != "assembly" && name != first);
  }
  return out + "</g>\n";
}

}  // namespace

std::string curve_colour(std::size_t number) {
  // Colours of the palette of Okabe and Ito, which colour-blind readers can distinguish.
  constexpr std::array<const char*, 8> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000", "#8B7500"};
  return kColours[number % kColours.size()];
}

std::vector<std::string> curve_quantities(const CsvTable& means) {
  std::vector<std::string> quantities, found;
  for (int row = 0; row < means.n_rows(); ++row)
    if (const std::string& name = means.text(row, means.column("quantity"));
        std::count(quantities.begin(), quantities.end(), name) == 0)
      quantities.push_back(name);
  for (const std::string& quantity : quantities) {
    const Curves curves = curves_of(means, quantity);
    if (std::any_of(curves.begin(), curves.end(), [](const auto& curve) {
          std::set<double> pressures;
          for (const Point& p : curve.second) pressures.insert(p.P_star);
          return pressures.size() > 1;
        }))
      found.push_back(quantity);
  }
  return found;
}

std::string curves_svg(const CsvTable& means, const std::string& quantity,
                       const std::vector<std::string>& labels, const std::string& pressure) {
  const Curves curves = curves_of(means, quantity);
  double P_low = INFINITY, P_high = 0.0, low = INFINITY, high = -INFINITY;
  for (const auto& [label, points] : curves)
    for (const Point& p : points) {
      P_low = std::min(P_low, p.P_star);
      P_high = std::max(P_high, p.P_star);
      low = std::min(low, p.low);
      high = std::max(high, p.high);
    }
  const Axis x = axis_of(P_low, P_high, kLeft, kWidth - kRight, true);
  // the axis is logarithmic if the ratio of the highest to the lowest value is larger than this number
  constexpr double kDecades = 50.0;
  const Axis y = axis_of(low, high, kHeight - kBottom, kTop, low > 0.0 && high / low > kDecades);
  std::string out =
      fmt::format("<svg class=\"curves\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{} against P*\">\n",
                  kWidth, kHeight, html_text(quantity)) +
      axes_svg(x, y, quantity, pressure);
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (const auto curve = curves.find(labels[k]); curve != curves.end())
      out += curve_svg(curve->second, x, y, labels[k], curve_colour(k));
  return out + "</svg>\n";
}

}  // namespace floc
