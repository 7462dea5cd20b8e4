#include "floc/io/table_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/base/read_text.h"

namespace floc {
namespace {

constexpr char32_t kReplacement = 0xfffd;  ///< character that replaces each character that cannot be decoded

void append_utf8(char32_t c, std::string& text) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  if (c < 0x80) return add(c);
  if (c < 0x800) return add(0xc0 | (c >> 6)), add(0x80 | (c & 0x3f));
  if (c >= 0x10000) {
    add(0xf0 | (c >> 18));
    add(0x80 | ((c >> 12) & 0x3f));
  } else {
    add(0xe0 | (c >> 12));
  }
  add(0x80 | ((c >> 6) & 0x3f));
  add(0x80 | (c & 0x3f));
}

/// Returns the number of bytes of a UTF-8 character whose first byte is `lead`; 0 if no character begins with this
/// byte.
std::size_t length_in_utf8(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  return lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_in_utf8(static_cast<unsigned char>(text[at]));
    if (length == 0 || at + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[at + k]) & 0xc0) != 0x80) return false;
    at += length;
  }
  return true;
}

/// Characters 0x80 to 0x9f of the code page 1252; 0: no character. Latin-1 has no printable characters in this range.
constexpr std::array<char16_t, 32> kWindows = {0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021,
                                               0x02c6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017d, 0,
                                               0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
                                               0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

std::string from_latin_1(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    char32_t c = static_cast<unsigned char>(byte);
    if (c >= 0x80 && c < 0xa0) c = kWindows[c - 0x80] != 0 ? kWindows[c - 0x80] : kReplacement;
    append_utf8(c, text);
  }
  return text;
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]),
               second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<char32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    char32_t c = unit(at);
    if (c >= 0xd800 && c < 0xdc00 && at + 3 < bytes.size()) {
      const char32_t low = unit(at + 2);
      if (low >= 0xdc00 && low < 0xe000) {
        c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
        at += 2;
      }
    }
    append_utf8(c >= 0xd800 && c < 0xe000 ? kReplacement : c, text);
  }
  return text;
}

/// Whether the high byte of each character in UTF-16 comes first. The byte order mark decides. Without this mark, the
/// first byte decides: a zero byte is the high byte of an ASCII character.
bool is_big_endian(std::string_view utf16) {
  return utf16.starts_with("\xfe\xff") || utf16[0] == '\0';
}

/// Replaces special characters of spreadsheets and word processors: minus signs by hyphens, and no-break blanks by
/// blanks.
std::string with_plain_signs(std::string text) {
  constexpr std::string_view kMinus = "\xe2\x88\x92", kNarrowBlank = "\xe2\x80\xaf", kBlank = "\xc2\xa0";
  if (text.find(kMinus) == std::string::npos && text.find(kNarrowBlank) == std::string::npos &&
      text.find(kBlank) == std::string::npos)
    return text;
  std::string plain;
  for (std::string_view rest = text; !rest.empty();) {
    const bool minus = rest.starts_with(kMinus), narrow = rest.starts_with(kNarrowBlank);
    const bool blank = narrow || rest.starts_with(kBlank);
    plain += minus ? '-' : blank ? ' ' : rest.front();
    rest.remove_prefix(minus || narrow ? kMinus.size() : blank ? kBlank.size() : 1);
  }
  return plain;
}

}  // namespace

TableText decoded_table(const std::string& place, std::string bytes) {
  const std::string_view foreign = foreign_encoding(bytes);
  if (foreign == "UTF-32") throw InputError(place, "the file is in the encoding UTF-32: save it as UTF-8");
  TableText table;
  if (foreign == "UTF-16") {
    table = {from_utf16(bytes, is_big_endian(bytes)), "UTF-16"};
  } else if (!is_utf8(bytes)) {
    table = {from_latin_1(bytes), "Latin-1"};
  } else {
    table.text = std::move(bytes);
  }
  table.text.erase(0, table.text.size() - without_byte_order_mark(table.text).size());
  table.text = with_plain_signs(std::move(table.text));
  if (ends_in_carriage_return(table.text)) std::replace(table.text.begin(), table.text.end(), '\r', '\n');
  return table;
}

std::string beginning_of_table(const std::string& path) {
  return decoded_table(path, read_beginning(path, 1 << 16)).text;
}

TableText read_table_text(const std::string& path) {
  return decoded_table(path == "-" ? "stdin" : path, read_file(path));
}

}  // namespace floc
