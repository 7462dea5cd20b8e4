#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/hdf5_file.h"
#include "floc/io/state_layout.h"

namespace floc {

/// Returns the unit of a physical quantity as text, for the attribute `units` of an array of a state file.
/// @param system  unit system of the state, "SI" or "reduced"
/// @param dim  dimension of the packing; the unit of the stress depends on it
std::string units_of(Quantity quantity, const std::string& system, int dim);

/// Storage of one item of type T (a number or a vector of a grain or contact) as a row of an array in a state file:
/// type of the stored numbers, number of components, and access to component k.
template <class T>
struct ArchiveItem {
  using Stored = double;
  static constexpr int kComponents = 1;
  static double get(const T& item, int) { return item; }
  static void set(T& item, int, double value) { item = value; }
};
template <>
struct ArchiveItem<int> {
  using Stored = std::int32_t;
  static constexpr int kComponents = 1;
  static std::int32_t get(int item, int) { return item; }
  static void set(int& item, int, std::int32_t value) { item = value; }
};
template <>
struct ArchiveItem<std::int64_t> {
  using Stored = std::int64_t;
  static constexpr int kComponents = 1;
  static std::int64_t get(std::int64_t item, int) { return item; }
  static void set(std::int64_t& item, int, std::int64_t value) { item = value; }
};
template <>
struct ArchiveItem<bool> {
  using Stored = std::uint8_t;
  static constexpr int kComponents = 1;
  static std::uint8_t get(bool item, int) { return item ? 1 : 0; }
  static void set(bool& item, int, std::uint8_t value) { item = value != 0; }
};
template <class T, int Rows>
struct ArchiveItem<Eigen::Matrix<T, Rows, 1>> {
  using Stored = std::conditional_t<std::is_same_v<T, int>, std::int32_t, double>;
  static constexpr int kComponents = Rows;
  static Stored get(const Eigen::Matrix<T, Rows, 1>& item, int k) { return item[k]; }
  static void set(Eigen::Matrix<T, Rows, 1>& item, int k, Stored value) { item[k] = value; }
};
template <>
struct ArchiveItem<Eigen::Quaterniond> {
  using Stored = double;
  static constexpr int kComponents = 4;
  static double get(const Eigen::Quaterniond& q, int k) { return k == 0 ? q.w() : q.vec()[k - 1]; }
  static void set(Eigen::Quaterniond& q, int k, double value) { (k == 0 ? q.w() : q.vec()[k - 1]) = value; }
};

/// Returns the shape of an array with one row for each of `n` items. If an item has only one component, the array is
/// one-dimensional.
inline ArrayShape shape_of(std::size_t n, int components) {
  if (components == 1) return {n};
  return {n, static_cast<std::uint64_t>(components)};
}

inline constexpr auto kItself = [](auto& item) -> auto& {
  return item;
};

/// Writes the arrays and attributes that state_layout.h describes to a state file.
class WritingArchive {
 public:
  WritingArchive(Hdf5Writer& file, std::string units, int dim)
      : file_(file), units_(std::move(units)), dim_(dim) {}

  template <class Items, class Get>
  void rows(const Field& field, const Items& items, const Get& get) {
    using Layout = ArchiveItem<std::remove_cvref_t<decltype(get(items.front()))>>;
    using Stored = typename Layout::Stored;
    const auto fill = [&](std::uint64_t first, std::span<Stored> values) {
      for (std::size_t next = 0; next < values.size(); ++first)
        for (int k = 0; k < Layout::kComponents; ++k) values[next++] = Layout::get(get(items[first]), k);
    };
    file_.template rows<Stored>(field.path, shape_of(items.size(), Layout::kComponents), fill);
    describe(field);
  }

  template <class Items>
  void column(const Field& field, const Items& items) {
    rows(field, items, kItself);
  }
  template <class Items>
  void column_if_there(const Field& field, const Items& items, std::size_t) {
    if (!items.empty()) column(field, items);
  }

