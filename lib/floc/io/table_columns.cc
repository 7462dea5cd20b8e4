#include "floc/io/table_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/table_units.h"
#include "floc/io/usual_names.h"

namespace floc {
namespace {

/// Returns the index of the header, in a list of headers, that satisfies a condition; nothing if no header satisfies
/// it.
/// @throws InputError if two headers satisfy the condition; the function `refuse` throws this error
std::optional<int> only_column(const std::vector<std::string>& headers,
                               const std::function<bool(const std::string&)>& is_wanted,
                               const std::function<void(int, int)>& refuse) {
  std::optional<int> found;
  for (int i = 0; i < static_cast<int>(headers.size()); ++i) {
    if (!is_wanted(headers[static_cast<std::size_t>(i)])) continue;
    if (found) refuse(*found, i);
    found = i;
  }
  return found;
}

}  // namespace

std::string NamedColumns::unit_of(int index) const {
  const std::string in_row = unit_in_cell(table_.unit_cell(index));
  if (!in_row.empty()) return in_row;
  if (const std::string unit = name_and_unit(table_.columns()[static_cast<std::size_t>(index)]).second;
      !unit.empty())
    return unit;
  for (const std::vector<std::string>& headers : table_.other_names())
    if (static_cast<std::size_t>(index) < headers.size())
      if (const std::string unit = name_and_unit(headers[static_cast<std::size_t>(index)]).second;
          !unit.empty())
        return unit;
  return "";
}

std::string NamedColumns::without_unit(const std::string& header) const {
  const std::string bare = name_and_unit(header).first;
  return header.ends_with("[1]") && table_.has(header.substr(0, header.size() - 2) + "2]") ? header : bare;
}

std::optional<UnitColumn> NamedColumns::with_header(const std::string& name, const std::string& header) const {
  const auto refuse = [&](int one, int other) {
    throw InputError(
        table_.place(),
        fmt::format("columns {} and {} of this table are both named \"{}\": rename or remove one of "
                    "them, or choose one by its whole header with --columns",
                    one + 1, other + 1, header));
  };
  const auto is_whole = [&](const std::string& h) { return h == header; };
  const auto is_bare = [&](const std::string& h) { return without_unit(h) == header; };
  // The comparison ignores a text in round brackets at the end of a header, which may be an unknown unit or a remark.
  const auto is_before_bracket = [&](const std::string& h) {
    return h.ends_with(')') && trimmed(std::string_view(h).substr(0, h.rfind('('))) == header;
  };
  const auto in = [&](const std::vector<std::string>& headers) -> std::optional<UnitColumn> {
    auto found = only_column(headers, is_whole, refuse);
    if (!found) found = only_column(headers, is_bare, refuse);
    if (!found) found = only_column(headers, is_before_bracket, refuse);
    return found ? std::optional(UnitColumn{*found, unit_of(*found)}) : std::nullopt;
  };
  if (const auto found = in(table_.columns())) return found;
  for (const std::vector<std::string>& headers : table_.other_names())
    if (const auto found = in(headers)) return found;
  const auto [bare, unit] = name_and_unit(header);
  if (!is_named(name) || bare == header) return std::nullopt;
  auto found = with_header(name, bare);
  if (found) {
    found->unit = unit;
    found->unit_is_given = true;
  }
  return found;
}

std::optional<UnitColumn> NamedColumns::find_exactly(const std::string& name) const {
  const auto given = names_.find(name);
  return with_header(name, given == names_.end() ? name : given->second);
}

std::optional<UnitColumn> NamedColumns::find(const std::string& name) const {
  if (is_named(name)) return unit_column(name);
  if (const auto found = find_exactly(name)) return found;
  const auto is_usual = [&](const std::string& header) {
    return is_usual_name(name, header) || is_usual_name(name, without_unit(header));
  };
  const auto refuse = [&](int one, int other) {
    throw InputError(table_.place(),
                     fmt::format("columns \"{}\" and \"{}\" may both be {}: choose one with --columns {}=...",
                                 table_.columns()[static_cast<std::size_t>(one)],
                                 table_.columns()[static_cast<std::size_t>(other)], name, name));
  };
  if (const auto found = only_column(table_.columns(), is_usual, refuse))
    return UnitColumn{*found, unit_of(*found)};
  for (const std::vector<std::string>& headers : table_.other_names())
    if (const auto found = only_column(headers, is_usual, refuse)) return UnitColumn{*found, unit_of(*found)};
  return std::nullopt;
}

UnitColumn NamedColumns::unit_column(const std::string& name) const {
  if (const auto found = is_named(name) ? find_exactly(name) : find(name)) return *found;
  throw InputError(table_.place(),
                   fmt::format("the table has no column \"{}\"; its columns are {}",
                               is_named(name) ? names_.at(name) : name, fmt::join(table_.columns(), ", ")));
}

std::optional<GivenNumber> NamedColumns::given_number(const std::string& name) const {
  const auto given = names_.find(name);
  if (given == names_.end() || find_exactly(name)) return std::nullopt;
  const auto [number, unit] = name_and_unit(given->second);
  const auto value = parse_number<double>(number);
  return value ? std::optional(GivenNumber{*value, unit}) : std::nullopt;
}

std::vector<std::string> wanted_names(std::vector<std::string> names, const ColumnNames& given) {
  for (const auto& [name, header] : given) {
    names.push_back(header);
    names.push_back(name_and_unit(header).first);
  }
  return names;
}

}  // namespace floc
