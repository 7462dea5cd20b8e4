#include "floc/io/hdf5_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "floc/base/error.h"

namespace floc {
namespace {

template <class T>
T checked(T result) {
  if (result < 0) throw Hdf5Failure("the HDF5 library failed", errno);
  return result;
}

/// Owns an HDF5 identifier; the destructor releases it by calling `close`.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;

  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Configures the HDF5 library. The library must not print errors, because floc reports them by exceptions. The library
/// must not clean up at the end of the program: if a write has failed on a full disk, the clean-up would repeat the
/// write and crash.
void begin_library() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Returns the HDF5 access properties that are used to open files. Small arrays are not buffered: a buffer would be
/// written when the file is closed, and an error during this write would be lost. The library does not lock files; floc
/// locks them itself where this is needed.
Handle file_access() {
  const hid_t access = checked(H5Pcreate(H5P_FILE_ACCESS));
  checked(H5Pset_sieve_buf_size(access, 0));
  checked(H5Pset_file_locking(access, /*use_file_locking=*/false, /*ignore_when_disabled=*/true));
  return {access, H5Pclose};
}

Handle text_type() {
  const hid_t type = checked(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

Handle scalar() {
  return {checked(H5Screate(H5S_SCALAR)), H5Sclose};
}

/// Returns HDF5 properties for new objects (files, groups or datasets). With these properties, HDF5 does not store the
/// time of creation, so that files do not depend on the clock.
Handle untimed(hid_t property_class) {
  const hid_t properties = checked(H5Pcreate(property_class));
  H5Pset_obj_track_times(properties, false);
  return {properties, H5Pclose};
}

template <class T>
struct NativeType;
template <>
struct NativeType<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t file() { return H5T_IEEE_F64LE; }
  static constexpr H5T_class_t kClass = H5T_FLOAT;
  static constexpr const char* kName = "real numbers";
};
template <>
struct NativeType<std::int32_t> {
  static hid_t memory() { return H5T_NATIVE_INT32; }
  static hid_t file() { return H5T_STD_I32LE; }
  static constexpr H5T_class_t kClass = H5T_INTEGER;
  static constexpr const char* kName = "integers";
};
template <>
struct NativeType<std::uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t file() { return H5T_STD_U8LE; }
  static constexpr H5T_class_t kClass = H5T_INTEGER;
  static constexpr const char* kName = "integers";
};
template <>
struct NativeType<std::int64_t> {
  static hid_t memory() { return H5T_NATIVE_INT64; }
  static hid_t file() { return H5T_STD_I64LE; }
  static constexpr H5T_class_t kClass = H5T_INTEGER;
  static constexpr const char* kName = "an integer";
};
template <>
struct NativeType<std::uint64_t> {
  static hid_t memory() { return H5T_NATIVE_UINT64; }
  static hid_t file() { return H5T_STD_U64LE; }
  static constexpr H5T_class_t kClass = H5T_INTEGER;
  static constexpr const char* kName = "an integer";
};

Handle create_dataset(hid_t file, const std::string& path, hid_t type, hid_t space) {
  const Handle creation = untimed(H5P_DATASET_CREATE);
  return {checked(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT)), H5Dclose};
}

Handle space_of(const std::vector<hsize_t>& extent) {
  return {checked(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr)), H5Sclose};
}

template <class T>
Handle create_array(hid_t file, const std::string& path, const ArrayShape& shape) {
  return create_dataset(file, path, NativeType<T>::file(), space_of({shape.begin(), shape.end()}));
}

