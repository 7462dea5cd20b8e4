#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/io/listed_packing.h"
#include "floc/shape/mesh_files.h"

namespace floc {

/// Whether a shape of Rockable is a sphere, that is, its only vertex is at its centre.
bool is_sphere(const Mesh<3>& shape);

/// Shapes of the bodies in a configuration of Rockable. A shape consists of all points whose distance from a vertex,
/// edge or face of its mesh is at most the member `rounding` of the mesh. A shape is added to the table of shapes of
/// the packing when the first grain with this shape is made.
class RockableShapes {
 public:
  /// Reads the file of shapes.
  explicit RockableShapes(const std::string& path);

  /// Returns the mesh of the shape `name`. @param place  place of a body with this shape, for messages
  /// @throws InputError if the file of shapes does not contain it
  const Mesh<3>& mesh(const FileLine& place, const std::string& name) const;

  /// Returns the index of the shape `name` in the table of shapes of the packing. Adds the shape to the table if it is
  /// new. Contradictions between the data of the shape become remarks and inconsistencies of the packing.
  int index(const FileLine& place, const std::string& name, ListedPacking& listed);

 private:
  std::string path_;
  std::map<std::string, Mesh<3>> meshes_;
  std::map<std::string, int> indices_;
};

}  // namespace floc
