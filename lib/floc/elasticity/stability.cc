#include "floc/elasticity/stability.h"

#include "floc/elasticity/moduli.h"

namespace floc {

template <int Dim>
int count_negative_eigenvalues(const Packing<Dim>& packing, bool prestress) {
  ModuliOptions options;
  options.prestress = prestress;
  return elastic_moduli(packing, options).n_negative;
}

template int count_negative_eigenvalues(const Packing<2>&, bool);
template int count_negative_eigenvalues(const Packing<3>&, bool);

}  // namespace floc
