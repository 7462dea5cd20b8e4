#include "floc/picture/change_picture.h"

namespace floc {
template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes) {
  PackingPicture<Dim> picture = grains_of(before);
  picture.background_name = "contact kept";
  const auto add_before = [&](int c, LineKind kind) {
    picture.lines.push_back(contact_line(before, before.contacts[c], kind, 0.0));
  };
  for (const KeptContact& kept : changes.kept) add_before(kept.before, LineKind::background);
  for (const int c : changes.lost) add_before(c, LineKind::lost);
  const Mat<Dim> back = changes.deformation.inverse();
  for (const int c : changes.gained) {
    // A gained contact is drawn along the vector b that connects the two grain centres before the change. The branch
    // vector after the change is the deformed b plus the relative displacement of the two grains; b follows from this
    // equation. The line is straight even between grains with corners: before the change, they do not touch, so there
    // is no contact point at which the line could bend.
    const Contact<Dim>& contact = after.contacts[c];
    const Vec<Dim> apart = changes.displacement[contact.j] - changes.displacement[contact.i];
    const Vec<Dim>& from = before.grains.position[contact.i];
    picture.lines.push_back(
        {from, from + back * (branch(after, contact) - apart), LineKind::gained, 0.0, contact.i, contact.j});
  }
  for (std::size_t i = 0; i < changes.displacement.size(); ++i)
    picture.arrows.push_back({before.grains.position[i], changes.displacement[i], static_cast<int>(i)});
  return picture;
}

template PackingPicture<2> contacts_changed(const Packing<2>&, const Packing<2>&, const ContactChanges<2>&);
template PackingPicture<3> contacts_changed(const Packing<3>&, const Packing<3>&, const ContactChanges<3>&);

}  // namespace floc
