#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "binding.h"

namespace floc::python {
namespace {

template <class T>
bool holds_only(const Table& table, std::size_t column, bool undefined_too) {
  return std::ranges::all_of(table.rows, [&](const std::vector<TableValue>& row) {
    return std::holds_alternative<T>(row[column]) ||
           (undefined_too && std::holds_alternative<std::monostate>(row[column]));
  });
}

double number_of(const TableValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&value);
  return number == nullptr ? std::numeric_limits<double>::quiet_NaN() : *number;
}

template <class T, class Get>
py::array array_of(const Table& table, const Get& get) {
  py::array_t<T> array(static_cast<py::ssize_t>(table.rows.size()));
  T* values = array.mutable_data();
  for (const auto& row : table.rows) *values++ = get(row);
  return array;
}

py::object column_to_python(const Table& table, std::size_t k) {
  const bool numbers = std::ranges::none_of(table.rows, [k](const std::vector<TableValue>& row) {
    return std::holds_alternative<std::string>(row[k]) || std::holds_alternative<bool>(row[k]);
  });
  if (holds_only<std::int64_t>(table, k, false) && !table.rows.empty())
    return array_of<std::int64_t>(table, [k](const auto& row) { return std::get<std::int64_t>(row[k]); });
  if (holds_only<bool>(table, k, false) && !table.rows.empty())
    return array_of<bool>(table, [k](const auto& row) { return std::get<bool>(row[k]); });
  if (numbers) return array_of<double>(table, [k](const auto& row) { return number_of(row[k]); });
  py::list cells;
  for (const auto& row : table.rows) cells.append(to_python(row[k]));
  return py::module_::import("numpy").attr("array")(cells);
}

}  // namespace

void require_one_of(const std::string& name, const std::string& value,
                    std::initializer_list<const char*> words) {
  if (std::ranges::find(words, value) == words.end())
    throw InputError("", fmt::format("{} = \"{}\": expected one of {}", name, value, fmt::join(words, ", ")));
}

void require_tables(const std::vector<std::string>& tables, std::initializer_list<const char*> known) {
  for (const std::string& table : tables) require_one_of("tables", table, known);
}

bool contains(const std::vector<std::string>& tables, const char* name) {
  return std::ranges::find(tables, name) != tables.end();
}

py::object to_python(const TableValue& value) {
  struct {
    py::object operator()(std::monostate) const { return py::none(); }
    py::object operator()(bool flag) const { return py::bool_(flag); }
    py::object operator()(std::int64_t whole) const { return py::int_(whole); }
    py::object operator()(double number) const {
      // A number that is not finite stands for an undefined value. write_json() writes null for it, and Python gets
      // None, so that a result has the same value in a file and in Python.
      if (!std::isfinite(number)) return py::none();
      return py::float_(number);
    }
    py::object operator()(const std::string& text) const { return py::str(text); }
  } convert;
  return std::visit(convert, value);
}

py::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_float:
      // The conversion to TableValue replaces a number that is not finite by None.
      return to_python(TableValue{json.get<double>()});
    case Json::value_t::string:
      return py::str(json.get<std::string>());
    case Json::value_t::array: {
      py::list items;
      for (const Json& item : json) items.append(to_python(item));
      return items;
    }
    case Json::value_t::object: {
      py::dict members;
      for (const auto& [key, value] : json.items()) members[py::str(key)] = to_python(value);
      return members;
    }
    default:
      return py::none();
  }
}

py::tuple to_python(const Table& table) {
  py::list rows;
  for (const auto& row : table.rows) {
    py::list cells;
    for (const TableValue& value : row) cells.append(to_python(value));
    rows.append(cells);
  }
  return py::make_tuple(table.columns, rows);
}

py::dict columns_to_python(const Table& table) {
  py::dict columns;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    columns[py::str(table.columns[k])] = column_to_python(table, k);
  return columns;
}

}  // namespace floc::python
