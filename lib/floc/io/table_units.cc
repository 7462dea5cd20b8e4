#include "floc/io/table_units.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// A unit: name of the physical quantity that it measures, and size of the unit in SI units.
struct KnownUnit {
  std::string_view measures;
  double size;
};

struct NamedUnit {
  std::string_view name;
  KnownUnit unit;
  bool takes_prefix;
};

constexpr double kPoundForce = 4.4482216152605, kInch = 0.0254, kAtmosphere = 101325.0, kGravity = 9.80665;

constexpr auto kUnits = std::to_array<NamedUnit>({
    {"Pa", {"pressure", 1.0}, true},
    {"N/m2", {"pressure", 1.0}, true},
    {"N/m^2", {"pressure", 1.0}, true},
    {"N/m²", {"pressure", 1.0}, true},
    {"N/mm2", {"pressure", 1e6}, true},
    {"N/mm^2", {"pressure", 1e6}, true},
    {"N/mm²", {"pressure", 1e6}, true},
    {"N/cm2", {"pressure", 1e4}, true},
    {"N/cm^2", {"pressure", 1e4}, true},
    {"N/cm²", {"pressure", 1e4}, true},
    {"bar", {"pressure", 1e5}, true},
    {"atm", {"pressure", kAtmosphere}, false},
    {"psi", {"pressure", kPoundForce / (kInch * kInch)}, false},
    {"ksi", {"pressure", 1e3 * kPoundForce / (kInch * kInch)}, false},
    {"kgf/cm2", {"pressure", 1e4 * kGravity}, false},
    {"kgf/cm^2", {"pressure", 1e4 * kGravity}, false},
    {"kgf/cm²", {"pressure", 1e4 * kGravity}, false},
    {"N/m", {"force per length", 1.0}, true},
    {"N/mm", {"force per length", 1e3}, true},
    {"N", {"force", 1.0}, true},
    {"kgf", {"force", kGravity}, false},
    {"lbf", {"force", kPoundForce}, false},
    {"m", {"length", 1.0}, true},
    {"in", {"length", kInch}, false},
});

constexpr auto kPrefixes = std::to_array<std::pair<std::string_view, double>>({{"T", 1e12},
                                                                               {"G", 1e9},
                                                                               {"M", 1e6},
                                                                               {"k", 1e3},
                                                                               {"h", 1e2},
                                                                               {"c", 1e-2},
                                                                               {"m", 1e-3},
                                                                               {"u", 1e-6},
                                                                               {"µ", 1e-6},
                                                                               {"μ", 1e-6},
                                                                               {"n", 1e-9},
                                                                               {"p", 1e-12}});

/// Returns the correct SI name of a unit of pressure for common wrong spellings, and any other text unchanged.
std::string respelled(const std::string& text) {
  if (text == "pa" || text == "PA") return "Pa";
  if (text == "kpa" || text == "KPa" || text == "Kpa" || text == "KPA") return "kPa";
  if (text == "Mpa" || text == "MPA") return "MPa";
  if (text == "Gpa" || text == "GPA") return "GPa";
  return text;
}

std::optional<KnownUnit> unit_of(const std::string& text) {
  const std::string name = respelled(text);
  for (const NamedUnit& known : kUnits)
    if (name == known.name) return known.unit;
  for (const auto& [prefix, factor] : kPrefixes) {
    if (!name.starts_with(prefix)) continue;
    for (const NamedUnit& known : kUnits)
      if (known.takes_prefix && name.substr(prefix.size()) == known.name)
        return KnownUnit{known.unit.measures, factor * known.unit.size};
  }
  return std::nullopt;
}

}  // namespace

std::pair<std::string, std::string> name_and_unit(const std::string& header) {
  const bool closed = !header.empty() && (header.back() == ']' || header.back() == ')');
  const std::size_t open = closed ? header.rfind(header.back() == ']' ? '[' : '(') : std::string::npos;
  if (open == std::string::npos || open == 0) return {header, ""};
  const std::string unit(trimmed(std::string_view(header).substr(open + 1, header.size() - open - 2)));
  return {std::string(trimmed(header.substr(0, open))), unit == "-" || unit == "1" ? "" : unit};
}

double unit_factor(const std::string& place, const std::string& unit, const std::string& other,
                   const std::string& wanted) {
  if (unit == wanted) return 1.0;
  const auto named = [](const std::string& text) { return text.empty() ? "no unit" : "the unit " + text; };
  const auto from = unit_of(unit), to = unit_of(wanted);
  if (!from || !to || from->measures != to->measures)
    throw InputError(
        place,
        fmt::format("found {} here, but {} has {}: expected two known units of one quantity, such as kPa "
                    "and Pa, or the same unit in both",
                    named(unit), other, named(wanted)));
  return from->size / to->size;
}

std::vector<std::string> known_units() {
  std::vector<std::string> names;
  for (const NamedUnit& known : kUnits) names.emplace_back(known.name);
  return names;
}

}  // namespace floc
