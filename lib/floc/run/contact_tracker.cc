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

template <int Dim>
ContactTracker<Dim>::ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start)
    : file_(file), start_(std::move(start)), previous_(run.packing()) {
  read_rows(run.point());
}

/// Rows of a run that was killed may lead beyond the point it goes on from.
template <int Dim>
void ContactTracker<Dim>::read_rows(const RunPoint& point) {
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

template <int Dim>
void ContactTracker<Dim>::record(const Run<Dim>& run, const Packing<Dim>& packing, double time) {
  const ContactChanges<Dim> since = contact_changes(previous_, packing);
  const ContactChanges<Dim> in_step = contact_changes(start_, packing);
  rows_.push_back(fmt::format("{},{},{},{},{},{},{},{},{}", run.point().step, run.target().branch,
                              run.target().pressure, time, solid_fraction(packing), since.n_after(),
                              since.gained.size(), since.lost.size(), in_step.kept.size()));
  previous_ = packing;
}

template <int Dim>
void ContactTracker<Dim>::finish_step(const Run<Dim>& run) {
  record(run, run.packing(), run.point().time + run.point().equilibration_time);
  start_ = previous_;
}

template <int Dim>
void ContactTracker<Dim>::write() const {
  std::string text = std::string(kHeader) + "\n";
  for (const std::string& row : rows_) text += row + "\n";
  write_bytes_atomically(file_, text);
}

template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval) {
  const int step = run.point().step;
  Packing<Dim> start = step > 0 ? directory.start_of<Dim>(step) : Run<Dim>(options).packing();
  auto tracker = std::make_unique<ContactTracker<Dim>>(directory.contact_table(), run, std::move(start));
  run.set_observer({interval, [&run, recorder = tracker.get()](const Packing<Dim>& packing, double time) {
                      recorder->record(run, packing, time);
                    }});
  return tracker;
}

#define FLOC_INSTANTIATE(Dim)                                                                \
  template class ContactTracker<Dim>;                                                        \
  template std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>&, const RunOptions&, \
                                                               const RunDirectory&, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
