#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/io/table.h"

namespace floc {

using Json = nlohmann::ordered_json;

/// null for a number that is absent or not finite.
Json number_or_null(const std::optional<double>& x);

/// {name: {value, stderr, low95, high95, identified}}.
Json parameters_as_json(const std::vector<FittedParameter>& parameters);

/// Cells value, stderr, low95, high95, identified of one parameter.
std::vector<TableValue> parameter_cells(const FittedParameter& parameter);

/// Prints on stdout: `json` if that is the format, otherwise the table; on a terminal only its first `n_short`
/// columns, where the words on stderr say the rest. @throws IoError if stdout cannot take it.
void print_fit(const Json& json, Table table, std::size_t n_short, const std::string& format);

}  // namespace floc
