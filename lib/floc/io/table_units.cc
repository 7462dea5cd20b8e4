#include "floc/io/table_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// A unit: the physical quantity that it measures, and the factor that converts it to SI units.
struct KnownUnit {
  std::string_view measures;
  double size;
};

struct NamedUnit {
  std::string_view name;
  KnownUnit unit;
  bool takes_prefix;
};

constexpr double kPoundForce = 4.4482216152605, kInch = 0.0254, kFoot = 0.3048, kPound = 0.45359237,
                 kAtmosphere = 101325.0, kGravity = 9.80665;

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
    {"kp/cm2", {"pressure", 1e4 * kGravity}, false},
    {"kp/cm²", {"pressure", 1e4 * kGravity}, false},
    {"kg/cm2", {"pressure", 1e4 * kGravity}, false},
    {"kg/cm²", {"pressure", 1e4 * kGravity}, false},
    {"t/m2", {"pressure", 1e3 * kGravity}, false},
    {"t/m²", {"pressure", 1e3 * kGravity}, false},
    {"psf", {"pressure", kPoundForce / (kFoot * kFoot)}, false},
    {"ksf", {"pressure", 1e3 * kPoundForce / (kFoot * kFoot)}, false},
    {"tsf", {"pressure", 2e3 * kPoundForce / (kFoot * kFoot)}, false},
    {"N/m", {"force per length", 1.0}, true},
    {"N/mm", {"force per length", 1e3}, true},
    {"N", {"force", 1.0}, true},
    {"kgf", {"force", kGravity}, false},
    {"lbf", {"force", kPoundForce}, false},
    {"m", {"length", 1.0}, true},
    {"in", {"length", kInch}, false},
    {"kg/m3", {"density", 1.0}, false},
    {"kg/m^3", {"density", 1.0}, false},
    {"kg/m³", {"density", 1.0}, false},
    {"g/cm3", {"density", 1e3}, false},
    {"g/cm^3", {"density", 1e3}, false},
    {"g/cm³", {"density", 1e3}, false},
    {"g/cc", {"density", 1e3}, false},
    {"g/ml", {"density", 1e3}, false},
    {"g/mL", {"density", 1e3}, false},
    {"kg/l", {"density", 1e3}, false},
    {"kg/L", {"density", 1e3}, false},
    {"Mg/m3", {"density", 1e3}, false},
    {"Mg/m^3", {"density", 1e3}, false},
    {"Mg/m³", {"density", 1e3}, false},
    {"t/m3", {"density", 1e3}, false},
    {"t/m^3", {"density", 1e3}, false},
    {"t/m³", {"density", 1e3}, false},
    {"lb/ft3", {"density", kPound / (kFoot * kFoot * kFoot)}, false},
    {"pcf", {"density", kPound / (kFoot * kFoot * kFoot)}, false},
    {"%", {"share", 1e-2}, false},
    {"percent", {"share", 1e-2}, false},
    {"Prozent", {"share", 1e-2}, false},
    {"pct", {"share", 1e-2}, false},
    {"vol%", {"share", 1e-2}, false},
    {"vol.%", {"share", 1e-2}, false},
    {"Vol%", {"share", 1e-2}, false},
    {"Vol.-%", {"share", 1e-2}, false},
    {"‰", {"share", 1e-3}, false},
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

/// Corrects common wrong spellings of SI units of pressure. Returns any other text unchanged.
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

/// If a text is enclosed in brackets, returns it without the brackets, else unchanged.
std::string_view without_brackets(std::string_view text) {
  text = trimmed(text);
  const bool enclosed = text.size() > 2 && ((text.front() == '[' && text.back() == ']') ||
                                            (text.front() == '(' && text.back() == ')'));
  return enclosed ? trimmed(text.substr(1, text.size() - 2)) : text;
}

/// Whether a text in round brackets at the end of a header is not a unit, but a remark or a symbol, as in "sigma
/// (effective)" and "Void ratio (e)".
bool is_remark(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.'; };
  return !unit_of(text) && std::all_of(text.begin(), text.end(), is_letter);
}

/// Splits a header that ends with a unit in brackets into name and unit. Returns nothing for other headers.
std::optional<std::pair<std::string, std::string>> split_brackets(const std::string& header) {
  const bool closed = !header.empty() && (header.back() == ']' || header.back() == ')');
  const std::size_t open = closed ? header.rfind(header.back() == ']' ? '[' : '(') : std::string::npos;
  if (open == std::string::npos || open == 0) return std::nullopt;
  const std::string unit(trimmed(std::string_view(header).substr(open + 1, header.size() - open - 2)));
  // A number in brackets is an index, as in the name "c_force[2]" of LAMMPS.
  if ((header.back() == ')' && is_remark(unit)) || (unit != "1" && parse_number<int>(unit)))
    return std::nullopt;
  return std::pair(std::string(trimmed(header.substr(0, open))), unit == "-" || unit == "1" ? "" : unit);
}

/// Whether a text is a unit that is unlikely to be a part of a name. The result is false for "bar" and "N", which may
/// be parts of names such as "sigma_bar" and "F_N".
bool is_clear_unit(const std::string& text) {
  constexpr std::array<std::string_view, 7> kClear = {"psi", "ksi", "mm", "cm", "um", "µm", "pcf"};
  const auto known = unit_of(text);
  if (!known) return false;
  const bool is_pascal = text.ends_with("Pa") || (text.size() > 2 && respelled(text).ends_with("Pa"));
  return known->measures == "share" || text.find('/') != std::string::npos || is_pascal ||
         std::find(kClear.begin(), kClear.end(), text) != kClear.end();
}

}  // namespace

std::pair<std::string, std::string> name_and_unit(const std::string& header) {
  if (const auto split = split_brackets(header)) return *split;
  for (const std::string_view mark : {", ", " in ", " ", "/", "_"}) {
    const std::size_t at = header.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string unit(trimmed(std::string_view(header).substr(at + mark.size())));
    const bool is_part_of_names = mark == " " || mark == "_";
    if (is_part_of_names ? is_clear_unit(unit) : unit_of(unit).has_value())
      return {std::string(trimmed(header.substr(0, at))), unit};
  }
  return {header, ""};
}

bool states_no_unit(std::string_view unit) {
  const std::string_view bare = without_brackets(unit);
  return bare == "-" || bare == "–" || (bare == "1" && bare.size() < unit.size());
}

std::string unit_in_cell(std::string_view cell) {
  const std::string unit(without_brackets(cell));
  return states_no_unit(cell) || (unit.size() == cell.size() && !unit_of(unit)) ? "" : unit;
}

std::string quantity_of_unit(const std::string& unit) {
  const auto known = unit_of(unit);
  return known ? std::string(known->measures) : "";
}

double share_of_one(const std::string& place, const std::string& unit) {
  if (unit.empty() || unit == "-" || unit == "1") return 1.0;
  const auto known = unit_of(unit);
  if (known && known->measures == "share") return known->size;
  throw InputError(place, fmt::format("found the unit {} here: expected a number without unit, or in %", unit));
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
