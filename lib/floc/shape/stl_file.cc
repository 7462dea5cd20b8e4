#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "floc/base/error.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/mesh_files.h"
#include "floc/shape/text_lines.h"

namespace floc {
namespace {

/// Number of bytes before the triangles of a binary STL file, and number of bytes per triangle.
constexpr std::size_t kHeader = 84, kTriangle = 50;

/// Collects the triangles of a mesh. Corners with equal coordinates become one vertex.
class Welder {
 public:
  Welder(std::string place, Mesh<3>& mesh) : place_(std::move(place)), mesh_(mesh) {}

  int vertex(const Vec<3>& v) {
    // Adding zero turns -0 into 0, so that -0 and 0 are equal coordinates.
    const auto [at, is_new] =
        numbers_.try_emplace({v[0] + 0.0, v[1] + 0.0, v[2] + 0.0}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      if (mesh_.vertices.size() == kMostHullPoints)
        throw InputError(place_, fmt::format("the file has more than {} vertices, the largest number allowed",
                                             kMostHullPoints));
      mesh_.vertices.push_back(v);
    }
    return at->second;
  }

  /// Adds a triangle. A triangle with fewer than three different corners is left out.
  void add(const std::array<Vec<3>, 3>& corners) {
    const int a = vertex(corners[0]), b = vertex(corners[1]), c = vertex(corners[2]);
    if (a != b && b != c && c != a) mesh_.faces.push_back({a, b, c});
    if (mesh_.faces.size() > 4 * kMostHullPoints)
      throw InputError(place_, fmt::format("the file has more than {} triangles, the largest number allowed",
                                           4 * kMostHullPoints));
  }

 private:
  std::string place_;
  Mesh<3>& mesh_;
  std::map<std::array<double, 3>, int> numbers_;
};

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(k)]);
  return value;
}

Mesh<3> parse_binary(const std::string& place, std::string_view bytes) {
  const std::size_t n = (bytes.size() - kHeader) / kTriangle;
  Mesh<3> mesh;
  Welder welder(place, mesh);
  for (std::size_t t = 0; t < n; ++t) {
    std::array<Vec<3>, 3> corners;
    for (std::size_t k = 0; k < 9; ++k) {
      // The triangle begins with its normal (three numbers), which is skipped.
      const std::uint32_t word = little_endian(bytes, kHeader + t * kTriangle + 12 + 4 * k);
      float number = 0.0F;
      std::memcpy(&number, &word, sizeof number);
      if (!std::isfinite(number))
        throw InputError(place,
                         fmt::format("triangle {}: expected coordinates that are finite numbers", t + 1));
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] = number;
    }
    welder.add(corners);
  }
  return mesh;
}

Mesh<3> parse_text(const std::string& place, std::string_view text) {
  TextLines lines(place, text);
  Mesh<3> mesh;
  Welder welder(place, mesh);
  const auto require = [&](std::string_view first, std::string_view second) {
    const std::string words = fmt::format("{}{}{}", first, second.empty() ? "" : " ", second);
    lines.require_next(words);
    if (lines.word(0) != first || (!second.empty() && (lines.n_words() < 2 || lines.word(1) != second)))
      lines.refuse(fmt::format("\"{}\": expected {}", lines.word(0).substr(0, 40), words));
  };
  require("solid", "");
  if (lines.n_words() > 1) mesh.name = lines.word(1);
  for (;;) {
    lines.require_next("facet or endsolid");
    if (lines.word(0) == "endsolid") break;
    if (lines.word(0) != "facet")
      lines.refuse(fmt::format("\"{}\": expected facet or endsolid", lines.word(0).substr(0, 40)));
    // The normal in the line of the facet is not read. The order of the corners shows the outer side of the triangle,
    // and the normals of the shape are computed from its convex hull.
    require("outer", "loop");
    std::array<Vec<3>, 3> corners;
    for (Vec<3>& corner : corners) {
      require("vertex", "");
      corner = lines.vector<3>(1);
    }
    welder.add(corners);
    require("endloop", "");
    require("endfacet", "");
  }
  if (lines.next())
    lines.refuse("expected the end of the file after endsolid, because a file may have only one solid");
  return mesh;
}

}  // namespace

Mesh<3> parse_stl(const std::string& place, std::string_view bytes) {
  // Binary files, too, may begin with "solid". A file is recognised as binary if its length agrees with the number of
  // triangles in the header.
  const bool has_count = bytes.size() >= kHeader;
  const std::uint64_t n = has_count ? little_endian(bytes, 80) : 0;
  Mesh<3> mesh;
  if (has_count && bytes.size() == kHeader + n * kTriangle) {
    mesh = parse_binary(place, bytes);
  } else if (bytes.substr(0, bytes.find_first_of(" \t\r\n")) == "solid") {
    mesh = parse_text(place, bytes);
  } else {
    throw InputError(
        place,
        has_count
            ? fmt::format(
                  "the file has {} bytes for {} triangles: expected {} bytes, or a text that begins with solid",
                  bytes.size(), n, kHeader + n * kTriangle)
            : fmt::format("the file has {} bytes: expected an STL file, which is a text that begins with "
                          "solid, or a binary file of at least 84 bytes",
                          bytes.size()));
  }
  if (mesh.faces.empty())
    throw InputError(place, "the file has no triangle: expected a surface made of triangles");
  return mesh;
}

}  // namespace floc
