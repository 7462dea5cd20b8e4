#include "floc/io/state_archive.h"

namespace floc {

std::string units_of(Quantity quantity, const std::string& system, int dim) {
  const bool si = system == "SI";
  switch (quantity) {
    case Quantity::length:
      return si ? "m" : "length";
    case Quantity::volume:
      return si ? "m^3" : "length^3";
    case Quantity::velocity:
      return si ? "m/s" : "length/time";
    case Quantity::mass:
      return si ? "kg" : "mass";
    case Quantity::angle:
      return "rad";
    case Quantity::spin:
      return si ? "rad/s" : "rad/time";
    case Quantity::force:
      return si ? "N" : "force";
    case Quantity::moment:
      return si ? "N m" : "force*length";
    case Quantity::stiffness:
      return si ? "N/m" : "force/length";
    case Quantity::rolling_stiffness:
      return si ? "N m/rad" : "force*length/rad";
    case Quantity::stress:
      // In two dimensions the stress is a force per length.
      if (dim == 2) return si ? "N/m" : "force/length";
      return si ? "Pa" : "force/length^2";
    case Quantity::acceleration:
      return si ? "m/s^2" : "length/time^2";
    // These quantities are pure numbers.
    case Quantity::count:
    case Quantity::flag:
    case Quantity::direction:
    case Quantity::ratio:
      break;
  }
  return "1";
}

}  // namespace floc
