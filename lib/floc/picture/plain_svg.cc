#include "floc/picture/plain_svg.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

namespace floc {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Formats a number with at most two decimals, without trailing zeros.
std::string short_coordinate(double x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// Appends the data of an svg path to `out`, with shortened numbers.
void append_path(std::string_view path, std::string& out) {
  for (std::size_t i = 0; i < path.size();) {
    double x = 0.0;
    const auto [end, error] = std::from_chars(path.data() + i, path.data() + path.size(), x);
    if (error == std::errc{}) {
      out += short_coordinate(x);
      i = static_cast<std::size_t>(end - path.data());
    } else {
      out += path[i++];
    }
  }
}

/// Texts in an svg that are followed by the name of an element.
constexpr std::string_view kBeforeName[] = {"id=\"", "href=\"#", "url(#"};
/// Beginnings of names to which cairo appends a number, such as "surface12".
constexpr std::string_view kCounted[] = {"surface", "image", "source-"};
/// Text in an svg that is followed by the coordinates of a path.
constexpr std::string_view kBeforePath = " d=\"";

}  // namespace

std::string plain_svg(std::string_view svg) {
  std::string out;
  out.reserve(svg.size());
  std::map<std::string, std::size_t, std::less<>> numbers;
  std::size_t i = 0;
  const auto take = [&](std::string_view text) {
    if (!svg.substr(i).starts_with(text)) return false;
    out += text;
    i += text.size();
    return true;
  };
  // Copies the name of an element, but with a new number. Names are numbered in the order in which they first appear.
  // The definition of an element and all references to it get the same number.
  const auto take_name = [&] {
    for (const std::string_view prefix : kCounted) {
      if (!take(prefix)) continue;
      const std::size_t first = i;
      while (i < svg.size() && is_digit(svg[i])) ++i;
      const std::string name = std::string(prefix) + std::string(svg.substr(first, i - first));
      out += std::to_string(numbers.emplace(name, numbers.size() + 1).first->second);
      return;
    }
  };
  // All text is copied unchanged except the names of elements, which depend on earlier drawings of the process, and
  // paths, which take much space.
  while (i < svg.size()) {
    bool taken = false;
    for (const std::string_view before : kBeforeName)
      if (!taken && take(before)) {
        take_name();
        taken = true;
      }
    if (!taken && take(kBeforePath)) {
      const std::size_t end = std::min(svg.find('"', i), svg.size());
      append_path(svg.substr(i, end - i), out);
      i = end;
      taken = true;
    }
    if (!taken) out += svg[i++];
  }
  return out;
}

}  // namespace floc
