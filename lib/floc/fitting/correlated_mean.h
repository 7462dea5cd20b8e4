#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Returns the mean of independent values, such as one value per sample, with the interval of the mean by Student's t.
/// For a single value, there is no interval.
FittedParameter mean_of_samples(const std::string& name, const std::vector<double>& values);

/// Returns the mean of successive correlated values, such as the values along the load path of one sample. The values
/// are divided into five successive batches of equal length. The interval of the mean is computed from the means of
/// these batches, which count as independent. The correlation length must therefore be shorter than one batch. With
/// fewer than ten values, there is no interval.
FittedParameter mean_along_path(const std::string& name, const std::vector<double>& values);

}  // namespace floc
