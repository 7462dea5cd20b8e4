#include "floc/io/table_layout.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "floc/base/parse_number.h"
#include "floc/io/table_cells.h"
#include "floc/io/table_units.h"

namespace floc {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t kSample = 200;  ///< number of lines that are analysed to find the layout

/// Whether a cell denotes a missing or undefined value.
bool is_missing(std::string_view cell) {
  constexpr std::array<std::string_view, 14> kMissing = {"",    "-",    "--",   "nan", "NaN", "NAN",  "inf",
                                                         "Inf", "-inf", "-Inf", "NA",  "n/a", "null", "None"};
  return std::find(kMissing.begin(), kMissing.end(), cell) != kMissing.end();
}

/// Splits a line of names into `n` cells. The cells are separated by blanks, but the names contain blanks, too. Two
/// ways are tried. In the first, a unit in brackets is joined to the name before it; in the second, two or more blanks
/// separate the names.
/// @return the cells; empty if neither way gives `n` cells
Cells names_between_blanks(std::string_view line, std::size_t n) {
  Cells merged;
  for (std::string& word : split_cells(line, ' ').value_or(Cells{})) {
    if (!merged.empty() && (word.starts_with('[') || word.starts_with('(')))
      merged.back() += " " + word;
    else
      merged.push_back(std::move(word));
  }
  if (merged.size() == n) return merged;
  Cells spaced;
  for (std::string_view rest = trimmed(line); !rest.empty();) {
    const std::size_t end = std::min({rest.find("  "), rest.find('\t'), rest.size()});
    spaced.emplace_back(trimmed(rest.substr(0, end)));
    rest = trimmed(rest.substr(end));
  }
  return spaced.size() == n ? spaced : Cells{};
}

/// Returns two counts by which lines are ranked in the search for the line of names: the number of cells that are
/// wanted names, and the number of cells that are words.
std::pair<std::ptrdiff_t, std::ptrdiff_t> rank_as_names(const Cells& cells,
                                                        const std::vector<std::string>& wanted) {
  const auto is_wanted = [&](const std::string& cell) {
    return std::find(wanted.begin(), wanted.end(), cell) != wanted.end() ||
           std::find(wanted.begin(), wanted.end(), name_and_unit(cell).first) != wanted.end();
  };
  const auto is_word = [](const std::string& cell) { return !is_missing(cell) && !is_number(cell, true); };
  return {std::count_if(cells.begin(), cells.end(), is_wanted),
          std::count_if(cells.begin(), cells.end(), is_word)};
}

/// The first lines of a table, split at a given separator.
class SplitLines {
 public:
  SplitLines(const TableLines& lines, char separator, const std::vector<std::string>& wanted)
      : separator_(separator), comments_(lines.comments) {
    const std::size_t n = std::min(lines.rows.size(), kSample);
    for (std::size_t i = 0; i < n; ++i)
      rows_.push_back(split_cells(lines.rows[i].text, separator).value_or(Cells{std::string()}));
    find_width();
    find_first(wanted);
    if (separator == ' ')
      for (std::size_t i = 0; i < first_; ++i)
        if (Cells cells = names_between_blanks(lines.rows[i].text, width_);
            rows_[i].size() != width_ && !cells.empty())
          rows_[i] = std::move(cells);
  }

  char separator() const { return separator_; }
  const std::vector<Cells>& rows() const { return rows_; }
  std::size_t width() const { return width_; }  ///< usual number of cells
  /// Largest number of cells in a row of data, not counting empty cells at the end of the row.
  std::size_t filled() const { return filled_; }
  std::size_t first() const { return first_; }  ///< index of the first row of data
  bool has_numbers() const { return first_ < rows_.size(); }

