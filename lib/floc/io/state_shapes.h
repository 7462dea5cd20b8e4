#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/packing.h"

/// Functions that write and read the shapes of grains, which are stored in the group `shapes` of a state file; also the
/// shape and scale of each grain, and the point and type of each contact (docs/states.md).
namespace floc {

/// Writes the table of shapes of a packing, the shape and scale of each grain, and the point and type of each contact.
/// Writes nothing for a packing of round grains.
template <int Dim>
void write_shapes(WritingArchive& archive, const Packing<Dim>& packing);

/// Reads the table of shapes, and the shape and scale of each grain. The numbers are exactly those that were written.
/// @pre the radii of the grains have been read
/// @throws InputError unless every shape is a convex body, its recorded mass properties are accurate to 1e-9, and the
/// radius of each grain is the scale of the grain times the radius of its shape
template <int Dim>
void read_shapes_of_state(const Hdf5Reader& file, ReadingArchive& archive, Grains<Dim>& grains);

/// Reads the point and the type of each contact between grains with shapes, and sets the lever arms of the contact.
/// @pre grains, walls and the indices of the contacts have been read and checked
/// @throws InputError unless the contacts are in ascending order of grains, image and key
template <int Dim>
void read_contact_points(const Hdf5Reader& file, ReadingArchive& archive, Packing<Dim>& packing);

}  // namespace floc
