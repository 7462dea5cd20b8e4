#include "floc/io/vtk_arrays.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <string_view>

#include "floc/base/error.h"
#include "floc/base/gzip_stream.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"

namespace floc {
namespace {

/// Decodes base64 text up to the first character that is not base64. Padding (=) may occur within the text, because VTK
/// sometimes encodes the header (the length of the data) and the data separately.
std::string from_base64(std::string_view text) {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t at = 0; at + 4 <= text.size(); at += 4) {
    std::uint32_t bits = 0;
    std::size_t n_padding = 0;
    for (const char c : text.substr(at, 4)) {
      const std::size_t value = kAlphabet.find(c);
      if (value == std::string_view::npos && c != '=') return bytes;
      n_padding += c == '=';
      bits = bits << 6 | (c == '=' ? 0u : static_cast<std::uint32_t>(value));
    }
    for (std::size_t k = 0; k + n_padding < 3; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
  }
  return bytes;
}

/// Interprets `bytes` as numbers of type T and returns them as double.
template <class T>
std::vector<double> convert(std::string_view bytes) {
  std::vector<double> values(bytes.size() / sizeof(T));
  for (std::size_t k = 0; k < values.size(); ++k) {
    T value;
    std::memcpy(&value, bytes.data() + k * sizeof(T), sizeof(T));
    values[k] = static_cast<double>(value);
  }
  return values;
}

using Converter = std::vector<double> (*)(std::string_view);

const std::map<std::string, Converter>& converters() {
  static const std::map<std::string, Converter> known = {
      {"Float64", convert<double>},     {"Float32", convert<float>},
      {"Int64", convert<std::int64_t>}, {"UInt64", convert<std::uint64_t>},
      {"Int32", convert<std::int32_t>}, {"UInt32", convert<std::uint32_t>},
      {"Int16", convert<std::int16_t>}, {"UInt16", convert<std::uint16_t>},
      {"Int8", convert<std::int8_t>},   {"UInt8", convert<std::uint8_t>},
  };
  return known;
}

std::vector<double> parse_ascii(const std::string& place, std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<double> values;
  for (std::size_t at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    const std::string_view token = text.substr(at, end - at);
    const auto value = parse_number<double>(token);
    if (!value)
      throw InputError(place, fmt::format("the array contains \"{}\", expected a finite number{}", token,
                                          decimal_comma_hint(token)));
    values.push_back(*value);
    at = text.find_first_not_of(kSpace, end);
  }
  return values;
}

/// Returns an upper bound on the number of base64 characters that encode the block at the beginning of `text`. A block
/// is a header, which gives the length of the data, followed by the data of one array. Header and data may be encoded
/// separately or together.
/// @param header_size  size of the header before encoding (bytes)
std::size_t encoded_size(std::string_view text, std::size_t header_size) {
  const std::string header = from_base64(text.substr(0, 12)).substr(0, header_size);
  std::uint64_t length = 0;
  std::memcpy(&length, header.data(), header.size());
  return length > text.size() ? text.size() : 12 + 4 * (length / 3 + 2);
}

/// Returns the data of a block, which consists of a header and the data of one array. The header contains the length of
/// the data in bytes.
/// @param header_size  size of the header (bytes)
std::string_view payload(const std::string& place, std::string_view block, std::size_t header_size) {
  std::uint64_t length = 0;
  if (block.size() >= header_size) std::memcpy(&length, block.data(), header_size);
  if (block.size() < header_size || length > block.size() - header_size)
    throw InputError(place, fmt::format("the array is damaged: it has {} bytes, but its header says {}",
                                        block.size(), length));
  return block.substr(header_size, length);
}

/// Returns the data of an array that is compressed in blocks. A header of whole numbers precedes the blocks. It
/// contains the number of blocks, the size of a full block and of the last block before compression, and the compressed
/// size of each block.
/// @param encoded  whether `text` is base64, with header and blocks encoded separately
std::string inflate_blocks(const std::string& place, std::string_view text, std::size_t header_size,
                           bool encoded) {
  constexpr std::size_t kMostBlocks = 1'000'000;
  const auto bytes_of = [&](std::size_t n) { return encoded ? (n + 2) / 3 * 4 : n; };
  const auto head = [&](std::size_t n_words) {
    const std::string_view part = text.substr(0, bytes_of(n_words * header_size));
    std::string bytes = encoded ? from_base64(part) : std::string(part);
    if (bytes.size() < n_words * header_size)
      throw InputError(place, "the array is damaged: its header is cut short");
    std::vector<std::uint64_t> words(n_words, 0);
    for (std::size_t k = 0; k < n_words; ++k)
      std::memcpy(&words[k], bytes.data() + k * header_size, header_size);
    return words;
  };
  const std::uint64_t n_blocks = head(1)[0];
  if (n_blocks > kMostBlocks)
    throw InputError(place, fmt::format("the array is damaged: it has {} blocks", n_blocks));
  const std::vector<std::uint64_t> header = head(3 + n_blocks);
  text.remove_prefix(std::min(text.size(), bytes_of(header.size() * header_size)));
  std::uint64_t compressed = 0;
  for (std::uint64_t k = 0; k < n_blocks; ++k) {
    if (header[3 + k] > text.size())
      throw InputError(place, "the array is damaged: its last block is cut short");
    compressed += header[3 + k];
  }
  const std::string bytes = encoded ? from_base64(text.substr(0, bytes_of(compressed))) : std::string(text);
  std::string data;
  std::size_t at = 0;
  for (std::uint64_t k = 0; k < n_blocks; at += header[3 + k++]) {
    if (at + header[3 + k] > bytes.size())
      throw InputError(place, "the array is damaged: a block is cut short");
    const bool partial = k + 1 == n_blocks && header[2] != 0;
    data += inflated_by_zlib(place, std::string_view(bytes).substr(at, header[3 + k]),
                             partial ? header[2] : header[1]);
  }
  return data;
}

}  // namespace

struct VtkArrays::Document {
  std::string path;
  pugi::xml_document xml;
  std::string appended;  ///< content of the element AppendedData after "_"
  bool appended_raw = false;
  bool compressed = false;
  std::size_t header_size = 4;