template <class T>
void write_array(hid_t file, const std::string& path, const ArrayShape& shape, const std::vector<T>& values) {
  const Handle dataset = create_array<T>(file, path, shape);
  if (!values.empty())
    checked(H5Dwrite(dataset, NativeType<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

/// Largest number of rows of an array that are written or read at a time. This number limits the size of the buffers.
constexpr hsize_t kRowsAtATime = 1 << 16;

/// Divides an array with the given shape into blocks of rows, and calls visit(first, n, memory, file) for each block.
/// `first` is the number of the first row of the block, and `n` is the number of values in the block. `memory` is the
/// HDF5 dataspace of a buffer for these values, and `file` is the HDF5 dataspace of the array with the block selected
/// in it.
template <class Visit>
void for_each_block(const ArrayShape& shape, const Visit& visit) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Handle file = space_of(extent);
  std::vector<hsize_t> start(extent.size(), 0), count = extent;
  for (hsize_t first = 0; first < extent[0]; first += kRowsAtATime) {
    start[0] = first;
    count[0] = std::min(kRowsAtATime, extent[0] - first);
    checked(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
    const Handle memory = space_of(count);
    visit(first, std::accumulate(count.begin(), count.end(), hsize_t{1}, std::multiplies<>()), hid_t{memory},
          hid_t{file});
  }
}

void write_attribute(hid_t file, const std::string& path, const std::string& name, hid_t file_type,
                     hid_t memory_type, const void* value) {
  const Handle object(checked(H5Oopen(file, path.c_str(), H5P_DEFAULT)), H5Oclose);
  const Handle space = scalar();
  const Handle attribute(checked(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose);
  checked(H5Awrite(attribute, memory_type, value));
}

Handle open_dataset(hid_t file, const std::string& place, const std::string& path) {
  const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  if (dataset < 0) throw InputError(place, "this dataset is missing");
  return {dataset, H5Dclose};
}

std::vector<hsize_t> extent_of(hid_t dataset) {
  const Handle space(checked(H5Dget_space(dataset)), H5Sclose);
  std::vector<hsize_t> extent(checked(H5Sget_simple_extent_ndims(space)));
  checked(H5Sget_simple_extent_dims(space, extent.data(), nullptr));
  return extent;
}

/// Checks that an array is not larger than the file that contains it. Without this check, a damaged file could make
/// floc allocate far too much memory.
/// @param bytes  size of the array (bytes)
/// @throws InputError naming `place` if the array is larger than the file
void check_length(hid_t file, const std::string& place, double bytes) {
  hsize_t size = 0;
  checked(H5Fget_filesize(file, &size));
  if (bytes > static_cast<double>(size))
    throw InputError(
        place,
        fmt::format("the dataset has {:.3g} bytes according to its header, but the whole file has {} bytes",
                    bytes, size));
}

/// Opens a dataset: an array of numbers of type T.
/// @throws InputError naming `place` unless the dataset exists, has the given shape, and contains numbers of the kind
/// of T (real numbers if T is double, else integers)
template <class T>
Handle open_array(hid_t file, const std::string& place, const std::string& path, const ArrayShape& shape) {
  Handle dataset = open_dataset(file, place, path);
  const std::vector<hsize_t> extent = extent_of(dataset);
  if (!std::equal(extent.begin(), extent.end(), shape.begin(), shape.end()))
    throw InputError(place, fmt::format("the shape of the dataset is ({}), expected ({})",
                                        fmt::join(extent, ", "), fmt::join(shape, ", ")));
  const Handle type(checked(H5Dget_type(dataset)), H5Tclose);
  if (H5Tget_class(type) != NativeType<T>::kClass)
    throw InputError(
        place, fmt::format("the dataset contains values of another type, expected {}", NativeType<T>::kName));
  check_length(
      file, place,
      std::accumulate(shape.begin(), shape.end(), static_cast<double>(H5Tget_size(type)), std::multiplies<>()));
  return dataset;
}

template <class T>
void read_array(hid_t file, const std::string& place, const std::string& path, const ArrayShape& shape,
                std::vector<T>& values) {
  const Handle dataset = open_array<T>(file, place, path, shape);
  std::size_t n = 1;
  for (const std::uint64_t size : shape) n *= size;
  values.resize(n);
  if (n > 0 && H5Dread(dataset, NativeType<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw InputError(place, "the dataset cannot be read");
}

Handle open_attribute(hid_t file, const std::string& place, const std::string& path, const std::string& name,
                      H5T_class_t expected, const char* kind) {
  const hid_t id = H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (id < 0) throw InputError(place, fmt::format("attribute {} is missing", name));
  Handle attribute(id, H5Aclose);
  const Handle type(checked(H5Aget_type(id)), H5Tclose);
  const Handle space(checked(H5Aget_space(id)), H5Sclose);
  if (H5Tget_class(type) != expected || H5Sget_simple_extent_npoints(space) != 1)
    throw InputError(place,
                     fmt::format("attribute {} is not a single value of the expected type ({})", name, kind));
  return attribute;
}

template <class T>
void read_attribute(hid_t file, const std::string& place, const std::string& path, const std::string& name,
                    T& value) {
  const Handle attribute = open_attribute(file, place, path, name, NativeType<T>::kClass, NativeType<T>::kName);
  if (H5Aread(attribute, NativeType<T>::memory(), &value) < 0)
    throw InputError(place, fmt::format("attribute {} cannot be read", name));
}

/// Returns the string, of variable or fixed length, in a dataset or an attribute.
/// @param type  HDF5 type of the stored string
/// @param read  function read(type, buffer) that reads the string from the dataset or the attribute into a buffer
template <class Read>
std::string text_of_dataset(hid_t type, const Read& read) {
  if (H5Tis_variable_str(type) > 0) {
    char* buffer = nullptr;
    const Handle memory = text_type();
    checked(read(memory, &buffer));
    std::string value = buffer == nullptr ? "" : buffer;
    H5free_memory(buffer);
    return value;
  }
  std::string value(H5Tget_size(type), '\0');
  checked(read(type, value.data()));
  value.resize(value.find('\0') == std::string::npos ? value.size() : value.find('\0'));
  return value;
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::string& path) {
  begin_library();
  errno = 0;
  const Handle access = file_access();
  const Handle creation = untimed(H5P_FILE_CREATE);
  file_ = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access));
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::group(const std::string& path) {
  const Handle creation = untimed(H5P_GROUP_CREATE);
  const Handle made(checked(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT)), H5Gclose);
}

void Hdf5Writer::link(const std::string& path, const std::string& second_path) {
  checked(H5Lcreate_hard(file_, path.c_str(), file_, second_path.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

void Hdf5Writer::array(const std::string& path, const ArrayShape& shape, const std::vector<double>& values) {
  write_array(file_, path, shape, values);
}
void Hdf5Writer::array(const std::string& path, const ArrayShape& shape,
                       const std::vector<std::int32_t>& values) {
  write_array(file_, path, shape, values);
}
void Hdf5Writer::array(const std::string& path, const ArrayShape& shape,
                       const std::vector<std::uint8_t>& values) {
  write_array(file_, path, shape, values);
}

template <class T>
void Hdf5Writer::rows(const std::string& path, const ArrayShape& shape,
                      const std::function<void(std::uint64_t, std::span<T>)>& fill) {
  const Handle dataset = create_array<T>(file_, path, shape);
  std::vector<T> values;
  for_each_block(shape, [&](hsize_t first, hsize_t n, hid_t memory, hid_t file) {
    values.resize(n);
    fill(first, values);
    checked(H5Dwrite(dataset, NativeType<T>::memory(), memory, file, H5P_DEFAULT, values.data()));
  });
}

template void Hdf5Writer::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<double>)>&);
template void Hdf5Writer::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<std::int32_t>)>&);
template void Hdf5Writer::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<std::uint8_t>)>&);
template void Hdf5Writer::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<std::int64_t>)>&);

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  const Handle type = text_type();
  const Handle space = scalar();
  const Handle dataset = create_dataset(file_, path, type, space);
  const char* content = value.c_str();
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &content));
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const std::string& value) {
  const Handle type = text_type();
  const char* content = value.c_str();
  write_attribute(file_, path, name, type, type, &content);
}
void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  write_attribute(file_, path, name, NativeType<double>::file(), NativeType<double>::memory(), &value);
}
void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  write_attribute(file_, path, name, NativeType<std::int64_t>::file(), NativeType<std::int64_t>::memory(),
                  &value);
}
void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::uint64_t value) {
  write_attribute(file_, path, name, NativeType<std::uint64_t>::file(), NativeType<std::uint64_t>::memory(),
                  &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::vector<std::int64_t>& values) {
  const Handle object(checked(H5Oopen(file_, path.c_str(), H5P_DEFAULT)), H5Oclose);
  const Handle space = space_of({values.size()});
  const Handle attribute(checked(H5Acreate2(object, name.c_str(), NativeType<std::int64_t>::file(), space,
                                            H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose);
  checked(H5Awrite(attribute, NativeType<std::int64_t>::memory(), values.data()));
}

void Hdf5Writer::fixed_text_attribute(const std::string& path, const std::string& name,
                                      const std::string& value) {
  const Handle type(checked(H5Tcopy(H5T_C_S1)), H5Tclose);
  checked(H5Tset_size(type, value.size()));
  // By default, HDF5 ends a string of fixed length with a null character, for which the size of this type has no room.
  // With H5T_STR_NULLPAD, the text needs no null character at its end.
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  write_attribute(file_, path, name, type, type, value.data());
}

void Hdf5Writer::close() {
  checked(H5Fflush(file_, H5F_SCOPE_GLOBAL));
  // The identifier is cleared before its value is closed. If H5Fclose fails, the destructor therefore does not close
  // the file again.
  checked(H5Fclose(std::exchange(file_, -1)));
}

Hdf5Reader::Hdf5Reader(std::string place, const std::string& path) : place_(std::move(place)) {
  begin_library();
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access());
  if (file_ < 0)
    throw InputError(place_, "the HDF5 library cannot open the file: expected a file in the HDF5 format");
}

Hdf5Reader::~Hdf5Reader() {
  H5Fclose(file_);
}

bool Hdf5Reader::has(const std::string& path) const {
  return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const hid_t id = H5Gopen2(file_, group.c_str(), H5P_DEFAULT);
  if (id < 0) throw InputError(place(group), "this group is missing");
  const Handle opened(id, H5Gclose);
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names) < 0)
    throw InputError(place(group), "the group cannot be read");
  return names;
}

