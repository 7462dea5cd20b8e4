#include "floc/io/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <type_traits>

namespace floc {
namespace {

/// Returns a value as text; empty if the value is undefined.
/// @param number  format string for a real number
std::string to_text(const TableValue& value, const char* number) {
  return std::visit(
      [number](const auto& v) -> std::string {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return "";
        } else if constexpr (std::is_same_v<T, double>) {
          return std::isfinite(v) ? fmt::format(fmt::runtime(number), v) : "";
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void write_csv(std::ostream& out, const Table& table) {
  const auto line = [&out](const std::vector<std::string>& cells) {
    out << fmt::format("{}\n", fmt::join(cells, ","));
  };
  std::vector<std::string> cells;
  for (const std::string& column : table.columns) cells.push_back(csv_quoted(column));
  line(cells);
  for (const auto& row : table.rows) {
    cells.clear();
    // Without a precision, fmt prints a number with the fewest digits from which the same number is read back.
    for (const TableValue& value : row) cells.push_back(csv_quoted(to_text(value, "{}")));
    line(cells);
  }
}

void write_json(std::ostream& out, const Table& table) {
  nlohmann::ordered_json objects = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      nlohmann::ordered_json& cell = object[table.columns[k]];
      std::visit(
          [&cell](const auto& v) {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<T, double>) {
              if (std::isfinite(v)) cell = v;
            } else if constexpr (!std::is_same_v<T, std::monostate>) {
              cell = v;
            }
          },
          row[k]);
    }
    objects.push_back(std::move(object));
  }
  out << objects.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

void write_aligned(std::ostream& out, const Table& table) {
  std::vector<std::vector<std::string>> cells = {table.columns};
  for (const auto& row : table.rows) {
    auto& texts = cells.emplace_back();
    for (const TableValue& value : row) {
      const std::string text = to_text(value, "{:.6g}");
      texts.push_back(text.empty() ? "-" : text);
    }
  }
  std::vector<std::size_t> width(table.columns.size(), 0);
  for (const auto& line : cells)
    for (std::size_t k = 0; k < line.size(); ++k) width[k] = std::max(width[k], line[k].size());
  for (const auto& line : cells) {
    std::string text;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const bool is_text = !table.rows.empty() && std::holds_alternative<std::string>(table.rows.front()[k]);
      text += is_text ? fmt::format("{:<{}}  ", line[k], width[k]) : fmt::format("{:>{}}  ", line[k], width[k]);
    }
    out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
  }
}

}  // namespace

TableValue or_undefined(const std::optional<double>& number) {
  return number ? TableValue{*number} : TableValue{};
}

TableValue or_undefined(const std::string& text) {
  return text.empty() ? TableValue{} : TableValue{text};
}

void write_table(std::ostream& out, const Table& table, TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return write_csv(out, table);
    case TableFormat::json:
      return write_json(out, table);
    case TableFormat::table:
      return write_aligned(out, table);
  }
}

}  // namespace floc
