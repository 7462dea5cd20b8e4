#include "floc/picture/packing_picture.h"

namespace floc {

PackingPicture grains_of(const Packing<2>& packing) {
  PackingPicture picture;
  picture.cell = packing.cell;
  picture.position = packing.grains.position;
  picture.radius = packing.grains.radius;
  return picture;
}

}  // namespace floc
