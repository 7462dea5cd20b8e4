#include "floc/run/contact_tracker.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/structure/contact_changes.h"

namespace floc {
namespace {

constexpr const char* kHeader = "step,branch,P,time,phi,n_contacts,gained,lost,kept";

}  // namespace

ContactTracker::ContactTracker(const std::string& file, const Run<2>& run, Packing<2> start)
    : file_(file), start_(std::move(start)), previous_(run.packing()) {
  read_rows(run.point());
}

/// Rows of a run that was killed may lead beyond the point it goes on from.
void ContactTracker::read_rows(const RunPoint& point) {
  std::ifstream in(file_);
  std::string line;
  if (!std::getline(in, line)) return;
  if (line != kHeader) throw InputError(file_ + ":1", "columns are not those of this version of floc: " + line);
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

void ContactTracker::record(const Run<2>& run, const Packing<2>& packing, double time) {
  const ContactChanges<2> since = contact_changes(previous_, packing);
  const ContactChanges<2> in_step = contact_changes(start_, packing);
  rows_.push_back(fmt::format("{},{},{},{},{},{},{},{},{}", run.point().step, run.target().branch,
                              run.target().pressure, time, solid_fraction(packing), since.n_after(),
                              since.gained.size(), since.lost.size(), in_step.kept.size()));
  previous_ = packing;
}

void ContactTracker::finish_step(const Run<2>& run) {
  record(run, run.packing(), run.point().time + run.point().equilibration_time);
  start_ = previous_;
}

void ContactTracker::write() const {
  std::string text = std::string(kHeader) + "\n";
  for (const std::string& row : rows_) text += row + "\n";
  write_bytes_atomically(file_, text);
}

std::unique_ptr<ContactTracker> track_contacts(Run<2>& run, const RunOptions& options,
                                               const RunDirectory& directory, double interval) {
  const int step = run.point().step;
  Packing<2> start = step > 0 ? directory.start_of(step) : Run<2>(options).packing();
  auto tracker = std::make_unique<ContactTracker>(directory.contact_table(), run, std::move(start));
  run.set_observer({interval, [&run, recorder = tracker.get()](const Packing<2>& packing, double time) {
                      recorder->record(run, packing, time);
                    }});
  return tracker;
}

}  // namespace floc