  std::size_t count_numbers(const Cells& cells) const {
    const auto number = [this](const std::string& cell) { return is_number(cell, separator_ != ','); };
    return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), number));
  }

  /// Whether a line has as many cells as the rows of data. Empty cells at the end may be missing.
  bool fits(const Cells& cells) const {
    return cells.size() == width_ || without_trailing_empties(cells) == filled_;
  }
  bool has_names() const { return first_ > 0 ? fits(rows_[first_ - 1]) : !names_in_comment().first.empty(); }

  /// If a comment above the table has one word for each column, returns these words as the names of the columns, and
  /// the number of the line of the comment. If there is no such comment, the list of names is empty.
  std::pair<Cells, int> names_in_comment() const {
    for (auto comment = comments_.rbegin(); comment != comments_.rend(); ++comment)
      for (const char separator : {separator_, ' '}) {
        Cells cells = split_cells(comment->text, separator).value_or(Cells{});
        if (separator == ' ' && cells.size() != width_) cells = names_between_blanks(comment->text, width_);
        if (cells.size() == width_ && count_numbers(cells) == 0) return {cells, comment->number};
      }
    return {};
  }

  /// Fraction of the cells in the rows of data that are numbers, from 0 to 1. Empty cells are not counted.
  double share_of_numbers() const {
    std::size_t n_numbers = 0, n_filled = 0;
    for (std::size_t i = first_; i < rows_.size(); ++i) {
      n_numbers += count_numbers(rows_[i]);
      n_filled += rows_[i].size() -
                  static_cast<std::size_t>(std::count(rows_[i].begin(), rows_[i].end(), std::string()));
    }
    return n_filled == 0 ? 0.0 : static_cast<double>(n_numbers) / static_cast<double>(n_filled);
  }

  /// Whether at least half of the cells in the rows of data are numbers, and a line above them names the columns.
  bool is_plausible() const { return has_numbers() && has_names() && share_of_numbers() >= 0.5; }

 private:
  /// Finds the usual number of cells in a line. For each number n, all numeric cells in lines with n cells are counted;
  /// the n with the largest count is the usual number. If no cell of the text is numeric, the most frequent number of
  /// cells is the usual number.
  void find_width() {
    // key: number of cells of a line; value: count of numbers in all lines with this number of cells, and count of
    // these lines
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> counts;
    for (const Cells& cells : rows_) {
      counts[cells.size()].first += count_numbers(cells);
      counts[cells.size()].second += 1;
    }
    for (const auto& [width, count] : counts)
      if (width_ == 0 || count >= counts[width_]) width_ = width;
  }

  /// Finds the first row of data. If a line contains two or more of the wanted names, the first row is below this line.
  void find_first(const std::vector<std::string>& wanted) {
    std::size_t most = 0;
    auto begin = rows_.begin();
    for (auto row = rows_.begin(); row != rows_.end(); ++row) {
      if (row->size() == width_) most = std::max(most, count_numbers(*row));
      if (fits(*row) && begin == rows_.begin() && rank_as_names(*row, wanted).first >= 2) begin = row + 1;
    }
    const auto is_data = [&](const Cells& cells) {
      return cells.size() == width_ && most > 0 && 2 * count_numbers(cells) > most;
    };
    first_ = static_cast<std::size_t>(std::find_if(begin, rows_.end(), is_data) - rows_.begin());
    for (std::size_t i = first_; i < rows_.size(); ++i)
      if (rows_[i].size() == width_) filled_ = std::max(filled_, without_trailing_empties(rows_[i]));
  }

  char separator_;
  const std::vector<TableLine>& comments_;
  std::vector<Cells> rows_;
  std::size_t width_ = 0, first_ = 0;
  std::size_t filled_ = 0;
};

/// Returns the separator of a table without numbers: the first of comma, tab and semicolon that occurs in the first
/// line. If none of them occurs, returns a blank if all lines have the same number of words, two or more, else a comma.
char separator_of_words(const TableLines& lines) {
  const std::string_view first = lines.rows.empty() ? std::string_view() : lines.rows.front().text;
  for (const char candidate : {',', '\t', ';'})
    if (first.find(candidate) != std::string_view::npos) return candidate;
  const std::size_t n = split_cells(first, ' ').value_or(Cells{}).size();
  const auto has_as_many = [n](const TableLine& line) {
    return split_cells(line.text, ' ').value_or(Cells{}).size() == n;
  };
  return n > 1 && std::all_of(lines.rows.begin(), lines.rows.end(), has_as_many) ? ' ' : ',';
}

SplitLines split_at_best_separator(const TableLines& lines, const std::vector<std::string>& wanted) {
  std::vector<SplitLines> candidates;
  for (const char separator : {',', ';', '\t', ' '}) candidates.emplace_back(lines, separator, wanted);
  // A separator that divides the table into several columns is preferred: a single column of numbers with decimal
  // commas may in fact be several columns of integers.
  const auto rank = [](const SplitLines& split) {
    const bool several = split.width() > 1;
    return std::tuple(several && split.is_plausible(), several && split.has_numbers() && split.has_names(),
                      split.is_plausible(), split.share_of_numbers(), split.width());
  };
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return best->share_of_numbers() > 0.0 ? *best : SplitLines(lines, separator_of_words(lines), wanted);
}

bool is_blank(const Cells& cells) {
  return without_trailing_empties(cells) == 0;
}

/// Whether a row below the names contains units. Empty cells, and cells such as "-" for a column without unit, do not
/// count. The row contains units if all other cells are units, or if at least half of the other cells are units and one
/// of these units is % or longer than a single letter.
bool is_units_row(const Cells& cells) {
  std::size_t n_words = 0, n_units = 0, n_clear = 0;
  for (const std::string& cell : cells) {
    if (cell.empty() || states_no_unit(cell)) continue;
    if (is_missing(cell)) return false;  // a row of data whose values are missing
    const std::string unit = unit_in_cell(cell);
    ++n_words;
    n_units += !unit.empty();
    n_clear += unit.size() > 1 || unit == "%";
  }
  return !is_blank(cells) && (n_units == n_words || (n_clear > 0 && 2 * n_units >= n_words));
}

