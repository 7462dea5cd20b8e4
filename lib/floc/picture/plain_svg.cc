#include "floc/picture/plain_svg.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

namespace floc {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A number without the zeros that end its decimals.
std::string short_coordinate(double x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// A path's data with its numbers shortened.
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

/// Text that precedes a name in an svg, beginnings of names that cairo counts, and text that precedes the data
/// of a path.
constexpr std::string_view kBeforeName[] = {"id=\"", "href=\"#", "url(#"};
constexpr std::string_view kCounted[] = {"surface", "image", "source-"};
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
  // Names whose number cairo counts through the process are numbered anew, in the order of their first
  // appearance, so that a definition and the references to it keep one name.
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
  // Only names depend on the process and only paths take much room, so that all other text is copied as it is.
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
