#include "floc/relaxation/equilibrator.h"

#include "floc/relaxation/box_relaxer.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "floc/relaxation/relaxer.h"
#include "floc/relaxation/soft_relaxer.h"

namespace floc {

template <int Dim>
std::unique_ptr<Equilibrator<Dim>> make_equilibrator(const RelaxationOptions& options, Packing<Dim> packing,
                                                     const LoadTarget<Dim>& load, const std::string& progress) {
  if (packing.law.is_rigid() || !packing.grains.are_round())
    return std::make_unique<ContactDynamicsRelaxer<Dim>>(options, std::move(packing), load, progress);
  if (!packing.walls.empty())
    return std::make_unique<BoxRelaxer<Dim>>(options, std::move(packing), load, progress);
  if (options.softening > 1.0)
    return std::make_unique<SoftRelaxer<Dim>>(options, std::move(packing), load, progress);
  return std::make_unique<Relaxer<Dim>>(
      options, std::move(packing), load,
      progress.empty() ? RelaxationProgress{} : relaxation_progress(progress));
}

template std::unique_ptr<Equilibrator<2>> make_equilibrator(const RelaxationOptions&, Packing<2>,
                                                            const LoadTarget<2>&, const std::string&);
template std::unique_ptr<Equilibrator<3>> make_equilibrator(const RelaxationOptions&, Packing<3>,
                                                            const LoadTarget<3>&, const std::string&);

}  // namespace floc