/// Sets the names of the columns in `layout` from one of the lines `begin` to `end - 1`. The lines between the names
/// and the data may contain units.
void take_names(const SplitLines& split, const TableLines& lines, std::size_t begin, std::size_t end,
                const std::vector<std::string>& wanted, TableLayout& layout) {
  const std::vector<Cells>& rows = split.rows();
  // A title may contain the separator and thus have words above columns without data. These words do not count as
  // names.
  const auto rank = [&](const Cells& cells) {
    const std::size_t n = split.has_numbers() ? std::min(cells.size(), split.filled()) : cells.size();
    return rank_as_names({cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(n)}, wanted);
  };
  std::size_t names = begin;
  for (std::size_t i = begin + 1; i < end; ++i)
    if (!is_units_row(rows[i]) && rank(rows[i]) >= rank(rows[names])) names = i;
  layout.names = rows[names];
  layout.names_line = lines.rows[names].number;
  if (names > 0) layout.last_title_line = lines.rows[names - 1].number;
  for (std::size_t i = names; i-- > begin;) layout.other_names.push_back(rows[i]);
  layout.first_row = names + 1;
  while (layout.first_row < end && is_blank(rows[layout.first_row])) ++layout.first_row;
  if (layout.first_row < end && is_units_row(rows[layout.first_row])) {
    layout.units = rows[layout.first_row];
    layout.units_line = lines.rows[layout.first_row].number;
    ++layout.first_row;
  }
}

/// Whether a line ends within a quoted cell: its number of quotation marks is odd, and its last quotation mark is at
/// the beginning of a cell.
bool ends_within_quotes(std::string_view line) {
  const std::size_t last = line.rfind('"');
  if (last == std::string_view::npos || std::count(line.begin(), line.end(), '"') % 2 == 0) return false;
  return last == 0 || std::string_view(",; \t").find(line[last - 1]) != std::string_view::npos;
}

/// Returns the end of the first row of a text. If the first line ends within a quoted cell and one of the next few
/// lines closes the cell, the row ends with the line that closes the cell. Otherwise it ends with the first line.
std::size_t end_of_row(std::string_view text) {
  constexpr int kMostLines = 5;  // the name of a column in a spreadsheet may extend over several lines
  const std::size_t end = std::min(text.find('\n'), text.size());
  if (!ends_within_quotes(text.substr(0, end))) return end;
  std::size_t later = end;
  for (int k = 1; k < kMostLines && later < text.size(); ++k) {
    const std::size_t begin = later + 1;
    later = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, later - begin);
    if (std::count(line.begin(), line.end(), '"') % 2 == 1) return later;
  }
  return end;
}

}  // namespace

TableLines table_lines(std::string_view text) {
  TableLines lines;
  for (int number = 1; !text.empty();) {
    const std::size_t end = end_of_row(text);
    const std::string_view line = text.substr(0, end), words = trimmed(line);
    const int here = number;
    number += 1 + static_cast<int>(std::count(line.begin(), line.end(), '\n'));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words.empty() || (here == 1 && words.size() == 5 && words.starts_with("sep="))) continue;
    if (!words.starts_with('#'))
      lines.rows.push_back({here, line});
    else if (lines.rows.empty())
      lines.comments.push_back({here, words.substr(std::min(words.find_first_not_of("# \t"), words.size()))});
  }
  return lines;
}

TableLayout find_table_layout(const TableLines& lines, const std::vector<std::string>& wanted) {
  const SplitLines split = split_at_best_separator(lines, wanted);
  TableLayout layout;
  layout.separator = split.separator();
  if (lines.rows.empty()) return layout;
  // In a table without numbers, titles cannot be distinguished from names. The first line is assumed to contain the
  // names.
  if (!split.has_numbers()) {
    take_names(split, lines, 0, 1, wanted, layout);
    return layout;
  }
  std::size_t begin = split.first();
  while (begin > 0 && split.fits(split.rows()[begin - 1])) --begin;
  if (begin < split.first()) {
    take_names(split, lines, begin, split.first(), wanted, layout);
  } else if (begin > 0) {
    take_names(split, lines, begin - 1, begin, wanted, layout);
  } else {
    std::tie(layout.names, layout.names_line) = split.names_in_comment();
  }
  return layout;
}

const char* separator_words(char separator) {
  switch (separator) {
    case ';':
      return "semicolons";
    case '\t':
      return "tabs";
    case ' ':
      return "blanks";
    default:
      return "commas";
  }
}

}  // namespace floc
