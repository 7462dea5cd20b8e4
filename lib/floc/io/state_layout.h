#pragma once

#include <string>
#include <type_traits>

#include "floc/packing/state.h"

namespace floc {

/// Physical quantity of an array of a state file; the `units` attribute of the array follows from it.
enum class Quantity {
  count,
  flag,
  direction,
  length,
  volume,
  velocity,
  mass,
  angle,
  spin,
  force,
  moment,
  stiffness,
  rolling_stiffness,
  stress,
  ratio,
};

/// One array of a state file: its path in the file, its quantity, and its convention in words.
struct Field {
  const char* path;
  Quantity quantity;
  const char* meaning;
};

/// Describe the arrays of a state file, once for writing and reading. `Archive` has rows(field, items, get) for one
/// member of each item, column(field, values) for an array of its own, column_if_there(field, values, size) for an
/// array that is omitted from a file if it is empty, matrix(field, m) and vector(field, v).
template <class Archive, class Cell>
void describe_cell(Archive& archive, Cell& cell) {
  archive.matrix({"cell/matrix", Quantity::length, "rows are the lattice vectors"}, cell.matrix);
  archive.matrix({"cell/velocity", Quantity::velocity, "time derivative of matrix"}, cell.velocity);
}

template <int Dim, class Archive, class Grains>
void describe_grains(Archive& archive, Grains& g) {
  using enum Quantity;
  archive.column({"grains/position", length, "centre"}, g.position);
  archive.column_if_there(
      {"grains/position_low", length, "what the centre lies beside position; absent: nothing"}, g.position_low,
      g.position.size());
  archive.column({"grains/velocity", velocity, "peculiar: without the affine part of the cell's motion"},
                 g.velocity);
  archive.column({"grains/radius", length, ""}, g.radius);
  archive.column({"grains/mass", mass, ""}, g.mass);
  if constexpr (Dim == 2)
    archive.column({"grains/angle", angle, ""}, g.orientation);
  else
    archive.column({"grains/orientation", ratio, "unit quaternion w, x, y, z"}, g.orientation);
  archive.column({"grains/angular_velocity", spin, ""}, g.angular_velocity);
  archive.column_if_there(
      {"grains/imported_id", count, "by which messages and tables name the grain; absent: the index"}, g.id,
      g.radius.size());
}

template <int Dim, class Archive, class Walls>
void describe_walls(Archive& archive, Walls& walls) {
  using enum Quantity;
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, walls, get); };
  rows(
      {"walls/axis", count, "of the normal, 0 the first"}, [](auto& w) -> auto& { return w.axis; });
  rows(
      {"walls/side", count, "1: grains lie below it on the axis, -1: above"},
      [](auto& w) -> auto& { return w.side; });
  rows(
      {"walls/position", length, "on the axis"}, [](auto& w) -> auto& { return w.position; });
  rows(
      {"walls/velocity", velocity, "along the axis"}, [](auto& w) -> auto& { return w.velocity; });
}

/// Describes the arrays that contacts have under every law; flags and springs that a law lacks are zero.
template <int Dim, class Archive, class Contacts>
void describe_contacts(Archive& archive, Contacts& contacts) {
  using enum Quantity;
  // Names, quantities and conventions below are part of the file format (docs/states.md).
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, contacts, get); };
  rows(
      {"contacts/id1", count, "first grain"}, [](auto& c) -> auto& { return c.i; });
  rows(
      {"contacts/id2", count, "second grain"}, [](auto& c) -> auto& { return c.j; });
  rows(
      {"contacts/image", count, "branch = position[id2] + image * cell/matrix - position[id1]"},
      [](auto& c) -> auto& { return c.image; });
  rows(
      {"contacts/key", count, "tells several contacts of one pair and image apart"},
      [](auto& c) -> auto& { return c.key; });
  rows(
      {"contacts/gap", length, "distance of the surfaces, negative: overlap"},
      [](auto& c) -> auto& { return c.gap; });
  rows(
      {"contacts/normal", direction, "unit vector from id1 to id2"}, [](auto& c) -> auto& { return c.normal; });
  rows(
      {"contacts/normal_force", force, "static, positive in compression: on id2 along normal"},
      [](auto& c) -> auto& { return c.normal_force; });
  rows(
      {"contacts/elastic_force", force, "elastic part of normal_force"},
      [](auto& c) -> auto& { return c.elastic_force; });
  rows(
      {"contacts/shear_force", force, "tangential force on id1"},
      [](auto& c) -> auto& { return c.shear_force; });
  rows(
      {"contacts/rolling_moment", moment, "moment of the rolling spring on id1"},
      [](auto& c) -> auto& { return c.rolling_moment; });
  rows(
      {"contacts/kn", stiffness, "along the normal"}, [](auto& c) -> auto& { return c.kn; });
  rows(
      {"contacts/kt", stiffness, "across the normal"}, [](auto& c) -> auto& { return c.kt; });
  rows(
      {"contacts/kr", rolling_stiffness, "against relative rotation"}, [](auto& c) -> auto& { return c.kr; });
  rows(
      {"contacts/sliding", flag, "the tangential spring is at its cap"},
      [](auto& c) -> auto& { return c.sliding; });
  rows(
      {"contacts/rolling_yield", flag, "the rolling spring is at its cap"},
      [](auto& c) -> auto& { return c.rolling_yield; });
  rows(
      {"contacts/distant", flag, "attraction across a gap"}, [](auto& c) -> auto& { return c.distant; });
}

/// Describes the arrays that contacts have in addition under a law with resistance to twisting.
template <class Archive, class Contacts>
void describe_twisting(Archive& archive, Contacts& contacts) {
  using enum Quantity;
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, contacts, get); };
  rows(
      {"contacts/twisting_moment", moment, "moment of the twisting spring on id1 about the normal"},
      [](auto& c) -> auto& { return c.twisting_moment; });
  rows(
      {"contacts/ktw", rolling_stiffness, "against relative rotation about the normal"},
      [](auto& c) -> auto& { return c.ktw; });
  rows(
      {"contacts/twisting_yield", flag, "the twisting spring is at its cap"},
      [](auto& c) -> auto& { return c.twisting_yield; });
}

/// Describes the attributes of a state file by calls archive.value(group, name, variable).
template <class Archive, class State>
void describe_attributes(Archive& archive, State& s) {
  archive.value("equilibrium", "worst_force_grain", s.residuals.worst_force_grain);
  archive.value("equilibrium", "worst_moment_grain", s.residuals.worst_moment_grain);
  archive.value("path", "step", s.path.step);
  archive.value("path", "branch", s.path.branch);
  archive.value("path", "time", s.path.time);
  archive.value("path", "n_steps", s.path.n_steps);
  archive.value_if_there("path", "ending", s.path.ending);
  archive.value("provenance", "program", s.provenance.program);
  archive.value("provenance", "commit", s.provenance.commit);
  archive.value("provenance", "compiler", s.provenance.compiler);
  archive.value("provenance", "seed", s.provenance.seed);
  archive.value("provenance", "stream_state", s.provenance.stream_state);
  archive.value("provenance", "parent_sha256", s.provenance.parent_sha256);
  archive.value("provenance", "source", s.provenance.source);
}

}  // namespace floc
