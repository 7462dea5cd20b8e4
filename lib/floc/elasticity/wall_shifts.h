#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Relaxes the wall shifts (common displacements of the two walls of each axis) together with the grains, until the
/// forces on the two walls of each axis are equal. This function removes the columns of the wall shifts from the
/// response. These columns follow the columns of the strains, one per entry of `network.wall_axes`.
template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out);

}  // namespace floc
