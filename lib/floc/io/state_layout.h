#pragma once

#include <string>
#include <type_traits>

#include "floc/packing/state.h"

namespace floc {

/// Physical quantity that an array of a state file contains. The quantity determines the attribute `units` of the
/// array.
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
  acceleration,
  ratio,
};

/// One array of a state file: its path in the file, its physical quantity, and a description of its meaning and sign.
struct Field {
  const char* path;
  Quantity quantity;
  const char* meaning;
};

/// Writes or reads the cell of a state file, depending on the archive (WritingArchive or ReadingArchive). This function
/// and the other functions describe_...() define the layout of the file, for both writing and reading. The functions
/// for arrays call four functions of the archive: rows(field, items, get) for an array that contains one member of each
/// item, column(field, values) for an array whose rows are `values`, column_if_there(field, values, size) for an array
/// that is left out of the file if it is empty, and matrix(field, m) for a matrix.
template <class Archive, class Cell>
void describe_cell(Archive& archive, Cell& cell) {
  archive.matrix({"cell/matrix", Quantity::length, "rows are the lattice vectors"}, cell.matrix);
  archive.matrix({"cell/velocity", Quantity::velocity, "time derivative of cell/matrix"}, cell.velocity);
}

template <int Dim, class Archive, class Grains>
void describe_grains(Archive& archive, Grains& g) {
  using enum Quantity;
  archive.column({"grains/position", length, "centre of the grain"}, g.position);
  archive.column_if_there(
      {"grains/position_low", length, "centre minus position, below the precision of position; absent: zero"},
      g.position_low, g.position.size());
  archive.column({"grains/velocity", velocity, "peculiar velocity: without the affine motion of the cell"},
                 g.velocity);
  archive.column({"grains/radius", length, ""}, g.radius);
  archive.column({"grains/mass", mass, ""}, g.mass);
  if constexpr (Dim == 2)
    archive.column({"grains/angle", angle, ""}, g.orientation);
  else
    archive.column({"grains/orientation", ratio, "unit quaternion w, x, y, z"}, g.orientation);
  archive.column({"grains/angular_velocity", spin, ""}, g.angular_velocity);
  archive.column_if_there(
      {"grains/imported_id", count, "identifier of the grain in messages and tables; absent: the index"}, g.id,
      g.radius.size());
}

template <int Dim, class Archive, class Walls>
void describe_walls(Archive& archive, Walls& walls) {
  using enum Quantity;
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, walls, get); };
  rows(
      {"walls/axis", count, "axis of the normal of the wall; 0: the first axis"},
      [](auto& w) -> auto& { return w.axis; });
  rows(
      {"walls/side", count, "1: grains lie below the wall on its axis, -1: above"},
      [](auto& w) -> auto& { return w.side; });
  rows(
      {"walls/position", length, "position of the wall on its axis"},
      [](auto& w) -> auto& { return w.position; });
  rows(
      {"walls/velocity", velocity, "velocity of the wall along its axis"},
      [](auto& w) -> auto& { return w.velocity; });
}

/// Writes or reads the arrays of contacts that state files contain for every contact law. An array of flags, forces or
/// stiffnesses contains zeros if the law does not have the quantity in this array.
template <int Dim, class Archive, class Contacts>
void describe_contacts(Archive& archive, Contacts& contacts) {
  using enum Quantity;
  // The names of arrays, their quantities and their sign conventions are part of the format of state files
  // (docs/states.md).
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, contacts, get); };
  rows(
      {"contacts/id1", count, "first grain"}, [](auto& c) -> auto& { return c.i; });
  rows(
      {"contacts/id2", count, "second grain"}, [](auto& c) -> auto& { return c.j; });
  rows(
      {"contacts/image", count, "branch = position[id2] + image * cell/matrix - position[id1]"},
      [](auto& c) -> auto& { return c.image; });
  rows(
      {"contacts/key", count, "distinguishes several contacts of the same pair and image"},
      [](auto& c) -> auto& { return c.key; });
  rows(
      {"contacts/gap", length, "distance between the surfaces; negative: overlap"},
      [](auto& c) -> auto& { return c.gap; });
  rows(
      {"contacts/normal", direction, "unit vector from id1 to id2"}, [](auto& c) -> auto& { return c.normal; });
  rows(
      {"contacts/normal_force", force, "static normal force on id2 along normal, positive in compression"},
      [](auto& c) -> auto& { return c.normal_force; });
  rows(
      {"contacts/elastic_force", force, "elastic part of normal_force, without adhesion"},
      [](auto& c) -> auto& { return c.elastic_force; });
  rows(
      {"contacts/shear_force", force, "tangential force on id1"},
      [](auto& c) -> auto& { return c.shear_force; });
  rows(
      {"contacts/rolling_moment", moment, "moment of the rolling spring on id1"},
      [](auto& c) -> auto& { return c.rolling_moment; });
  rows(
      {"contacts/kn", stiffness, "normal stiffness"}, [](auto& c) -> auto& { return c.kn; });
  rows(
      {"contacts/kt", stiffness, "tangential stiffness"}, [](auto& c) -> auto& { return c.kt; });
  rows(
      {"contacts/kr", rolling_stiffness, "rolling stiffness"}, [](auto& c) -> auto& { return c.kr; });
  rows(
      {"contacts/sliding", flag, "1: the tangential force is at its limit"},
      [](auto& c) -> auto& { return c.sliding; });
  rows(
      {"contacts/rolling_yield", flag, "1: the rolling moment is at its limit"},
      [](auto& c) -> auto& { return c.rolling_yield; });
  rows(
      {"contacts/distant", flag, "1: the surfaces attract each other across a gap"},
      [](auto& c) -> auto& { return c.distant; });
}

