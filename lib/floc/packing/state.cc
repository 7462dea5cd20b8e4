#include "floc/packing/state.h"

#include "floc/packing/balance.h"

namespace floc {

template <int Dim>
void measure(State<Dim>& state) {
  state.stress = static_stress(state.packing);
  state.residuals = residuals(state.packing, state.target_stress, state.stress);
}

template void measure(State<2>&);
template void measure(State<3>&);

}  // namespace floc