  pugi::xml_node grid() const {
    const pugi::xml_node file = xml.child("VTKFile");
    return file.child("UnstructuredGrid") ? file.child("UnstructuredGrid") : file.child("PolyData");
  }
  pugi::xml_node section(const std::string& name) const {
    return name == "FieldData" ? grid().child("FieldData") : grid().child("Piece").child(name.c_str());
  }
  pugi::xml_node array(const std::string& in, const std::string& name) const {
    if (in == "Points") return section(in).child("DataArray");
    return section(in).find_child_by_attribute("DataArray", "Name", name.c_str());
  }
};

VtkArrays::VtkArrays(const std::string& path, const std::string& content) : document_(new Document) {
  Document& d = *document_;
  d.path = path;
  // The element AppendedData is removed before the text is parsed, because the raw bytes in this element are not XML.
  std::string text = content;
  if (const std::size_t begin = content.find("<AppendedData"); begin != std::string::npos) {
    const std::size_t end = content.rfind("</AppendedData>");
    const std::size_t mark = content.find('_', content.find('>', begin));
    if (end == std::string::npos || mark == std::string::npos || mark > end)
      throw InputError(path, "the element AppendedData of the file has no end");
    d.appended_raw = content.substr(begin, mark - begin).find("\"raw\"") != std::string::npos;
    d.appended = content.substr(mark + 1, end - mark - 1);
    text = content.substr(0, begin) + content.substr(end + std::strlen("</AppendedData>"));
  }
  const pugi::xml_parse_result parsed = d.xml.load_buffer(text.data(), text.size());
  if (!parsed)
    throw InputError(path,
                     fmt::format("the file is not XML: {} at byte {}", parsed.description(), parsed.offset));
  const pugi::xml_node file = d.xml.child("VTKFile");
  if (!d.grid()) throw InputError(path, "the file is not a VTKFile with an UnstructuredGrid or with PolyData");
  if (std::strcmp(file.attribute("byte_order").as_string("LittleEndian"), "LittleEndian") != 0)
    throw InputError(path, "byte_order = BigEndian, expected LittleEndian");
  const std::string compressor = file.attribute("compressor").as_string();
  d.compressed = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !d.compressed)
    throw InputError(
        path, fmt::format("the file is compressed by {}, expected vtkZLibDataCompressor: save it without "
                          "compression",
                          compressor));
  d.header_size = std::strcmp(file.attribute("header_type").as_string("UInt32"), "UInt64") == 0 ? 8 : 4;
  const auto pieces = d.grid().children("Piece");
  if (std::distance(pieces.begin(), pieces.end()) != 1)
    throw InputError(
        path, fmt::format("the file has {} pieces, expected one", std::distance(pieces.begin(), pieces.end())));
}

