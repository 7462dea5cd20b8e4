#include "fit_parameters.h"

#include <cmath>
#include <iostream>

#include "finish_output.h"
#include "floc/base/error.h"
#include "output.h"
#include "printed_columns.h"

namespace floc {

Json number_or_null(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}

Json parameters_as_json(const std::vector<FittedParameter>& parameters) {
  Json object = Json::object();
  for (const FittedParameter& p : parameters)
    object[p.name] = {{"value", number_or_null(p.value)},
                      {"stderr", number_or_null(p.standard_error)},
                      {"low95", number_or_null(p.low95)},
                      {"high95", number_or_null(p.high95)},
                      {"identified", p.identified}};
  return object;
}

std::vector<TableValue> parameter_cells(const FittedParameter& p) {
  const auto cell = [](const std::optional<double>& x) { return x ? TableValue(*x) : TableValue(); };
  return {cell(p.value), cell(p.standard_error), cell(p.low95), cell(p.high95), p.identified};
}

void print_fit(const Json& json, Table table, std::size_t n_short, const std::string& format) {
  if (format == "json") {
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    finish_output();
    return;
  }
  if (chosen_format(format) == TableFormat::table && !columns_are_chosen()) {
    table.columns.resize(std::min(n_short, table.columns.size()));
    for (auto& row : table.rows) row.resize(table.columns.size());
  }
  print_table(table, format);
}

}  // namespace floc
