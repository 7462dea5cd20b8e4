#pragma once

#include "floc/rigid/kernels/contact_groups.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Writes the row of a body.
template <int Dim>
void set_row(const BodyMotion<Dim>& bodies, int i, double* row);

/// Sets a contact of a group.
/// @param shared  number of contacts that change the stretch of the cell at the same time. The response W of the contact
/// is replaced by an upper bound: W with the response of the cell multiplied by this number. A sweep then never adds
/// energy, even if the cell is light. For one contact, or without a cell, the bound equals W.
template <int Dim, bool Cell>
void set_contact(RoundGroup<Dim, Cell>& group, int lane, const BodyMotion<Dim>& bodies,
                 const StepContact<Dim>& c, int shared);
template <int Dim, bool Cell>
void set_contact(CoupledGroup<Dim, Cell>& group, int lane, const BodyMotion<Dim>& bodies,
                 const StepContact<Dim>& c, int shared);

/// Returns the impulse of a contact in its frame (StepContact::frame).
template <int Dim, bool Cell>
Vec<Dim> impulse_in_frame(const RoundGroup<Dim, Cell>& group, int lane, const Mat<Dim>& frame);
template <int Dim, bool Cell>
Vec<Dim> impulse_in_frame(const CoupledGroup<Dim, Cell>& group, int lane, const Mat<Dim>& frame);

}  // namespace floc