VtkArrays::~VtkArrays() = default;

std::int64_t VtkArrays::n_points() const {
  return document_->grid().child("Piece").attribute("NumberOfPoints").as_llong();
}

std::vector<std::string> VtkArrays::names(const std::string& section) const {
  std::vector<std::string> found;
  for (const pugi::xml_node array : document_->section(section).children("DataArray"))
    found.emplace_back(array.attribute("Name").as_string());
  return found;
}

bool VtkArrays::has(const std::string& section, const std::string& name) const {
  return static_cast<bool>(document_->array(section, name));
}

std::string VtkArrays::place(const std::string& section, const std::string& name) const {
  return fmt::format("{}, array {}{}{}", document_->path, section, name.empty() ? "" : "/", name);
}

std::vector<double> VtkArrays::read(const std::string& section, const std::string& name) const {
  const Document& d = *document_;
  const pugi::xml_node array = d.array(section, name);
  const std::string here = place(section, name);
  if (!array) throw InputError(here, "the array is missing");
  // Two arrays with the same name are an error. The section Points is not checked, because it has only one array, which
  // may have any name.
  for (pugi::xml_node next = array.next_sibling("DataArray"); next && section != "Points";
       next = next.next_sibling("DataArray"))
    if (name == next.attribute("Name").as_string())
      throw InputError(here, "the array occurs twice: rename or remove one of the two");
  const std::string format = array.attribute("format").as_string("ascii");
  const std::string type = array.attribute("type").as_string();
  const auto converter = converters().find(type);
  if (converter == converters().end())
    throw InputError(here, fmt::format("type = \"{}\", expected a type of numbers such as Float64", type));
  if (format == "ascii") return parse_ascii(here, array.text().as_string());

  std::string decoded, inflated;
  std::string_view block;
  if (format == "appended") {
    const auto offset = static_cast<std::size_t>(array.attribute("offset").as_ullong());
    if (offset > d.appended.size())
      throw InputError(here, fmt::format("offset = {} lies beyond the end of the appended data", offset));
    // The end of the appended block need not be searched for, because the block begins with its length.
    block = std::string_view(d.appended).substr(offset);
    if (!d.appended_raw && d.compressed) block = block.substr(0, block.find_first_of("< \n"));
    if (!d.appended_raw && !d.compressed)
      block = decoded = from_base64(block.substr(0, encoded_size(block, d.header_size)));
  } else if (format == "binary") {
    block = trimmed(array.text().as_string());
    if (!d.compressed) block = decoded = from_base64(block);
  } else {
    throw InputError(here, fmt::format("format = \"{}\", expected ascii, binary or appended", format));
  }
  const bool encoded = format == "binary" || !d.appended_raw;
  if (d.compressed) inflated = inflate_blocks(here, block, d.header_size, encoded);
  std::vector<double> values =
      converter->second(d.compressed ? std::string_view(inflated) : payload(here, block, d.header_size));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw InputError(here,
                       fmt::format("entry {} of the array is {}, expected a finite number", k, values[k]));
  return values;
}

}  // namespace floc
