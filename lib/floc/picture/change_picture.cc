#include "floc/picture/change_picture.h"

namespace floc {
namespace {

template <int Dim>
ContactLine<Dim> line_of(const Packing<Dim>& packing, const Contact<Dim>& c, const Vec<Dim>& to_other,
                         LineKind kind) {
  const Vec<Dim>& from = packing.grains.position[c.i];
  return {from, from + to_other, kind, 0.0, c.i, c.j};
}

}  // namespace

template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes) {
  PackingPicture<Dim> picture = grains_of(before);
  picture.background_name = "contact kept";
  const auto add_before = [&](int c, LineKind kind) {
    const Contact<Dim>& contact = before.contacts[c];
    picture.lines.push_back(line_of(before, contact, branch(before, contact), kind));
  };
  for (const KeptContact& kept : changes.kept) add_before(kept.before, LineKind::background);
  for (const int c : changes.lost) add_before(c, LineKind::lost);
  const Mat<Dim> back = changes.deformation.inverse();
  for (const int c : changes.gained) {
    // A gained contact is drawn along the vector b that connected its two grains before the change. After the change,
    // this vector is the deformed b plus the relative displacement of the grains, which is solved for b here.
    const Contact<Dim>& contact = after.contacts[c];
    const Vec<Dim> apart = changes.displacement[contact.j] - changes.displacement[contact.i];
    picture.lines.push_back(
        line_of(before, contact, Vec<Dim>(back * (branch(after, contact) - apart)), LineKind::gained));
  }
  for (std::size_t i = 0; i < changes.displacement.size(); ++i)
    picture.arrows.push_back({before.grains.position[i], changes.displacement[i], static_cast<int>(i)});
  return picture;
}

template PackingPicture<2> contacts_changed(const Packing<2>&, const Packing<2>&, const ContactChanges<2>&);
template PackingPicture<3> contacts_changed(const Packing<3>&, const Packing<3>&, const ContactChanges<3>&);

}  // namespace floc
