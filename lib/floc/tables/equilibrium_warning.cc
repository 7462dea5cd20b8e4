#include "floc/tables/equilibrium_warning.h"

#include "floc/packing/equilibrium_check.h"

namespace floc {

template <int Dim>
void warn_unless_in_equilibrium(const std::string& file, const State<Dim>& state, const Remarks& remarks) {
  if (const std::string faults = equilibrium_faults(state); !faults.empty())
    remarks.warn(file, "this state is not in equilibrium: " + faults, equilibrium_excess(state));
}

template void warn_unless_in_equilibrium(const std::string&, const State<2>&, const Remarks&);
template void warn_unless_in_equilibrium(const std::string&, const State<3>&, const Remarks&);

}  // namespace floc
