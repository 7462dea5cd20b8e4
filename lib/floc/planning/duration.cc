#include "floc/planning/duration.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// Unit of durations, with the words that denote the unit. Durations are printed with the first word.
struct DurationUnit {
  double seconds;
  std::vector<std::string> words;
};

const std::vector<DurationUnit>& duration_units() {
  constexpr double kDay = 86400.0;
  static const std::vector<DurationUnit> units = {{1.0, {"s", "sec", "second", "seconds"}},
                                                  {60.0, {"min", "minute", "minutes"}},
                                                  {3600.0, {"h", "hour", "hours"}},
                                                  {kDay, {"d", "day", "days"}},
                                                  {365.25 * kDay, {"y", "year", "years"}}};
  return units;
}

std::optional<double> seconds_of(const std::string& word) {
  if (word.empty()) return 1.0;
  for (const DurationUnit& unit : duration_units())
    for (const std::string& known : unit.words)
      if (word == known) return unit.seconds;
  return std::nullopt;
}

}  // namespace

double duration_of(const std::string& name, const std::string& text) {
  // An "e" followed by a digit or a sign is part of a number such as 1e3.
  std::size_t end = text.find_first_not_of("+-.0123456789");
  if (end != std::string::npos && (text[end] == 'e' || text[end] == 'E'))
    end = text.find_first_not_of("+-.0123456789", end + 1);
  const std::string number = text.substr(0, end);
  std::string word = end == std::string::npos ? "" : text.substr(end);
  word.erase(0, word.find_first_not_of(' '));
  const auto value = parse_number<double>(number);
  const auto unit = seconds_of(word);
  const double seconds = value && unit ? *value * *unit : 0.0;
  if (!(seconds > 0.0) || !std::isfinite(seconds))
    throw InputError(
        name + " " + text,
        "expected a positive number with one of the units s, min, h, d and y, such as 90s, 30min, 2h, "
        "1.5d or 1y");
  return seconds;
}

std::string duration_in_words(double seconds) {
  const DurationUnit* best = &duration_units().front();
  for (const DurationUnit& unit : duration_units())
    if (seconds >= unit.seconds) best = &unit;
  return fmt::format("{:.3g} {}", seconds / best->seconds, best->words.front());
}

}  // namespace floc
