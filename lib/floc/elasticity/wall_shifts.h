#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Lets the walls of each axis move together, with the grains, until both bear the same: the last columns of
/// the solution, one for each of `network.wall_axes` after the strains, are eliminated.
template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out);

}  // namespace floc
