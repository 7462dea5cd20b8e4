#include "floc/io/point_cloud.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/listed_columns.h"
#include "floc/io/listed_packing.h"

namespace floc {
namespace {

/// An array with one number per point.
class PointArray {
 public:
  PointArray(const PointCloud& cloud, const std::string& name, std::size_t n_points)
      : place_(cloud.place(name)),
        before_number_(std::make_shared<const std::string>(place_ + ", point ")),
        values_(cloud.read(name)) {
    if (values_.size() != n_points)
      throw InputError(place_, fmt::format("the array has {} numbers, expected one for each of {} points",
                                           values_.size(), n_points));
  }

  std::string place(std::size_t point) const { return numbered_place(point).text(); }
  FileLine numbered_place(std::size_t point) const { return {before_number_, static_cast<int>(point)}; }
  double operator[](std::size_t point) const { return values_[point]; }
  std::int64_t whole(std::size_t point) const {
    if (const auto number = whole_number(values_[point])) return *number;
    throw InputError(place(point),
                     fmt::format("this entry of the array is {}, expected a whole number", values_[point]));
  }
  double positive(std::size_t point) const {
    if (values_[point] > 0.0) return values_[point];
    throw InputError(place(point),
                     fmt::format("this entry of the array is {}, must be positive", values_[point]));
  }

 private:
  std::string place_;
  std::shared_ptr<const std::string> before_number_;
  std::vector<double> values_;
};

/// Returns the name, in the file, of the array that floc calls `name`; an empty text if the file has no such array.
std::string find_array(const PointCloud& cloud, const ImportOptions& options, const std::string& name) {
  if (const auto given = options.columns.find(name); given != options.columns.end()) return given->second;
  const std::string found = any_case(name, cloud.arrays);
  return std::find(cloud.arrays.begin(), cloud.arrays.end(), found) == cloud.arrays.end() ? "" : found;
}

std::vector<ListedGrain> grains_of(const PointCloud& cloud, const ImportOptions& options) {
  const std::size_t n_points = cloud.x.size() / 3;
  std::vector<std::pair<SizeColumn, PointArray>> sizes;
  // `has` ignores the names that the user gave, because size_columns() itself prefers them to the names in the file.
  const auto has = [&](const std::string& name) { return !find_array(cloud, {}, name).empty(); };
  for (const SizeColumn& size : size_columns(has, options.columns))
    sizes.emplace_back(size, PointArray(cloud, find_array(cloud, options, size.name), n_points));
  if (sizes.empty())
    throw InputError(cloud.path,
                     fmt::format("the file has no point array radius or diameter; its point arrays are {}",
                                 fmt::join(cloud.arrays, ", ")));
  std::optional<PointArray> mass, id;
  if (const auto name = find_array(cloud, options, "mass"); !name.empty()) mass.emplace(cloud, name, n_points);
  if (const auto name = find_array(cloud, options, "id"); !name.empty()) id.emplace(cloud, name, n_points);
  const std::vector<double>& x = cloud.x;
  std::vector<std::size_t> points = cloud.grains;
  if (points.empty())
    for (std::size_t k = 0; k < n_points; ++k) points.push_back(k);
  std::vector<ListedGrain> grains;
  for (const std::size_t point : points) {
    ListedGrain grain;
    grain.place = sizes.front().second.numbered_place(point);
    grain.id = id ? id->whole(point) : static_cast<std::int64_t>(point);
    grain.position = {x[3 * point], x[3 * point + 1], x[3 * point + 2]};
    // All arrays that give a size are compared, because a radius and a diameter in one file may contradict each other.
    // A radius of zero means that no array has been read yet.
    for (const auto& [size, array] : sizes) {
      const double radius = array.positive(point) * size.radius_of_one;
      if (grain.radius != 0.0) require_same_size(grain.place, sizes.front().first, grain.radius, size, radius);
      if (grain.radius == 0.0) grain.radius = radius;
    }
    if (mass) grain.mass = mass->positive(point);
    grains.push_back(std::move(grain));
  }
  return grains;
}

}  // namespace

Imported read_points(const PointCloud& cloud, const ImportOptions& options) {
  if (options.index.value_or(0) != 0)
    throw InputError(
        cloud.path,
        fmt::format("index = {}, but the file contains only one packing, whose index is 0: leave out --index",
                    *options.index));
  check_grain_columns("--columns", options.columns);
  ListedPacking listed = listed_packing(cloud.path, options);
  listed.grains = grains_of(cloud, options);
  listed.space = cloud.space;
  listed.contacts = cloud.contacts;
  return assemble(std::move(listed), options);
}

}  // namespace floc
