#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Returns the mean of independent values, such as those of several samples, with Student's interval. Of a single
/// value there is no interval.
FittedParameter mean_of_samples(const std::string& name, const std::vector<double>& values);

/// Returns the mean of successive values that are correlated, such as those along the path of one sample. Its interval is
/// that of the means of five successive batches of equal length, which are taken as independent: the correlation has to
/// fade within a batch. Fewer than ten values give no interval.
FittedParameter mean_along_path(const std::string& name, const std::vector<double>& values);

}  // namespace floc
