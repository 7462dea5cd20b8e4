#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "floc/io/csv_packing.h"
#include "floc/io/law_text.h"
#include "floc/tables/fit_tables.h"
#include "support/contact_laws.h"
#include "support/scratch_directory.h"

/// Writes one table in hundreds of dialects, as different programs and countries do. When the table is read as a load
/// path, as grains or as contacts, each dialect must give the same numbers.
namespace floc {
namespace {

using Rows = std::vector<std::vector<std::string>>;

enum class Encoding { utf8, utf8_with_mark, latin1, utf16_little, utf16_big };

/// Format in which a table is written.
struct Dialect {
  char separator = ',';
  bool decimal_comma = false;
  Encoding encoding = Encoding::utf8;
  std::string line_end = "\n";
  int n_titles = 0;
  enum { none, in_header, in_row, in_row_with_brackets } units = none;
  bool blank_rows = false, comments = false, quotes = false, whole_numbers_as_floats = false;
  bool ends_with_separator = false, exponents = false, padded = false, commented_header = false;

  std::string words() const {
    return fmt::format(
        "separator '{}', comma {}, encoding {}, line end of {}, {} titles, units {}, blank rows {}, comments "
        "{}, quotes {}, "
        "floats {}, last separator {}, exponents {}, padded {}, header in a comment {}",
        separator, decimal_comma, static_cast<int>(encoding), line_end.size(), n_titles,
        static_cast<int>(units), blank_rows, comments, quotes, whole_numbers_as_floats, ends_with_separator,
        exponents, padded, commented_header);
  }
};

/// Content of a table: names, units and numbers. A number without a decimal point is an integer.
struct Content {
  std::vector<std::string> names, units;
  Rows rows;
};

std::string number_text(std::string number, const Dialect& dialect) {
  const bool whole = number.find('.') == std::string::npos;
  if (whole && dialect.whole_numbers_as_floats) number += ".0";
  if (!whole && dialect.exponents) number += "e+00";
  if (dialect.decimal_comma)
    for (char& c : number)
      if (c == '.') c = ',';
  return dialect.quotes ? '"' + number + '"' : number;
}

std::string line_of(std::vector<std::string> cells, const Dialect& dialect) {
  std::string line = dialect.padded ? "  " : "";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += dialect.separator == ' ' ? std::string("   ") : std::string(1, dialect.separator);
    if (k > 0 && dialect.padded) line += ' ';
    line += cells[k];
  }
  if (dialect.ends_with_separator && dialect.separator != ' ') line += dialect.separator;
  return line + dialect.line_end;
}

/// Returns the table as UTF-8 text.
std::string text_of(const Content& content, const Dialect& dialect) {
  std::string text;
  const char* titles[] = {"Prüfung vom 3. Mai, Tiefe 4,5 m", "Labor;Zürich;12", "Probe 12, gestört"};
  for (int k = 0; k < dialect.n_titles; ++k) text += titles[k] + dialect.line_end;
  if (dialect.comments) text += "# müde geprüft" + dialect.line_end;
  std::vector<std::string> names = content.names, units = content.units;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (dialect.units == Dialect::in_header && !units[k].empty()) names[k] += " [" + units[k] + "]";
    if (dialect.quotes) names[k] = '"' + names[k] + '"';
  }
  text += (dialect.commented_header ? "# " : "") + line_of(names, dialect);
  if (dialect.units >= Dialect::in_row) {
    for (std::string& unit : units) {
      if (unit.empty()) unit = "-";
      if (dialect.units == Dialect::in_row_with_brackets) unit = "[" + unit + "]";
    }
    text += line_of(units, dialect);
  }
  for (std::size_t i = 0; i < content.rows.size(); ++i) {
    if (dialect.blank_rows && i % 3 == 0) text += dialect.line_end;
    if (dialect.blank_rows && i % 4 == 1 && dialect.separator != ' ')
      text += std::string(content.names.size() - 1, dialect.separator) + dialect.line_end;
    if (dialect.comments && i % 5 == 2) text += "  # nächste Stufe; 1,2" + dialect.line_end;
    std::vector<std::string> cells;
    for (const std::string& number : content.rows[i]) cells.push_back(number_text(number, dialect));
    text += line_of(cells, dialect);
  }
  return text;
}

std::string encoded(const std::string& utf8, Encoding encoding) {
  if (encoding == Encoding::utf8) return utf8;
  if (encoding == Encoding::utf8_with_mark) return "\xef\xbb\xbf" + utf8;
  std::string bytes;
  const auto add = [&](unsigned c) {
    if (encoding == Encoding::latin1) return bytes.push_back(static_cast<char>(c));
    const char high = static_cast<char>(c >> 8), low = static_cast<char>(c & 0xff);
    bytes.push_back(encoding == Encoding::utf16_big ? high : low);
    bytes.push_back(encoding == Encoding::utf16_big ? low : high);
  };
  if (encoding != Encoding::latin1) add(0xfeff);
  for (std::size_t at = 0; at < utf8.size(); ++at) {
    const auto lead = static_cast<unsigned char>(utf8[at]);
    // All letters of this test exist in Latin-1, so they take one or two bytes in UTF-8.
    add(lead < 0x80 ? lead : (lead & 0x1fu) << 6 | (static_cast<unsigned char>(utf8[++at]) & 0x3fu));
  }
  return bytes;
}

