#include "readers.h"

#include <hdf5.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "floc/base/error.h"
#include "floc/io/csv_packing.h"
#include "floc/io/export.h"
#include "floc/io/extended_xyz.h"
#include "floc/io/jambashbulk.h"
#include "floc/io/lammps_data.h"
#include "floc/io/lammps_dump.h"
#include "floc/io/law_text.h"
#include "floc/io/state_file.h"
#include "floc/io/vtkhdf.h"
#include "floc/io/vtu.h"
#include "floc/io/yade_text.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/tables/fit_tables.h"
#include "read_packing.h"
#include "support/sealed.h"
#include "support/states.h"

namespace floc::fuzz {
namespace {

const std::filesystem::path kData = std::filesystem::path(FLOC_SOURCE_DIR) / "data";

/// Returns the position of each byte of each dataset in an HDF5 file.
std::vector<std::size_t> dataset_bytes(const std::string& image) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_file_image(access, const_cast<char*>(image.data()), image.size());
  const hid_t file = H5Fopen("/dev/null/memory", H5F_ACC_RDONLY, access);
  std::vector<std::size_t> places;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* object, void* found) -> herr_t {
    if (object->type != H5O_TYPE_DATASET) return 0;
    const hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    // Texts are stored elsewhere in the file: H5Dget_offset does not give their position.
    const haddr_t begin = H5Tget_class(type) == H5T_STRING ? HADDR_UNDEF : H5Dget_offset(dataset);
    H5Tclose(type);
    for (hsize_t k = 0; begin != HADDR_UNDEF && k < H5Dget_storage_size(dataset); ++k)
      static_cast<std::vector<std::size_t>*>(found)->push_back(begin + k);
    H5Dclose(dataset);
    return 0;
  };
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &places);
  H5Fclose(file);
  H5Pclose(access);
  return places;
}

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void read_scene_bytes(const std::string& bytes) {
  try {
    const Scene scene = parse_scene(bytes, "fuzz.toml", "/nonexistent", {});
    derived_groups(scene);
  } catch (const InputError&) {
  }
}

void read_law_bytes(const std::string& bytes) {
  try {
    parse_law("fuzz", bytes);
  } catch (const InputError&) {
  }
}

void read_csv_bytes(const std::string& bytes) {
  read_packing(read_csv_packing, bytes, [](ImportOptions& options) {
    options.cell = {{2.0, 0.0}, {0.3, 2.0}};
  });
}

/// Reads a csv file with contacts between three fixed grains.
void read_contacts_bytes(const std::string& bytes) {
  static const std::string kGrains = "x,y,r\n0,0,0.5\n0.999,0,0.5\n0.4995,0.8651,0.5\n";
  const MemoryFile contacts(bytes);
  read_packing(read_csv_packing, kGrains, [&](ImportOptions& options) {
    options.cell = {{4.0, 0.0}, {0.0, 4.0}};
    options.contacts = contacts.path();
  });
}

/// Reads a table of measurements as `floc fit` does, with the height of the solid grains as the only option.
void read_path_bytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  try {
    read_path(file.path(), {{"solid_height", "10 [mm]"}}, {"P", "P_star"});
  } catch (const InputError&) {
  }
}

void read_dump_bytes(const std::string& bytes) {
  read_packing(read_lammps_dump, bytes);
}
void read_data_bytes(const std::string& bytes) {
  read_packing(read_lammps_data, bytes);
}
void read_yade_bytes(const std::string& bytes) {
  read_packing(read_yade_text, bytes);
}
void read_vtu_bytes(const std::string& bytes) {
  read_packing(read_vtu, bytes);
}
void read_xyz_bytes(const std::string& bytes) {
  read_packing(read_extended_xyz, bytes);
}
void read_jambashbulk_bytes(const std::string& bytes) {
  read_packing(read_jambashbulk, bytes, [](ImportOptions& options) { options.law.reset(); });
}

/// Small states in 2D and 3D, in a format that floc writes.
std::vector<std::string> written_states(const std::string& extension) {
  std::vector<std::string> seeds;
  const std::string path =
      (std::filesystem::temp_directory_path() / ("floc-fuzz-" + std::to_string(::getpid()) + extension))
          .string();
  const auto add = [&]<int Dim>(State<Dim> state) {
    state.packing.cell.velocity.setZero();
    find_export_format("", path).write(path, state);
    seeds.push_back(content_of(path));
    std::filesystem::remove(path);
  };
  add(test::busy_state<2>());
  add(test::busy_state<3>());
  add(test::boxed_state<2>());
  add(test::boxed_state<3>());
  add(test::wet_state<2>());
  add(test::wet_state<3>());
  return seeds;
}

/// Reads a state file without a valid seal. Such a file must be refused before HDF5 reads it.
void read_unsealed_bytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  try {
    read_state(file.path());
  } catch (const InputError&) {
  }
}

/// An HDF5 file to be edited, and the positions of its datasets.
struct Image {
  std::string content;
  std::vector<std::size_t> places;  ///< position of each byte of each dataset
};

std::vector<Image> images_of(const std::vector<std::string>& contents) {
  std::vector<Image> made;
  for (const std::string& content : contents) made.push_back({content, dataset_bytes(content)});
  return made;
}

/// States without their seals.
const std::vector<Image>& state_images() {
  static const std::vector<Image> images = [] {
    std::vector<std::string> contents;
    for (const std::string& bytes : written_states(".h5")) contents.push_back(test::without_seal(bytes));
    return images_of(contents);
  }();
  return images;
}

const std::vector<Image>& vtkhdf_images() {
  static const std::vector<Image> images = images_of(written_states(".vtkhdf"));
  return images;
}

