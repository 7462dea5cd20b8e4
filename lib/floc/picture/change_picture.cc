#include "floc/picture/change_picture.h"

namespace floc {
namespace {

ContactLine line_of(const Packing<2>& packing, const Contact<2>& c, const Vec<2>& to_other, LineKind kind) {
  const Vec<2>& from = packing.grains.position[c.i];
  return {from, from + to_other, kind, 0.0};
}

}  // namespace

PackingPicture contacts_changed(const Packing<2>& before, const Packing<2>& after,
                                const ContactChanges<2>& changes) {
  PackingPicture picture = grains_of(before);
  picture.background_name = "contact kept";
  const auto add_before = [&](int c, LineKind kind) {
    const Contact<2>& contact = before.contacts[c];
    picture.lines.push_back(line_of(before, contact, branch(before, contact), kind));
  };
  for (const KeptContact& kept : changes.kept) add_before(kept.before, LineKind::background);
  for (const int c : changes.lost) add_before(c, LineKind::lost);
  const Mat<2> back = changes.deformation.inverse();
  for (const int c : changes.gained) {
    // A branch after is the deformed one before plus what its grains moved apart.
    const Contact<2>& contact = after.contacts[c];
    const Vec<2> apart = changes.displacement[contact.j] - changes.displacement[contact.i];
    picture.lines.push_back(
        line_of(before, contact, back * (branch(after, contact) - apart), LineKind::gained));
  }
  for (std::size_t i = 0; i < changes.displacement.size(); ++i)
    picture.arrows.push_back({before.grains.position[i], changes.displacement[i]});
  return picture;
}

}  // namespace floc
