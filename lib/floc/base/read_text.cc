#include "floc/base/read_text.h"

#include <algorithm>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"

namespace floc {

std::string_view foreign_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  for (const std::string_view mark : {"\xff\xfe\0\0"sv, "\0\0\xfe\xff"sv})
    if (text.starts_with(mark)) return "UTF-32";
  for (const std::string_view mark : {"\xff\xfe"sv, "\xfe\xff"sv})
    if (text.starts_with(mark)) return "UTF-16";
  if (text.size() >= 2 && (text[0] == '\0') != (text[1] == '\0')) return "UTF-16";
  return "";
}

bool ends_in_carriage_return(std::string_view text) {
  using namespace std::string_view_literals;
  const std::size_t end = text.find_first_of("\r\n\0"sv);
  if (end == std::string_view::npos || text[end] != '\r') return false;
  const std::size_t next = text.find_first_not_of('\r', end);
  return next != std::string_view::npos && text[next] != '\n';
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

void require_text(const std::string& place, std::string_view beginning) {
  if (const std::string_view encoding = foreign_encoding(beginning); !encoding.empty())
    throw InputError(place, "the file is in the encoding " + std::string(encoding) + ": save it as UTF-8");
  if (ends_in_carriage_return(beginning))
    throw InputError(
        place,
        "the lines of this file end in carriage returns alone, as on old Macs: save the file with the "
        "line ends of Unix or Windows");
}

std::string read_text(const std::string& path) {
  std::string text = read_file(path);
  require_text(path == "-" ? "stdin" : path, text);
  text.erase(0, text.size() - without_byte_order_mark(text).size());
  return text;
}

std::string decimal_comma_hint(std::string_view text) {
  std::string with_point(text);
  if (std::count(text.begin(), text.end(), ',') != 1) return "";
  with_point[text.find(',')] = '.';
  return parse_number<double>(with_point) ? " with a decimal point, not a comma" : "";
}

}  // namespace floc
