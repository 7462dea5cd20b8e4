#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace floc {

/// Reads arrays of numbers from a file in VTK's XML format. The file must contain an unstructured grid or polygonal
/// data. The data must be in one piece, although VTK allows several pieces. The numbers are little endian, and
/// uncompressed or compressed by zlib. The numbers are stored as ASCII or base64 text in the XML element of the array,
/// or as base64 text or raw bytes in the element AppendedData at the end of the file.
class VtkArrays {
 public:
  /// Parses the XML of a file.
  /// @param path  name of the file in messages
  /// @param content  content of the file
  /// @throws InputError naming the file if it is not an XML file of VTK with one piece of an unstructured grid or of
  /// polygonal data
  VtkArrays(const std::string& path, const std::string& content);
  ~VtkArrays();
  VtkArrays(const VtkArrays&) = delete;
  VtkArrays& operator=(const VtkArrays&) = delete;

  std::int64_t n_points() const;

  /// Names of the arrays in a section of the file: "PointData", "Cells" or "FieldData".
  std::vector<std::string> names(const std::string& section) const;
  bool has(const std::string& section, const std::string& name) const;

  /// Reads all numbers of an array. @param section  "Points", "PointData", "Cells" or "FieldData"
  /// @param name  name of the array; in the section Points, which has one array only, the name is ignored
  /// @throws InputError naming file and array if the array is missing or damaged, or has a number that is not finite
  std::vector<double> read(const std::string& section, const std::string& name) const;

  /// Returns the place of an array in messages: "file, array PointData/radius".
  std::string place(const std::string& section, const std::string& name) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace floc