ArrayShape Hdf5Reader::shape(const std::string& path) const {
  const std::vector<hsize_t> extent = extent_of(open_dataset(file_, place(path), path));
  return {extent.begin(), extent.end()};
}

std::vector<double> Hdf5Reader::numbers(const std::string& path) const {
  const Handle dataset = open_dataset(file_, place(path), path);
  const Handle type(checked(H5Dget_type(dataset)), H5Tclose);
  std::vector<double> values;
  if (H5Tget_class(type) == H5T_INTEGER) {
    rows<std::int64_t>(path, shape(path), [&](std::uint64_t, std::span<const std::int64_t> block) {
      values.insert(values.end(), block.begin(), block.end());
    });
  } else {
    array(path, shape(path), values);
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw InputError(place(path), fmt::format("number {} is {}, expected a finite number", k, values[k]));
  return values;
}

std::uint64_t Hdf5Reader::n_rows(const std::string& path) const {
  const Handle dataset = open_dataset(file_, place(path), path);
  const std::vector<hsize_t> extent = extent_of(dataset);
  if (extent.empty()) throw InputError(place(path), "the dataset is a single value, expected an array");
  check_length(file_, place(path), static_cast<double>(extent[0]));
  return extent[0];
}

void Hdf5Reader::array(const std::string& path, const ArrayShape& shape, std::vector<double>& values) const {
  read_array(file_, place(path), path, shape, values);
}
void Hdf5Reader::array(const std::string& path, const ArrayShape& shape,
                       std::vector<std::int32_t>& values) const {
  read_array(file_, place(path), path, shape, values);
}
void Hdf5Reader::array(const std::string& path, const ArrayShape& shape,
                       std::vector<std::uint8_t>& values) const {
  read_array(file_, place(path), path, shape, values);
}

template <class T>
void Hdf5Reader::rows(const std::string& path, const ArrayShape& shape,
                      const std::function<void(std::uint64_t, std::span<const T>)>& take) const {
  const Handle dataset = open_array<T>(file_, place(path), path, shape);
  std::vector<T> values;
  for_each_block(shape, [&](hsize_t first, hsize_t n, hid_t memory, hid_t file) {
    values.resize(n);
    if (H5Dread(dataset, NativeType<T>::memory(), memory, file, H5P_DEFAULT, values.data()) < 0)
      throw InputError(place(path), "the dataset cannot be read");
    take(first, values);
  });
}

template void Hdf5Reader::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<const double>)>&) const;
template void Hdf5Reader::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<const std::int32_t>)>&) const;
template void Hdf5Reader::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<const std::uint8_t>)>&) const;
template void Hdf5Reader::rows(const std::string&, const ArrayShape&,
                               const std::function<void(std::uint64_t, std::span<const std::int64_t>)>&) const;

