#include "floc/run_directory/motion_table.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/atomic_file.h"

namespace floc {

template <int Dim>
MotionTable<Dim>::MotionTable(std::string file, std::string header, const RunPoint& point)
    : file_(std::move(file)), header_(std::move(header)) {
  read_rows(point);
}

/// Reads the rows of an existing file up to the time of `point`. Later rows are dropped. A killed run may have written
/// rows after its last checkpoint, and the resumed run writes these rows again.
template <int Dim>
void MotionTable<Dim>::read_rows(const RunPoint& point) {
  if (!std::filesystem::exists(file_)) return;
  std::istringstream in(read_file(file_));
  std::string line;
  if (!std::getline(in, line)) return;
  if (line != header_)
    throw InputError(file_ + ":1",
                     "the columns of this table differ from those that this version of floc writes: " + line);
  const double reached = (point.time + point.equilibration_time) * (1.0 + 1e-12);
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream fields(line);
    std::string step, branch, pressure, time;
    for (std::string* field : {&step, &branch, &pressure, &time}) std::getline(fields, *field, ',');
    char* end = nullptr;
    const double t = std::strtod(time.c_str(), &end);
    if (time.empty() || *end != '\0')
      throw InputError(fmt::format("{}:{}", file_, number), "time = '" + time + "': expected a number");
    if (t <= reached) rows_.push_back(line);
  }
}

template <int Dim>
std::string MotionTable<Dim>::place_of(const Run<Dim>& run) {
  return fmt::format("{},{},{}", run.point().step, run.target().branch, run.pressure());
}

template <int Dim>
void MotionTable<Dim>::write() const {
  std::string text = header_ + "\n";
  for (const std::string& row : rows_) text += row + "\n";
  write_bytes_atomically(file_, text);
}

template class MotionTable<2>;
template class MotionTable<3>;

}  // namespace floc
