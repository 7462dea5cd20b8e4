#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Lets the walls of each axis move together until both bear the same, with the grains: the last columns of
/// what was solved for, one for each of `network.wall_axes` after the strains, are eliminated.
template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out);

}  // namespace floc
