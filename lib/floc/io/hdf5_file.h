#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace floc {

/// Failure of the HDF5 library to write a file (for example, because the disk is full) or to read a file (for example,
/// because its content is damaged).
class Hdf5Failure : public std::runtime_error {
 public:
  Hdf5Failure(const std::string& what, int error) : std::runtime_error(what), error_(error) {}

  /// Value of errno after the failure. It is meaningful only if a system call of the HDF5 library failed.
  int error() const { return error_; }

 private:
  int error_;
};

/// Shape of an array: the number of entries along each dimension. The index along the first dimension varies slowest.
using ArrayShape = std::vector<std::uint64_t>;

/// Writes an HDF5 file. The file contains no times, so equal calls give equal bytes. All member functions throw
/// Hdf5Failure if the HDF5 library fails.
class Hdf5Writer {
 public:
  /// @param path  path of the file to write; an existing file is replaced
  explicit Hdf5Writer(const std::string& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void group(const std::string& path);

  void array(const std::string& path, const ArrayShape& shape, const std::vector<double>& values);
  void array(const std::string& path, const ArrayShape& shape, const std::vector<std::int32_t>& values);
  void array(const std::string& path, const ArrayShape& shape, const std::vector<std::uint8_t>& values);
  /// Writes an array in blocks of rows, so that no copy of the whole array is needed.
  /// @param fill  function that writes the values of one block into its second argument; its first argument is the
  /// number of the first row of the block
  template <class T>
  void rows(const std::string& path, const ArrayShape& shape,
            const std::function<void(std::uint64_t, std::span<T>)>& fill);
  void text(const std::string& path, const std::string& value);

  /// Writes an attribute of the existing group or dataset `path` ("/" is the root group).
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  void attribute(const std::string& path, const std::string& name, std::uint64_t value);

  void attribute(const std::string& path, const std::string& name, const std::vector<std::int64_t>& values);
  /// Writes an attribute as ASCII text of fixed length, for programs that do not read text of variable length.
  void fixed_text_attribute(const std::string& path, const std::string& name, const std::string& value);

  /// Gives an existing array a second path in the file. The values are stored only once.
  void link(const std::string& path, const std::string& second_path);

  /// Completes and closes the file. Nothing can be added to it afterwards.
  void close();

 private:
  std::int64_t file_;  ///< HDF5 identifier of the file; -1 after close()
};

/// Reads an HDF5 file. All faults of the content are reported as an InputError that names the file and the dataset.
/// @pre the file is undamaged (SealedFile checks this), because the HDF5 library can crash on a damaged file
class Hdf5Reader {
 public:
  /// @param place  name of the file in messages
  /// @param path   path under which the file is opened
  Hdf5Reader(std::string place, const std::string& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Returns the place of a group or dataset in messages, "file:/path".
  std::string place(const std::string& path) const { return path == "/" ? place_ : place_ + ":/" + path; }

  bool has(const std::string& path) const;

  /// Returns the names of the datasets and groups in a group, sorted.
  std::vector<std::string> names(const std::string& group) const;
  /// Returns the shape of an array; the shape of a single value is empty.
  ArrayShape shape(const std::string& path) const;
  /// Returns the values of an array of real or whole numbers. The array may have any size.
  /// @throws InputError also if a value is not finite
  std::vector<double> numbers(const std::string& path) const;

  /// Returns the number of rows of an array: the number of entries along its first dimension.
  std::uint64_t n_rows(const std::string& path) const;

  void array(const std::string& path, const ArrayShape& shape, std::vector<double>& values) const;
  void array(const std::string& path, const ArrayShape& shape, std::vector<std::int32_t>& values) const;
  void array(const std::string& path, const ArrayShape& shape, std::vector<std::uint8_t>& values) const;
  /// Reads an array in blocks of rows.
  /// @param take  function that is called for each block with the number of its first row and its values
  template <class T>
  void rows(const std::string& path, const ArrayShape& shape,
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
