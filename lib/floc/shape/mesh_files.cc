#include "floc/shape/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/text_lines.h"

namespace floc {
namespace {

constexpr WholeRange kVertexCount{.least = 1, .most = kMostHullPoints};
constexpr NumberRange kRadius{.least = kLeastLength, .most = kLargestLength};
/// Allowed number of faces: at most twice the number of triangles of a closed surface with kMostHullPoints vertices.
constexpr WholeRange kFaceCount{.least = 0, .most = 4 * std::int64_t{kMostHullPoints}};

template <int Dim>
void add_vertex(const TextLines& lines, std::size_t first_word, Mesh<Dim>& mesh) {
  if (mesh.vertices.size() == kMostHullPoints)
    lines.refuse(
        fmt::format("the file has more than {} vertices, the largest number allowed", kMostHullPoints));
  mesh.vertices.push_back(lines.vector<Dim>(first_word));
}

/// Adds a face from a line with the number of corners of the face and the indices of its vertices.
void add_counted_face(const TextLines& lines, Mesh<3>& mesh) {
  const std::int64_t n_vertices = static_cast<std::int64_t>(mesh.vertices.size());
  const int n = lines.whole(0, {.least = 3, .most = n_vertices});
  std::vector<int> face;
  for (int k = 1; k <= n; ++k)
    face.push_back(lines.whole(static_cast<std::size_t>(k), {.least = 0, .most = n_vertices - 1}));
  mesh.faces.push_back(std::move(face));
}

}  // namespace

Mesh<3> parse_off(const std::string& place, std::string_view text) {
  TextLines lines(place, text);
  lines.require_next("OFF");
  std::size_t first = 0;
  if (!parse_number<double>(lines.word(0))) {
    if (lines.word(0) != "OFF")
      lines.refuse(fmt::format("the file begins with \"{}\": expected OFF", lines.word(0).substr(0, 40)));
    first = 1;
  }
  // The numbers of vertices, faces and edges are on the line with the word OFF, or on the next line.
  if (lines.n_words() == first) {
    lines.require_next("the numbers of vertices, faces and edges");
    first = 0;
  }
  const int n_vertices = lines.whole(first, kVertexCount), n_faces = lines.whole(first + 1, kFaceCount);
  Mesh<3> mesh;
  for (int k = 0; k < n_vertices; ++k) {
    lines.require_next(fmt::format("vertex {} of {}", k + 1, n_vertices));
    add_vertex(lines, 0, mesh);
  }
  for (int k = 0; k < n_faces; ++k) {
    lines.require_next(fmt::format("face {} of {}", k + 1, n_faces));
    add_counted_face(lines, mesh);
  }
  if (lines.next())
    lines.refuse(fmt::format("found a line after the last of {} faces: expected the end of the file", n_faces));
  return mesh;
}

Mesh<3> parse_obj(const std::string& place, std::string_view text) {
  static constexpr std::array<std::string_view, 12> kSkipped = {"vn", "vt", "vp", "g",      "o",      "s",
                                                                "l",  "p",  "mg", "usemtl", "mtllib", "end"};
  TextLines lines(place, text);
  Mesh<3> mesh;
  while (lines.next()) {
    const std::string_view key = lines.word(0);
    if (key == "v") {
      add_vertex(lines, 1, mesh);
    } else if (key == "f") {
      if (static_cast<std::int64_t>(mesh.faces.size()) >= kFaceCount.most)
        lines.refuse(
            fmt::format("the file has more than {} faces, the largest number allowed", kFaceCount.most));
      // A face may refer only to vertices in lines above. A negative index counts backwards from the last vertex above,
      // not from the last vertex of the file.
      const auto n = static_cast<std::int64_t>(mesh.vertices.size());
      if (lines.n_words() < 4)
        lines.refuse(
            "the face has fewer than three corners: expected f, followed by the numbers of at least three "
            "vertices");
      std::vector<int>& face = mesh.faces.emplace_back();
      for (std::size_t k = 1; k < lines.n_words(); ++k) {
        // The word of a corner may have the form vertex/texture/normal. Only the index of the vertex is needed.
        const std::string_view index = lines.word(k).substr(0, lines.word(k).find('/'));
        const auto i = parse_number<std::int64_t>(index);
        if (!i || *i == 0 || *i > n || *i < -n)
          lines.refuse(fmt::format(
              "\"{}\": expected the number of a vertex in a line above, from 1 to {}, or from -{} to -1",
              lines.word(k).substr(0, 40), n, n));
        face.push_back(static_cast<int>(*i > 0 ? *i - 1 : n + *i));
      }
    } else if (std::find(kSkipped.begin(), kSkipped.end(), key) == kSkipped.end()) {
      // A line of an unknown kind may describe a part of the surface, for example a curved patch. The shape would be
      // wrong without this part, so the line is not skipped.
      lines.refuse(
          fmt::format("the line begins with \"{}\": expected v (vertex) or f (face)", key.substr(0, 40)));
    }
  }
  if (mesh.vertices.empty())
    throw InputError(place, "the file has no vertex: expected lines that begin with v");
  return mesh;
}

template <int Dim>
Mesh<Dim> parse_points(const std::string& place, std::string_view text) {
  TextLines lines(place, text, ",;");
  constexpr std::array<std::string_view, 3> kColumns = {"x", "y", "z"};
  const std::string expected = Dim == 2 ? "the columns x and y" : "the columns x, y and z";
  lines.require_next(expected);
  bool is_header = lines.n_words() == Dim;
  for (int a = 0; a < Dim && is_header; ++a) {
    std::string_view name = lines.word(static_cast<std::size_t>(a));
    if (name.size() == 3 && name.front() == '"' && name.back() == '"') name = name.substr(1, 1);
    is_header = name == kColumns[static_cast<std::size_t>(a)];
  }
  if (!is_header) lines.refuse("the first line is not a header: expected the names of " + expected);
  Mesh<Dim> mesh;
  while (lines.next()) {
    if (lines.n_words() != Dim)
      lines.refuse(fmt::format("the line has {} words: expected {} numbers", lines.n_words(), Dim));
    add_vertex(lines, 0, mesh);
  }
  if (mesh.vertices.empty())
    throw InputError(place, "the file has no points: expected lines of numbers below the names of the columns");
  return mesh;
}

std::vector<Mesh<3>> parse_rockable(const std::string& place, std::string_view text) {
  TextLines lines(place, text);
  std::vector<Mesh<3>> shapes;
  std::set<std::string> names;
  bool is_open = false;
  while (lines.next()) {
    const std::string_view key = lines.word(0);
    if (key == "<") {
      shapes.emplace_back();
      shapes.back().is_oriented = false;
      is_open = true;
      continue;
    }
    if (!is_open)
      lines.refuse(
          fmt::format("the line begins with \"{}\": expected \"<\", which begins a shape", key.substr(0, 40)));
    Mesh<3>& shape = shapes.back();
    if (key == ">") {
      is_open = false;
    } else if (key == "name") {
      if (lines.n_words() > 1) shape.name = lines.word(1);
      if (!shape.name.empty() && !names.insert(shape.name).second)
        lines.refuse(fmt::format("a shape above has the name {}, too: expected another name", shape.name));
    } else if (key == "radius") {
      shape.rounding = lines.number(1);
      if (!kRadius.holds(shape.rounding))
        lines.refuse(
            fmt::format("the radius of the shape is {:g}: expected {}", shape.rounding, kRadius.words()));
    } else if (key == "volume") {
      shape.volume = lines.number(1);
    } else if (key == "I/m") {
      shape.inertia_over_mass = lines.vector<3>(1);
    } else if (key == "preCompDone") {
      shape.is_principal = lines.n_words() > 1 && lines.word(1) == "y";
    } else if (key == "nv") {
      for (int n = lines.whole(1, kVertexCount), k = 0; k < n; ++k) {
        lines.require_next(fmt::format("vertex {} of {}", k + 1, n));
        add_vertex(lines, 0, shape);
      }
    } else if (key == "ne") {
      // The edges in the file are skipped, because the edges of the shape are those of the convex hull of its vertices.
      for (int n = lines.whole(1, kFaceCount), k = 0; k < n; ++k)
        lines.require_next(fmt::format("edge {} of {}", k + 1, n));
    } else if (key == "nf") {
      for (int n = lines.whole(1, kFaceCount), k = 0; k < n; ++k) {
        lines.require_next(fmt::format("face {} of {}", k + 1, n));
        add_counted_face(lines, shape);
      }
    }
    // Other keys, such as obb.extent, are skipped, because their values follow from the vertices and the radius.
  }
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (shapes[k].vertices.empty() || !(shapes[k].rounding > 0.0))
      throw InputError(place,
                       fmt::format("shape {} \"{}\" has no vertices or no radius: expected a line nv N (number "
                                   "of vertices), followed by N lines with coordinates, and a line radius R",
                                   k + 1, shapes[k].name));
  if (shapes.empty())
    throw InputError(place, "the file has no shape: expected a line with <, which begins a shape");
  return shapes;
}

template Mesh<2> parse_points(const std::string&, std::string_view);
template Mesh<3> parse_points(const std::string&, std::string_view);

}  // namespace floc