  template <int Dim>
  void matrix(const Field& field, const Mat<Dim>& m) {
    std::vector<double> values;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) values.push_back(m(a, b));
    put(field, {Dim, Dim}, values);
  }

  template <class T>
  void put(const Field& field, const ArrayShape& shape, const std::vector<T>& values) {
    file_.array(field.path, shape, values);
    describe(field);
  }

  void value(const char* group, const char* name, int v) { file_.attribute(group, name, std::int64_t{v}); }
  template <class T>
  void value(const char* group, const char* name, const T& v) {
    file_.attribute(group, name, v);
  }
  /// Writes a value that is optional: ReadingArchive accepts files without this value, because some other versions of
  /// floc do not write it.
  template <class T>
  void value_if_there(const char* group, const char* name, const T& v) {
    value(group, name, v);
  }

 private:
  void describe(const Field& field) {
    file_.attribute(field.path, "units", units_of(field.quantity, units_, dim_));
    if (*field.meaning != '\0') file_.attribute(field.path, "meaning", std::string(field.meaning));
  }

  Hdf5Writer& file_;
  std::string units_;
  int dim_;
};

/// Reads the arrays and attributes that a WritingArchive has written. Throws InputError if an array has a wrong shape
/// or contains a number that is not finite.
class ReadingArchive {
 public:
  explicit ReadingArchive(const Hdf5Reader& file) : file_(file) {}

  /// Reads an array with one row per item. Row k is stored in get(items[k]), a member of item k.
  /// @pre `items` has one item for each row
  template <class Items, class Get>
  void rows(const Field& field, Items& items, const Get& get) {
    using Layout = ArchiveItem<std::remove_cvref_t<decltype(get(items.front()))>>;
    using Stored = typename Layout::Stored;
    const auto take = [&](std::uint64_t first, std::span<const Stored> values) {
      check_finite(field, first, Layout::kComponents, values);
      for (std::size_t next = 0; next < values.size(); ++first)
        for (int k = 0; k < Layout::kComponents; ++k) Layout::set(get(items[first]), k, values[next++]);
    };
    file_.template rows<Stored>(field.path, shape_of(items.size(), Layout::kComponents), take);
  }

  template <class Items>
  void column(const Field& field, Items& items) {
    rows(field, items, kItself);
  }
  template <class Items>
  void column_if_there(const Field& field, Items& items, std::size_t size) {
    if (!file_.has(field.path)) return;
    items.resize(size);
    column(field, items);
  }

  template <int Dim>
  void matrix(const Field& field, Mat<Dim>& m) {
    const auto values = take<double>(field, {Dim, Dim});
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) m(a, b) = values[a * Dim + b];
  }

  template <class T>
  std::vector<T> take(const Field& field, const ArrayShape& shape) {
    std::vector<T> values;
    file_.array(field.path, shape, values);
    const std::size_t rows = shape.empty() ? 1 : shape.front();  // the shape of a single value is empty
    if (rows > 0) check_finite(field, 0, values.size() / rows, std::span<const T>(values));
    return values;
  }

  void value(const char* group, const char* name, int& v) {
    std::int64_t wide = 0;
    file_.attribute(group, name, wide);
    v = static_cast<int>(wide);
  }
  template <class T>
  void value(const char* group, const char* name, T& v) {
    file_.attribute(group, name, v);
  }
  template <class T>
  void value_if_there(const char* group, const char* name, T& v) {
    if (file_.has_attribute(group, name)) value(group, name, v);
  }

 private:
  /// Checks that all numbers in a block of rows of an array are finite.
  /// @param first  number of the first row of the block in the array  @param components  count of numbers in a row
  template <class T>
  void check_finite(const Field& field, std::uint64_t first, std::size_t components,
                    std::span<const T> values) const {
    if constexpr (std::is_same_v<T, double>) {
      for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]))
          throw InputError(file_.place(field.path), fmt::format("entry {} is {}, expected a finite number",
                                                                first + k / components, values[k]));
    }
  }

  const Hdf5Reader& file_;
};

}  // namespace floc
