#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Relaxes the wall shifts (common displacements of the two walls of each axis) together with the grains, until the
/// forces on the two walls of each axis are equal. The columns of the wall shifts, one per entry of
/// `network.wall_axes`, follow the columns of the strains in the response; this function removes them.
template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out);

}  // namespace floc
