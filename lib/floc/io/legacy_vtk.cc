#include "floc/io/legacy_vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/keyed_line.h"
#include "floc/io/point_cloud.h"

namespace floc {
namespace {

/// Converts a number of type T, whose bytes are stored with the most significant byte first, to a double.
template <class T>
double big_endian(const char* bytes) {
  std::array<char, sizeof(T)> native;
  std::copy(bytes, bytes + sizeof(T), native.begin());
  if constexpr (std::endian::native == std::endian::little) std::reverse(native.begin(), native.end());
  return static_cast<double>(std::bit_cast<T>(native));
}

struct NumberType {
  std::size_t size;
  double (*convert)(const char*);
};

template <class T>
NumberType number_type() {
  return {sizeof(T), big_endian<T>};
}

const std::map<std::string_view, NumberType>& number_types() {
  static const std::map<std::string_view, NumberType> types = {
      {"double", number_type<double>()},          {"float", number_type<float>()},
      {"int", number_type<std::int32_t>()},       {"unsigned_int", number_type<std::uint32_t>()},
      {"long", number_type<std::int64_t>()},      {"vtktypeint64", number_type<std::int64_t>()},
      {"vtkIdType", number_type<std::int64_t>()}, {"unsigned_long", number_type<std::uint64_t>()},
      {"short", number_type<std::int16_t>()},     {"unsigned_short", number_type<std::uint16_t>()},
      {"char", number_type<signed char>()},       {"unsigned_char", number_type<unsigned char>()},
  };
  return types;
}

/// Content of a file. The member functions read the content from the beginning to the end, as lines and as arrays of
/// numbers.
class Content {
 public:
  explicit Content(const std::string& path) : path_(path), bytes_(read_file(path)), rest_(bytes_) {}

  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  bool at_end() const { return rest_.empty(); }
  /// Number of bytes that have not been read.
  std::size_t n_left() const { return rest_.size(); }
  void go_back_to(std::size_t n_left) { rest_ = std::string_view(bytes_).substr(bytes_.size() - n_left); }

  /// Returns the words of the next line.
  std::vector<std::string_view> line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::vector<std::string_view> words = words_of(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return words;
  }

  /// Returns the next line that is not empty; nothing at the end of the file.
  std::vector<std::string_view> next_line() {
    std::vector<std::string_view> words;
    while (words.empty() && !at_end()) words = line();
    return words;
  }

  void set_binary(bool binary) { binary_ = binary; }

  /// Reads the next `n` numbers of the given type. @param what  name of the array in messages
  std::vector<double> numbers(std::size_t n, std::string_view type, const std::string& what) {
    const auto known = number_types().find(type);
    if (known == number_types().end())
      throw InputError(path_,
                       fmt::format("{} has the type {}, expected a type of numbers such as float", what, type));
    // Each number needs at least one byte, so a larger count is wrong. The error is reported before memory is
    // allocated.
    if (n > rest_.size())
      throw InputError(path_, fmt::format("the file ends within {}, which has {} numbers", what, n));
    std::vector<double> values(n);
    for (double& value : values) value = binary_ ? binary_number(known->second, what) : text_number(what);
    return values;
  }

  /// Returns the count in word `k` of a line.
  std::size_t count(const std::vector<std::string_view>& words, std::size_t k) const {
    const auto value = k < words.size() ? parse_number<std::int64_t>(words[k]) : std::nullopt;
    if (!value || *value < 0 || *value > 3'000'000'000)
      throw InputError(
          path_, fmt::format("the line that begins with {} has \"{}\" as word {}, expected a count", words[0],
                             k < words.size() ? words[k] : std::string_view(), k + 1));
    return static_cast<std::size_t>(*value);
  }

 private:
  double binary_number(const NumberType& type, const std::string& what) {
    if (rest_.size() < type.size) throw InputError(path_, fmt::format("the file ends within {}", what));
    const double value = type.convert(rest_.data());
    rest_.remove_prefix(type.size);
    if (std::isfinite(value)) return value;
    throw InputError(path_, fmt::format("{} has a number that is not finite", what));
  }

  double text_number(const std::string& what) {
    constexpr std::string_view kSpace = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpace));
    const auto value = parse_number<double>(word);
    if (!value) throw InputError(path_, fmt::format("{} has \"{}\", expected a finite number", what, word));
    rest_.remove_prefix(word.size());
    return *value;
  }