/// Writes or reads the arrays of twisting moments and twisting stiffnesses, which only some state files contain
/// (keeps_twisting()).
template <class Archive, class Contacts>
void describe_twisting(Archive& archive, Contacts& contacts) {
  using enum Quantity;
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, contacts, get); };
  rows(
      {"contacts/twisting_moment", moment, "moment of the twisting spring on id1 about the normal"},
      [](auto& c) -> auto& { return c.twisting_moment; });
  rows(
      {"contacts/ktw", rolling_stiffness,
       "twisting stiffness, against relative rotation of the grains about the normal"},
      [](auto& c) -> auto& { return c.ktw; });
  rows(
      {"contacts/twisting_yield", flag, "1: the twisting moment is at its limit"},
      [](auto& c) -> auto& { return c.twisting_yield; });
}

/// Writes or reads the attributes of a state file that describe the equilibrium, the load path and the provenance, with
/// calls of archive.value(group, name, variable).
template <class Archive, class State>
void describe_attributes(Archive& archive, State& s) {
  archive.value("equilibrium", "worst_force_grain", s.residuals.worst_force_grain);
  archive.value("equilibrium", "worst_moment_grain", s.residuals.worst_moment_grain);
  archive.value("path", "step", s.path.step);
  archive.value("path", "branch", s.path.branch);
  archive.value("path", "time", s.path.time);
  archive.value("path", "n_steps", s.path.n_steps);
  archive.value_if_there("path", "ending", s.path.ending);
  // Only contact dynamics, the method for rigid contacts, makes sweeps. A reader must set the contact law before it
  // calls this function, because the law determines which attributes the file has.
  if (s.packing.law.is_rigid()) {
    archive.value("path", "n_steps_of_state", s.path.counts.n_steps);
    archive.value("path", "n_sweeps", s.path.counts.n_sweeps);
    archive.value("path", "n_unfinished", s.path.counts.n_unfinished);
    archive.value("path", "deepest_overlap", s.path.counts.deepest_overlap);
  }
  // A reader creates `s.motion` before this call if the file has the group `motion`.
  if (s.motion) {
    archive.value("motion", "time_step", s.motion->time_step);
    archive.value_if_there("motion", "longest_step", s.motion->longest_step);
    archive.value("motion", "cell_mass", s.motion->cell_mass);
    archive.value("motion", "restitution", s.motion->restitution);
    archive.value("motion", "slow_impact", s.motion->slow_impact);
    archive.value("motion", "sweep_tolerance", s.motion->sweep_tolerance);
    archive.value("motion", "residual", s.motion->residual);
    archive.value("motion", "inertial_number", s.motion->inertial_number);
  }
  archive.value("provenance", "program", s.provenance.program);
  archive.value("provenance", "commit", s.provenance.commit);
  archive.value("provenance", "compiler", s.provenance.compiler);
  archive.value("provenance", "seed", s.provenance.seed);
  archive.value("provenance", "stream_state", s.provenance.stream_state);
  archive.value("provenance", "parent_sha256", s.provenance.parent_sha256);
  archive.value("provenance", "source", s.provenance.source);
}

}  // namespace floc