std::string Hdf5Reader::text(const std::string& path) const {
  const Handle dataset = open_dataset(file_, place(path), path);
  const Handle type(checked(H5Dget_type(dataset)), H5Tclose);
  const Handle space(checked(H5Dget_space(dataset)), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    throw InputError(place(path), "the dataset is not a string");
  return text_of_dataset(type, [&](hid_t memory, void* buffer) {
    return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  });
}

bool Hdf5Reader::has_attribute(const std::string& path, const std::string& name) const {
  return H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5Reader::attribute(const std::string& path, const std::string& name, std::string& value) const {
  const Handle attribute = open_attribute(file_, place(path), path, name, H5T_STRING, "a string");
  const Handle type(checked(H5Aget_type(attribute)), H5Tclose);
  value = text_of_dataset(type, [&](hid_t memory, void* buffer) { return H5Aread(attribute, memory, buffer); });
}
void Hdf5Reader::attribute(const std::string& path, const std::string& name, double& value) const {
  read_attribute(file_, place(path), path, name, value);
}
void Hdf5Reader::attribute(const std::string& path, const std::string& name, std::int64_t& value) const {
  read_attribute(file_, place(path), path, name, value);
}
void Hdf5Reader::attribute(const std::string& path, const std::string& name, std::uint64_t& value) const {
  read_attribute(file_, place(path), path, name, value);
}

}  // namespace floc
