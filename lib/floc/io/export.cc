#include "floc/io/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/io/extended_xyz.h"
#include "floc/io/lammps_data.h"
#include "floc/io/mesh_text.h"
#include "floc/io/rockable_text.h"
#include "floc/io/vtkhdf.h"
#include "floc/io/vtu.h"
#include "floc/packing/bonds.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

void write_own_state(const std::string& path, const AnyState& any) {
  std::visit([&](const auto& state) { write_state(path, state); }, any);
}

/// Writes a state to the file `path` as text.
/// @tparam text  function that converts a state to the text of the file
/// @tparam has_shapes whether the format can describe grains with corners
template <std::string (*text)(const AnyState&), bool has_shapes = false>
void write_text(const std::string& path, const AnyState& state) {
  if (!has_shapes)
    std::visit([&](const auto& s) { require_round(s.packing, "files of this format are written", path); },
               state);
  write_bytes_atomically(path, text(state));
}

/// Adds the masses of the walls that forces move, if there are any, to the names of data that a format cannot hold.
template <int Dim>
void add_masses_of_walls(const Packing<Dim>& packing, std::vector<std::string>& lost) {
  const auto moves = [](const Wall<Dim>& wall) { return !wall.open && follows_forces(wall); };
  if (std::any_of(packing.walls.begin(), packing.walls.end(), moves))
    lost.emplace_back("the masses of the walls that forces move");
}

/// Returns the names of the data of a state that a format with grains, walls and boundary alone cannot hold.
std::vector<std::string> lost_beside_grains(const AnyState& any) {
  return std::visit(
      [](const auto& state) {
        const auto& packing = state.packing;
        std::vector<std::string> lost;
        if (!packing.gravity.isZero(0.0)) lost.emplace_back("gravity");
        const auto is_shifted = [](const auto& wall) { return wall.side < 0 && wall.position != 0.0; };
        if (std::any_of(packing.walls.begin(), packing.walls.end(), is_shifted))
          lost.emplace_back("the place of the box, which begins at zero in the file");
        add_masses_of_walls(packing, lost);
        if (has_bonds(packing)) lost.emplace_back("bonds");
        return lost;
      },
      any);
}

/// Returns the names of the data of a state that a configuration of Rockable cannot hold.
std::vector<std::string> lost_in_rockable(const AnyState& any) {
  return std::visit(
      [](const auto& state) {
        std::vector<std::string> lost;
        add_masses_of_walls(state.packing, lost);
        if (holds_liquid(state.packing)) lost.emplace_back("the volumes of the liquid bridges");
        return lost;
      },
      any);
}

/// Returns the names of the data of a state that a file .vtkhdf cannot hold.
std::vector<std::string> lost_in_vtkhdf(const AnyState& any) {
  return std::visit(
      [](const auto& state) {
        const auto moves = [](const auto& velocity) { return !velocity.isZero(0.0); };
        const auto& grains = state.packing.grains;
        std::vector<std::string> lost;
        if (state.motion || std::ranges::any_of(grains.velocity, moves) ||
            std::ranges::any_of(grains.angular_velocity, moves))
          lost.emplace_back("velocities, with which a packing in motion goes on");
        return lost;
      },
      any);
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"state", "state file of floc", ".h5", write_own_state},
      {"vtu", "VTK's unstructured grid: grains and contacts, for ParaView", ".vtu", write_text<vtu_text, true>,
       "", lost_beside_grains},
      {"vtkhdf", "VTK's HDF format: grains and contacts, for ParaView", ".vtkhdf", write_vtkhdf, "",
       lost_in_vtkhdf},
      {"extended-xyz", "extended XYZ, for OVITO and ASE", ".xyz", write_text<extended_xyz_text>, "",
       lost_beside_grains},
      {"lammps-data", "data file of LAMMPS, atom_style sphere", ".data", write_text<lammps_data_text>, "",
       lost_beside_grains},
      {"rockable",
       "configuration of Rockable, with the shapes in a second file of the same name and the extension .shp",
       ".conf", write_rockable, ".shp", lost_in_rockable},
      {"obj", "Wavefront OBJ: surfaces of the grains", ".obj", write_obj},
      {"stl", "stereolithography, as text: surfaces of the grains", ".stl", write_stl},
  };
  return formats;
}

const ExportFormat& find_export_format(const std::string& keyword, const std::string& path) {
  std::string known;
  for (const ExportFormat& format : export_formats()) {
    const bool found = keyword.empty() ? std::filesystem::path(path).extension() == format.extension
                                       : format.keyword == keyword;
    if (found) return format;
    known += fmt::format("{}{} ({}: {})", known.empty() ? "" : ", ", format.extension, format.keyword,
                         format.description);
  }
  if (keyword.empty())
    throw InputError(path, fmt::format("the extension of this file name does not determine a format: expected "
                                       "a name that ends in one of {}, or the option --to",
                                       known));
  throw InputError("--to", fmt::format("\"{}\" is not a format; the formats are {}", keyword, known));
}

}  // namespace floc
