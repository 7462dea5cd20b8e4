#include "floc/relaxation/useful_threads.h"

#include <fmt/format.h>

#include <algorithm>

namespace floc {
namespace {

int grains_per_thread(int dimension) {
  return dimension == 2 ? 1400 : 500;
}

}  // namespace

int useful_threads(int n_grains, int dimension, int asked) {
  return std::clamp(n_grains / grains_per_thread(dimension), 1, asked);
}

std::string unused_threads(int n_grains, int dimension, int asked) {
  const int used = useful_threads(n_grains, dimension, asked);
  if (used == asked) return {};
  const char* grains = dimension == 2 ? "disks" : "spheres";
  return fmt::format(
      "{} {}: {} of {} threads {} used, since more than one thread per {} {} does not make the run faster",
      n_grains, grains, used, asked, used == 1 ? "is" : "are", grains_per_thread(dimension), grains);
}

}  // namespace floc
