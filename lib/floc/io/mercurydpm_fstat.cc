// Reads .fstat files of MercuryDPM, which list contacts.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/keyed_line.h"
#include "floc/io/mercurydpm.h"
#include "floc/io/table_text.h"

namespace floc {
namespace {

/// Returns the times of the blocks of an .fstat file. A block begins with a comment that contains its time; older files
/// have rows without comments. A block without rows has no contacts.
std::vector<double> times_in_fstat(const std::string& text) {
  std::vector<double> times;
  std::istringstream in(text);
  bool in_comment = false;
  for (std::string row; std::getline(in, row);) {
    std::string_view words = trimmed(row);
    const bool is_comment = words.starts_with('#');
    if (is_comment) words = trimmed(words.substr(1));
    const bool has_time = !words.empty() && !(is_comment && in_comment);
    in_comment = is_comment;
    if (!has_time) continue;
    const auto time = parse_number<double>(words.substr(0, words.find_first_of(" \t")));
    if (time && (times.empty() || times.back() != *time)) times.push_back(*time);
  }
  return times;
}

/// Returns the time whose contacts are read from an .fstat file: the time of the restart file, as the .fstat file
/// writes it, or, if the grains have no time, the last time in the file.
/// @throws InputError if the file does not contain the time of the restart file
double time_in_fstat(const std::string& text, const std::string& path, const ListedPacking& listed) {
  constexpr double kSixDigits = 5e-6;  // relative; both files may have few digits
  const std::vector<double> times = times_in_fstat(text);
  if (times.empty()) throw InputError(path, "the file has no rows of contacts");
  if (!listed.time) return times.back();
  const auto distance = [&](double time) { return std::abs(time - *listed.time); };
  const double nearest = *std::min_element(times.begin(), times.end(),
                                           [&](double a, double b) { return distance(a) < distance(b); });
  if (distance(nearest) > kSixDigits * std::max(std::abs(nearest), std::abs(*listed.time)))
    throw InputError(path,
                     fmt::format("the grains of {} are those at the time {}, but this file has contacts at "
                                 "{}the time {}: expected contacts at the time of the grains",
                                 listed.place, *listed.time,
                                 times.size() > 1 ? "other times, the nearest of which is " : "", nearest));
  return nearest;
}

/// Returns the identifier of a grain in a row of an .fstat file. If the grains come from a restart file, the row
/// contains the position of the grain in the restart file.
std::int64_t fstat_grain(const KeyedLine& line, std::size_t k, const char* what, const ListedPacking& listed) {
  const std::int64_t number = line.integer(k, what);
  if (!listed.in_order_of_fstat) return number;
  if (number >= 0 && number < std::ssize(listed.grains))
    return listed.grains[static_cast<std::size_t>(number)].id;
  throw InputError(line.place(), fmt::format("{} is {}, but {} has the grains 0 to {}", what, number,
                                             listed.place, std::ssize(listed.grains) - 1));
}

/// Reads one row of an .fstat file.
ListedContact read_fstat_row(const KeyedLine& line, const ImportOptions& options, int dimension,
                             const ListedPacking& listed) {
  ListedContact c;
  c.place = line.file_line();
  c.id1 = fstat_grain(line, 1, "the first grain", listed);
  const std::int64_t second = line.integer(2, "the second grain");
  const bool on_wall = second < 0;
  const double sign = on_wall ? -1.0 : 1.0;
  if (on_wall) {
    const auto found = options.wall_ids.find(second);
    if (found == options.wall_ids.end())
      throw InputError(
          line.place(),
          fmt::format("the second body is the wall {0}: give the position of this wall, for example "
                      "--wall-ids {0}=z-",
                      second));
    c.wall = found->second;
  } else {
    c.id2 = fstat_grain(line, 2, "the second grain", listed);
  }
  // Numbers 3 to 7 of the line (counted from 0), the contact point and the overlaps, are not read: the positions of the
  // grains determine the contact point and the normal overlap, and the force determines the tangential spring.
  c.force = sign * (line.number(8, "the normal force") * line.vector(10, "the normal") +
                    line.number(9, "the tangential force") * line.vector(13, "the tangent"));
  if (dimension == 2) (*c.force)[2] = 0.0;
  return c;
}

}  // namespace

bool is_mercurydpm_fstat(const std::string& path) {
  std::istringstream in(beginning_of_table(path));
  for (std::string line; std::getline(in, line);) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() != 16) return false;
    return std::all_of(words.begin(), words.end(),
                       [](std::string_view word) { return parse_number<double>(word).has_value(); });
  }
  return false;
}

std::vector<ListedContact> read_mercurydpm_contacts(const ImportOptions& options, int dimension,
                                                    const ListedPacking& listed) {
  std::vector<ListedContact> contacts;
  const std::string text = read_text(options.contacts);
  const double time = time_in_fstat(text, options.contacts, listed);
  const auto file = std::make_shared<const std::string>(options.contacts + ":");
  std::istringstream in(text);
  int number = 0;
  bool begins = true;  // whether the next row is the first one after a comment or a row of another time
  for (std::string row; std::getline(in, row);) {
    ++number;
    if (trimmed(row).starts_with('#')) begins = true;
    if (trimmed(row).empty() || trimmed(row).starts_with('#')) continue;
    const KeyedLine line(file, number, row);
    if (line.size() != 16)
      throw InputError(line.place(), fmt::format("the line has {} numbers, expected 16", line.size()));
    const bool is_wanted = line.number(0, "the time") == time;
    // If the file lists the wanted time twice, as after a restart of the run, only the last list is kept.
    if (is_wanted && begins) contacts.clear();
    begins = !is_wanted;
    if (is_wanted) contacts.push_back(read_fstat_row(line, options, dimension, listed));
  }
  return contacts;
}

}  // namespace floc
