#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace floc {

/// Failure of the HDF5 library: the disk is full or, when reading, the content of the file is damaged.
class Hdf5Failure : public std::runtime_error {
 public:
  Hdf5Failure(const std::string& what, int error) : std::runtime_error(what), error_(error) {}

  /// errno at the failure; it is meaningful if a system call failed.
  int error() const { return error_; }

 private:
  int error_;
};

/// Shape of an array, slowest index first.
using Shape = std::vector<std::uint64_t>;

/// Writes an HDF5 file. The bytes do not depend on the clock: the same calls give the same bytes.
/// Members throw Hdf5Failure if the HDF5 library fails.
class Hdf5Writer {
 public:
  /// @param path  file to write; an existing file is replaced
  explicit Hdf5Writer(const std::string& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void group(const std::string& path);

  void array(const std::string& path, const Shape& shape, const std::vector<double>& values);
  void array(const std::string& path, const Shape& shape, const std::vector<std::int32_t>& values);
  void array(const std::string& path, const Shape& shape, const std::vector<std::uint8_t>& values);
  /// Writes an array in blocks of rows, which avoids a second copy of the data.
  /// @param fill  called with the number of the first row of a block; sets the values of the block
  template <class T>
  void rows(const std::string& path, const Shape& shape,
            const std::function<void(std::uint64_t, std::span<T>)>& fill);
  void text(const std::string& path, const std::string& value);

  /// Writes an attribute of the group or dataset `path`, which has to exist ("/" is the root group).
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  void attribute(const std::string& path, const std::string& name, std::uint64_t value);

  /// Adds a second name for an existing array; the values are not copied.
  void link(const std::string& path, const std::string& second_path);

  /// Completes the file. Nothing can be added afterwards.
  void close();

 private:
  std::int64_t file_;  ///< HDF5 identifier of the file; -1: closed
};

/// Reads an HDF5 file. Every fault of its content is reported as an InputError that names file and dataset.
/// @pre the file is known to be undamaged, because the HDF5 library can crash on a damaged file
class Hdf5Reader {
 public:
  /// @param place  name of the file in messages
  /// @param path   path under which the file is opened
  Hdf5Reader(std::string place, const std::string& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Returns "file:/path", the place of one dataset in messages.
  std::string place(const std::string& path) const { return path == "/" ? place_ : place_ + ":/" + path; }

  bool has(const std::string& path) const;

  /// Number of rows of an array.
  std::uint64_t n_rows(const std::string& path) const;

  void array(const std::string& path, const Shape& shape, std::vector<double>& values) const;
  void array(const std::string& path, const Shape& shape, std::vector<std::int32_t>& values) const;
  void array(const std::string& path, const Shape& shape, std::vector<std::uint8_t>& values) const;
  /// Reads an array in blocks of rows.
  /// @param take  called with the number of the first row of a block and the values of the block
  template <class T>
  void rows(const std::string& path, const Shape& shape,
            const std::function<void(std::uint64_t, std::span<const T>)>& take) const;
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