/// Returns a file of `images` with edited numbers. The first byte of `edits` chooses the file. For each edit, two bytes
/// choose the position, and eight bytes give the new content.
std::string edited(const std::vector<Image>& images, const std::string& edits) {
  const Image& image = images[static_cast<unsigned char>(edits[0]) % images.size()];
  std::string content = image.content;
  for (std::size_t at = 1; at + 10 <= edits.size(); at += 10) {
    std::uint16_t where = 0;
    std::memcpy(&where, edits.data() + at, 2);
    for (std::size_t k = 0; k < 8; ++k)
      content[image.places[(where + k) % image.places.size()]] = edits[at + 2 + k];
  }
  return content;
}

void read_edited_state(const std::string& edits) {
  if (!edits.empty()) read_unsealed_bytes(test::sealed(edited(state_images(), edits)));
}
void read_edited_vtkhdf(const std::string& edits) {
  if (!edits.empty()) read_packing(read_vtkhdf, edited(vtkhdf_images(), edits));
}
void read_vtkhdf_bytes(const std::string& bytes) {
  read_packing(read_vtkhdf, bytes);
}

template <class... Path>
std::vector<std::string> shipped(const Path&... path) {
  return {content_of(kData / path)...};
}

std::vector<std::string> scene_seeds() {
  std::vector<std::string> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(kData / "scenes"))
    if (entry.path().extension() == ".toml") seeds.push_back(content_of(entry.path()));
  return seeds;
}

/// Returns edits that write invalid lengths, counts and indices at positions spread over the whole file.
std::vector<std::string> edit_seeds() {
  std::vector<std::string> seeds;
  const double values[] = {0.0, -1.0, 1e300, 1e-300, std::nan(""), std::numeric_limits<double>::infinity()};
  for (std::uint16_t where = 0; where < 2000; where = static_cast<std::uint16_t>(where + 16))
    for (const double value : values) {
      std::string edit(1, static_cast<char>(where / 16));
      edit.append(reinterpret_cast<const char*>(&where), 2).append(reinterpret_cast<const char*>(&value), 8);
      seeds.push_back(edit);
    }
  return seeds;
}

std::vector<std::string> csv_seeds() {
  return {"x,y,r\n0.0,0.0,0.5\n0.999,0.0,0.5\n0.4995,0.8651594,0.5\n1.4985,0.8651594,0.5\n",
          "id;x;y;diameter;mass\n1;1000000000.1234567891;-7;1;2\n# words\n2;\"0.5\";1e-3;.5;1\n",
          "Titel;;\nx;y;Radius\n[mm];[mm];[um]\n0,0;0,0;500\n;;\n0,999;0,0;500\n",
          "# x y radius\n0 0 0.5\n0.999 0 0.5\n"};
}
std::vector<std::string> yade_seeds() {
  std::vector<std::string> seeds = shipped("packings/yade/spheres.txt");
  seeds.emplace_back(
      "# wall x- 0\n# wall x+ 2\n# wall z- 0\n# gravity 0 0 -9.81\n# id x y z r\n1 0.5 0.5 0.5 0.5\n2 1.49 0.5 "
      "0.6 "
      "0.5\n");
  return seeds;
}
std::vector<std::string> path_seeds() {
  return {"branch,P_star,phi\nload,0.1,0.5\nload,0.2,0.52\nunload,0.1,0.51\n",
          "Probe 12, Tiefe 4,5 m\nSpannung;Porenzahl\n[kPa];[%]\n12,5;90,1\n12,5;89,0\n25,0;85\n;\n12,5;86\n",
          "\xef\xbb\xbfsigma'v (kPa)\tH [mm]\r\n1.0\t20\r\n2e1\t19.5\r\n", "p e\r1 0.9\r2 0.8\r",
          "\"Pressure, MPa\",\"Relative density (%)\"\n1,50\n2,\"55\"\n"};
}
std::vector<std::string> contact_seeds() {
  return {
      "id1,id2,image1,image2,normal_force,shear_force1,shear_force2,rolling_moment,kn,kt\n"
      "0,1,0,0,1.5,0,0.1,0.001,1e3,8e2\n1,2,0,0,0.5,0,0,0,1e3,8e2\n",
      "id1\tid2\tforce1\tforce2\n0\t2\t-0.5\t-0.9\n"};
}
std::vector<std::string> law_seeds() {
  return {law_text(law()), law_text(test::wet_state<3>().packing.law), "normal.stiffness=1"};
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = [] {
    std::vector<Reader> made = {
        {"scene", read_scene_bytes, scene_seeds},
        {"law", read_law_bytes, law_seeds},
        {"state", read_edited_state, edit_seeds},
        {"state_bytes", read_unsealed_bytes, [] { return written_states(".h5"); }},
        {"vtkhdf", read_edited_vtkhdf, edit_seeds},
        {"vtkhdf_bytes", read_vtkhdf_bytes, [] { return written_states(".vtkhdf"); }},
        {"csv", read_csv_bytes, csv_seeds},
        {"contacts", read_contacts_bytes, contact_seeds},
        {"path", read_path_bytes, path_seeds},
        {"lammps_dump", read_dump_bytes, [] { return shipped("packings/lammps/disks.dump"); }},
        {"lammps_data", read_data_bytes, [] { return written_states(".data"); }},
        {"yade", read_yade_bytes, yade_seeds},
        {"vtu", read_vtu_bytes, [] { return written_states(".vtu"); }},
        {"extended_xyz", read_xyz_bytes, [] { return written_states(".xyz"); }},
        {"jambashbulk", read_jambashbulk_bytes, [] { return shipped("packings/disks/disks16.txt"); }},
    };
    for (const Reader& reader : shape_readers()) made.push_back(reader);
    for (const Reader& reader : foreign_readers()) made.push_back(reader);
    return made;
  }();
  return all;
}

}  // namespace floc::fuzz
