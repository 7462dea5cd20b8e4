#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// The library refused what it was asked for: memory or, in reading, a file that is damaged inside.
class Hdf5Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Shape of an array, slowest index first.
using Shape = std::vector<std::uint64_t>;

/// Builds an HDF5 file in memory. Nothing in it depends on the clock: the same calls give the same bytes.
/// Members throw std::runtime_error if the HDF5 library fails, which only lack of memory can cause.
class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void group(const std::string& path);

  void array(const std::string& path, const Shape& shape, const std::vector<double>& values);
  void array(const std::string& path, const Shape& shape, const std::vector<std::int32_t>& values);
  void array(const std::string& path, const Shape& shape, const std::vector<std::uint8_t>& values);
  void text(const std::string& path, const std::string& value);

  /// Attributes of the group or dataset `path`, which exists ("/" is the root).
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  void attribute(const std::string& path, const std::string& name, std::uint64_t value);

  /// A second name for an array that is there; it takes no room.
  void link(const std::string& path, const std::string& second_path);

  /// The whole file. Nothing can be added afterwards.
  std::string bytes();

 private:
  std::int64_t file_;
};

/// Reads an HDF5 file held in memory. Every fault of its content is an InputError that names file and dataset.
/// The bytes have to be known to be whole: the HDF5 library can crash on damaged ones.
class Hdf5Reader {
 public:
  /// @param place  name of the file in messages
  Hdf5Reader(std::string place, std::string_view bytes);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// "file:/path", the place in messages about one dataset.
  std::string place(const std::string& path) const { return path == "/" ? place_ : place_ + ":/" + path; }

  bool has(const std::string& path) const;

  /// Number of rows of an array.
  std::uint64_t n_rows(const std::string& path) const;

  void array(const std::string& path, const Shape& shape, std::vector<double>& values) const;
  void array(const std::string& path, const Shape& shape, std::vector<std::int32_t>& values) const;
  void array(const std::string& path, const Shape& shape, std::vector<std::uint8_t>& values) const;
  std::string text(const std::string& path) const;

  void attribute(const std::string& path, const std::string& name, std::string& value) const;
  void attribute(const std::string& path, const std::string& name, double& value) const;
  void attribute(const std::string& path, const std::string& name, std::int64_t& value) const;
  void attribute(const std::string& path, const std::string& name, std::uint64_t& value) const;
  bool has_attribute(const std::string& path, const std::string& name) const;

 private:
  std::string place_;
  std::int64_t file_;
};

}  // namespace floc
