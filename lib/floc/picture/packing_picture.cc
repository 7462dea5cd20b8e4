#include "floc/picture/packing_picture.h"

#include <fmt/format.h>

#include "floc/packing/wall_forces.h"

namespace floc {

template <int Dim>
PackingPicture<Dim> grains_of(const Packing<Dim>& packing) {
  const Grains<Dim>& grains = packing.grains;
  PackingPicture<Dim> picture;
  picture.cell = packing.cell;
  picture.position = with_walls_at_cell(packing).grains.position;
  picture.radius = grains.radius;
  if (grains.are_round()) return picture;
  picture.shapes = grains.shapes;
  for (int i = 0; i < grains.size(); ++i) {
    const PlacedShape<Dim> placed = grains.placed(i);
    picture.shape.push_back({placed.shape, placed.scale, placed.rotation});
  }
  return picture;
}

template <int Dim>
ContactLine<Dim> contact_line(const Packing<Dim>& packing, const Contact<Dim>& contact, LineKind kind,
                              double force) {
  const Vec<Dim>& from = packing.grains.position[contact.i];
  ContactLine<Dim> line{from, from + branch(packing, contact), kind, force, contact.i, contact.j};
  if (packing.grains.are_round()) return line;
  const Vec<Dim> point = from + contact.arm_i;
  if (packing.is_wall(contact.j))
    line.to = point;
  else
    line.through = point;
  return line;
}

template PackingPicture<2> grains_of(const Packing<2>&);
template PackingPicture<3> grains_of(const Packing<3>&);
template ContactLine<2> contact_line(const Packing<2>&, const Contact<2>&, LineKind, double);
template ContactLine<3> contact_line(const Packing<3>&, const Contact<3>&, LineKind, double);

std::vector<std::string> Slab::validate() const {
  if (from >= 0.0 && from < to && to <= 1.0) return {};
  return {fmt::format("slab from {} to {}: must be fractions of the cell with 0 <= from < to <= 1", from, to)};
}

PackingPicture<3> part_in_slab(const PackingPicture<3>& picture, const Slab& slab) {
  PackingPicture<3> part = picture;
  part.slab = slab;
  part.position.clear();
  part.radius.clear();
  part.shape.clear();
  part.rattler.clear();
  part.shade.value.clear();
  const auto n = static_cast<int>(picture.position.size());
  constexpr int kOutside = -1;
  std::vector<int> place(n, kOutside);  // index in `part` of each grain of `picture`
  for (int i = 0; i < n; ++i) {
    const double s = picture.cell.reduced(picture.cell.wrapped(picture.position[i]))[slab.axis];
    if (s < slab.from || s >= slab.to) continue;
    place[i] = static_cast<int>(part.position.size());
    part.position.push_back(picture.position[i]);
    part.radius.push_back(picture.radius[i]);
    if (!picture.shape.empty()) part.shape.push_back(picture.shape[i]);
    if (!picture.rattler.empty()) part.rattler.push_back(picture.rattler[i]);
    if (!picture.shade.value.empty()) part.shade.value.push_back(picture.shade.value[i]);
  }
  const auto n_part = static_cast<int>(part.position.size());
  // The indices of walls follow the indices of the grains.
  const auto place_of = [&](int body) { return body < n ? place[body] : body - n + n_part; };
  for (ContactLine<3>& line : part.lines) line.i = place_of(line.i), line.j = place_of(line.j);
  for (DisplacementArrow<3>& arrow : part.arrows) arrow.grain = place_of(arrow.grain);
  std::erase_if(part.lines, [](const auto& line) { return line.i == kOutside || line.j == kOutside; });
  std::erase_if(part.arrows, [](const auto& arrow) { return arrow.grain == kOutside; });
  return part;
}

}  // namespace floc
