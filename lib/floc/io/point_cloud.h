#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Points with arrays of data, as the formats of VTK store them. The arrays that describe grains are radius (or r, or
/// diameter) and, optionally, mass and id; their names may have capital letters.
struct PointCloud {
  std::string path;
  std::vector<double> x;  ///< coordinates, three per point (length)
  /// indices of the points that are grains; if empty, all points are grains
  std::vector<std::size_t> grains;
  std::vector<std::string> arrays;                              ///< names of the arrays of point data
  std::function<std::vector<double>(const std::string&)> read;  ///< returns the numbers of an array
  std::function<std::string(const std::string&)> place;         ///< returns the place of an array in messages
  ListedSpace space;
  std::optional<std::vector<ListedContact>> contacts;
};

/// Makes a packing with one grain at each point. `options.columns` renames the arrays; `options.law` is required.
/// @throws InputError naming file and array for a missing or malformed array
Imported read_points(const PointCloud& cloud, const ImportOptions& options);

}  // namespace floc