/// Returns dialects with each separator, each decimal mark that can be used with this separator, each encoding and each
/// line end. All other features of a dialect are drawn at random.
std::vector<Dialect> dialects() {
  std::vector<Dialect> all;
  std::mt19937 random(47);
  const auto coin = [&random] { return random() % 2 == 0; };
  for (int round = 0; round < 4; ++round)
    for (const char separator : {',', ';', '\t', ' '})
      for (const bool decimal_comma : {false, true})
        for (const Encoding encoding : {Encoding::utf8, Encoding::utf8_with_mark, Encoding::latin1,
                                        Encoding::utf16_little, Encoding::utf16_big})
          for (const char* line_end : {"\n", "\r\n", "\r"}) {
            if (separator == ',' && decimal_comma) continue;
            Dialect d{separator, decimal_comma, encoding, line_end};
            d.commented_header = random() % 5 == 0;
            if (!d.commented_header) {
              d.n_titles = static_cast<int>(random() % 4);
              d.units = static_cast<decltype(d.units)>(random() % 4);
            }
            d.blank_rows = coin(), d.comments = coin(), d.quotes = coin(), d.whole_numbers_as_floats = coin();
            d.ends_with_separator = !d.commented_header && random() % 4 == 0;
            d.exponents = random() % 4 == 0, d.padded = coin();
            all.push_back(d);
          }
  return all;
}

Content path() {
  Content content{{"Spannung", "Porenzahl"}, {"kPa", ""}, {}};
  double e = 0.95;
  for (const char* P :
       {"12.5", "25", "25", "50", "100", "200", "400", "400", "200", "100", "200", "400", "800"})
    content.rows.push_back({P, fmt::format("{:.4f}", e -= 0.0123)});
  return content;
}

Content grains() {
  return {{"id", "x", "y", "radius"},
          {"", "mm", "mm", "mm"},
          {{"7", "4.4", "1", "0.5"},
           {"3", "3.5", "1", "0.5"},
           {"5", "2.7", "1", "0.5"},
           {"11", "1.25", "2.125", "0.25"}}};
}

Content contacts() {
  return {
      {"id1", "id2", "normal_force"}, {"", "", ""}, {{"7", "3", "1.5"}, {"3", "5", "2"}, {"7", "5", "0.0"}}};
}

class TableDialects : public testing::Test {
 protected:
  std::string write(const Content& content, const Dialect& dialect) {
    std::string name = scratch_.file(fmt::format("{}.csv", ++n_files_));
    std::ofstream(name, std::ios::binary) << encoded(text_of(content, dialect), dialect.encoding);
    return name;
  }
  Packing<2> packing(const std::string& grains, const std::string& contacts) {
    ImportOptions options;
    options.law = parse_law("", "normal.stiffness=10");
    options.cell = {{4, 0}, {1, 3}};
    options.contacts = contacts;
    return std::get<State<2>>(read_csv_packing(grains, options).state).packing;
  }

  test::ScratchDirectory scratch_;
  int n_files_ = 0;
};

TEST_F(TableDialects, OfALoadPathAreReadToTheSameNumbers) {
  const PathTable plain = read_path(write(path(), {}), {});
  ASSERT_EQ(plain.rows.size(), 13u);
  int n = 0;
  for (const Dialect& dialect : dialects()) {
    SCOPED_TRACE(dialect.words());
    const std::string file = write(path(), dialect);
    PathTable read;
    ASSERT_NO_THROW(read = read_path(file, {})) << text_of(path(), dialect);
    ASSERT_EQ(read.rows.size(), plain.rows.size());
    for (std::size_t i = 0; i < read.rows.size(); ++i) {
      ASSERT_EQ(read.rows[i].P_star, plain.rows[i].P_star);
      ASSERT_EQ(read.rows[i].phi, plain.rows[i].phi);
    }
    EXPECT_EQ(read.unit, dialect.units == Dialect::none ? "" : "kPa");
    EXPECT_THAT(read.reading,
                testing::StartsWith(dialect.units == Dialect::none
                                        ? "read 13 rows: pressure, void ratio; 2 reversals"
                                        : "read 13 rows: pressure in kPa, void ratio; 2 reversals"));
    ++n;
  }
  fmt::print("{} dialects of a load path\n", n);
  EXPECT_GT(n, 400);
}

TEST_F(TableDialects, OfGrainsAndContactsAreReadToTheSameNumbers) {
  const Packing<2> plain = packing(write(grains(), {}), write(contacts(), {}));
  ASSERT_EQ(plain.contacts.size(), 2);
  const std::vector<Dialect> all = dialects();
  for (std::size_t k = 0; k < all.size(); ++k) {
    SCOPED_TRACE(all[k].words());
    const Dialect& of_contacts = all[(k + 7) % all.size()];
    const std::string file = write(grains(), all[k]), list = write(contacts(), of_contacts);
    Packing<2> read;
    ASSERT_NO_THROW(read = packing(file, list))
        << text_of(grains(), all[k]) << text_of(contacts(), of_contacts);
    ASSERT_EQ(read.grains.size(), plain.grains.size());
    for (int i = 0; i < read.grains.size(); ++i) {
      ASSERT_EQ(read.grains.position[i], plain.grains.position[i]);
      ASSERT_EQ(read.grains.radius[i], plain.grains.radius[i]);
    }
    ASSERT_EQ(read.contacts.size(), plain.contacts.size());
    for (std::size_t c = 0; c < read.contacts.size(); ++c)
      ASSERT_EQ(read.contacts[c].normal_force, plain.contacts[c].normal_force);
  }
  fmt::print("{} dialects of grains, with as many of contacts\n", all.size());
}

}  // namespace
}  // namespace floc
