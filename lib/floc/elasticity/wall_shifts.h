#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Relaxes the common displacement of the two walls of each axis, with the grains, until both walls bear the same
/// force. These unknowns are eliminated from the response; they are its last columns, one per entry of
/// `network.wall_axes`, after the strains.
template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out);

}  // namespace floc