  std::string path_;
  std::string bytes_;
  std::string_view rest_;
  bool binary_ = false;
};

/// The points of a file, and the arrays with data of the points.
struct PointFile {
  std::vector<double> x;
  std::vector<std::pair<std::string, std::vector<double>>> arrays;
};

/// Skips the arrays that describe the cells of a data set. In older files, a line such as "VERTICES 3 6" ends with the
/// count of all numbers. In files of version 5, a line such as "VERTICES 4 3" contains the counts of the two arrays
/// below it, OFFSETS and CONNECTIVITY.
void skip_cells(const std::vector<std::string_view>& words, Content& file) {
  if (words[0] == "CELL_TYPES") {
    file.numbers(file.count(words, 1), "int", "CELL_TYPES");
    return;
  }
  const std::size_t before = file.n_left();
  const std::vector<std::string_view> next = file.next_line();
  if (next.size() == 2 && next[0] == "OFFSETS") {
    file.numbers(file.count(words, 1), next[1], "OFFSETS");
    const std::vector<std::string_view> connectivity = file.next_line();
    if (connectivity.size() == 2) file.numbers(file.count(words, 2), connectivity[1], "CONNECTIVITY");
    return;
  }
  file.go_back_to(before);
  file.numbers(file.count(words, 2), "int", std::string(words[0]));
}

/// Reads the arrays that follow a line "FIELD name n" and, if they belong to points, adds them to `out`.
void read_fields(const std::vector<std::string_view>& words, bool of_points, Content& file, PointFile& out) {
  const std::size_t n_arrays = file.count(words, 2);
  for (std::size_t k = 0; k < n_arrays;) {
    const std::vector<std::string_view> head = file.next_line();
    if (head.empty()) return;
    if (head.size() < 4) continue;  // lines of METADATA
    const std::string name(head[0]);
    std::vector<double> values = file.numbers(file.count(head, 1) * file.count(head, 2), head[3], name);
    if (of_points) out.arrays.emplace_back(name, std::move(values));
    ++k;
  }
}

PointFile read_point_file(const std::string& path) {
  Content file(path);
  file.line();  // "# vtk DataFile Version 3.0"
  file.line();  // a title
  const std::vector<std::string_view> kind = file.line();
  if (kind.size() != 1 || (kind[0] != "ASCII" && kind[0] != "BINARY"))
    throw InputError(path, "the third line is neither ASCII nor BINARY");
  file.set_binary(kind[0] == "BINARY");
  PointFile out;
  std::size_t n_data = 0;
  bool of_points = false;
  for (std::vector<std::string_view> words; !(words = file.next_line()).empty();) {
    const std::string_view key = words[0];
    if (key == "DATASET" && words.size() > 1 && words[1] != "POLYDATA" && words[1] != "UNSTRUCTURED_GRID")
      throw InputError(path,
                       fmt::format("the data set is {}, expected POLYDATA or UNSTRUCTURED_GRID", words[1]));
    if (key == "POINTS" && words.size() > 2) {
      out.x = file.numbers(3 * file.count(words, 1), words[2], "POINTS");
    } else if (key == "VERTICES" || key == "LINES" || key == "POLYGONS" || key == "TRIANGLE_STRIPS" ||
               key == "CELLS" || key == "CELL_TYPES") {
      skip_cells(words, file);
    } else if (key == "POINT_DATA" || key == "CELL_DATA") {
      n_data = file.count(words, 1);
      of_points = key == "POINT_DATA";
    } else if (key == "SCALARS" && words.size() > 2) {
      const std::size_t n_components = words.size() > 3 ? file.count(words, 3) : 1;
      const std::string name(words[1]), type(words[2]);
      file.next_line();  // LOOKUP_TABLE
      std::vector<double> values = file.numbers(n_data * n_components, type, name);
      if (of_points) out.arrays.emplace_back(name, std::move(values));
    } else if ((key == "VECTORS" || key == "NORMALS") && words.size() > 2) {
      const std::string name(words[1]);
      std::vector<double> values = file.numbers(3 * n_data, words[2], name);
      if (of_points) out.arrays.emplace_back(name, std::move(values));
    } else if (key == "FIELD") {
      read_fields(words, of_points, file, out);
    }
  }
  if (out.x.empty()) throw InputError(path, "the file has no points");
  return out;
}

}  // namespace

bool is_legacy_vtk(const std::string& path) {
  return begins_with(path, "# vtk DataFile");
}

Imported read_legacy_vtk(const std::string& path, const ImportOptions& options) {
  PointFile file = read_point_file(path);
  PointCloud cloud;
  cloud.path = path;
  cloud.x = std::move(file.x);
  for (const auto& [name, values] : file.arrays) cloud.arrays.push_back(name);
  cloud.place = [&](const std::string& name) { return fmt::format("{}, array {}", path, name); };
  cloud.read = [&](const std::string& name) {
    for (const auto& [known, values] : file.arrays)
      if (known == name) return values;
    throw InputError(cloud.place(name), "the array is missing");
  };
  cloud.space.place = path;
  return read_points(cloud, options);
}

}  // namespace floc
