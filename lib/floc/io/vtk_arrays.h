#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace floc {

/// Data arrays of a file in an XML format of VTK, uncompressed and little endian: ASCII, base64, or appended after
/// the XML as base64 or raw bytes. The file holds one piece of an unstructured grid.
class VtkArrays {
 public:
  /// Parses the XML of a file. @param path  its name in messages
  /// @throws InputError naming the file if it is not such a file
  VtkArrays(const std::string& path, const std::string& content);
  ~VtkArrays();
  VtkArrays(const VtkArrays&) = delete;
  VtkArrays& operator=(const VtkArrays&) = delete;

  std::int64_t n_points() const;

  /// Names of the arrays in "PointData", "Cells" or "FieldData".
  std::vector<std::string> names(const std::string& section) const;
  bool has(const std::string& section, const std::string& name) const;

  /// Reads all numbers of an array. @param section  "Points" (any name), "PointData", "Cells" or "FieldData"
  /// @throws InputError naming file and array: missing, damaged, or a number that is not finite
  std::vector<double> read(const std::string& section, const std::string& name) const;

  /// "file, array PointData/radius", for messages.
  std::string place(const std::string& section, const std::string& name) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace floc
