#include "floc/run_directory/contact_tracker.h"

#include <fmt/format.h>

#include "floc/base/range.h"
#include "floc/structure/contact_changes.h"

namespace floc {
namespace {

constexpr const char* kContactHeader = "step,branch,P,time,phi,n_contacts,gained,lost,kept";

}  // namespace

template <int Dim>
ContactTracker<Dim>::ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start)
    : MotionTable<Dim>(file, kContactHeader, run.point()), start_(std::move(start)), previous_(run.packing()) {}

template <int Dim>
void ContactTracker<Dim>::record(const Run<Dim>& run, const Packing<Dim>& packing, double time) {
  const ContactChanges<Dim> since = contact_changes(previous_, packing);
  const ContactChanges<Dim> in_step = contact_changes(start_, packing);
  this->add_row(fmt::format("{},{},{},{},{},{},{}", this->place_of(run), time, solid_fraction(packing),
                            since.n_after(), since.gained.size(), since.lost.size(), in_step.kept.size()));
  previous_ = packing;
}

template <int Dim>
void ContactTracker<Dim>::finish_step(const Run<Dim>& run) {
  record(run, run.packing(), run.point().time + run.point().equilibration_time);
  start_ = previous_;
}

template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval) {
  require_in_range("track_contacts", interval, kPositiveNumber);
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
