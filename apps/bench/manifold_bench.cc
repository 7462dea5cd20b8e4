// Benchmark of the contacts of convex polyhedra.
//
// The benchmark measures the time per call of contact_manifold(), which receives the features (faces, edges or
// vertices) that touched in the previous step. The grains of a pair are close to each other, with gaps from -1e-3 to
// 1e-3 of the diameter, as in a dense packing. Either the grains have random rotations, or a face of one grain lies
// against a face of the other (face_to_face). One grain of the pair moves a little from step to step. The shapes are
// "cut" (generator 0) with 10 to 20 faces, 14.8 on average, and "hull" (generator 1) with 20 to 44 triangles. Their
// edges are sharp, or rounded with a radius of 3 % of the diameter.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <vector>

#include "floc/base/random.h"
#include "floc/shape/generators.h"
#include "floc/shape/manifold.h"

namespace floc {
namespace {

constexpr int kPairs = 1000;
constexpr double kGap = 1e-3;  ///< largest gap, as a fraction of the diameter

enum Generator { kCut, kHull };

Mat<3> random_rotation(RandomStream& random) {
  Eigen::Quaterniond q;
  for (int k = 0; k < 4; ++k) q.coeffs()[k] = random.normal();
  return q.normalized().toRotationMatrix();
}

Vec<3> random_vector(RandomStream& random) {
  return {random.normal(), random.normal(), random.normal()};
}

struct ClosePair {
  PlacedShape<3> first, second;
  AxisFeatures last;
};

Vec<3> centre_of_face(const PlacedShape<3>& one, int face) {
  Vec<3> sum = Vec<3>::Zero();
  const auto loop = one.shape->loop(face);
  for (const int v : loop) sum += one.shape->vertices[v];
  return one.position + one.rotation * sum / static_cast<double>(loop.size());
}

/// Rotates and moves the second shape of a pair so that a face of each shape lies in one plane, and the centres of the
/// two faces coincide. Returns the normal of the face of the first shape.
Vec<3> lay_face_on_face(ClosePair& pair, RandomStream& random) {
  const Shape<3>&one = *pair.first.shape, &other = *pair.second.shape;
  const int f = static_cast<int>(random.below(static_cast<std::uint64_t>(one.n_faces()))),
            g = static_cast<int>(random.below(static_cast<std::uint64_t>(other.n_faces())));
  const Vec<3> n = pair.first.rotation * one.normals[f], from = pair.second.rotation * other.normals[g];
  pair.second.rotation =
      (Eigen::Quaterniond::FromTwoVectors(from, -n).toRotationMatrix() * pair.second.rotation).eval();
  pair.second.position += centre_of_face(pair.first, f) - centre_of_face(pair.second, g);
  return n;
}

/// Returns a pair of shapes with a random smallest gap between -kGap and kGap. The second shape is moved along a line
/// until the pair has this gap.
ClosePair close_pair(const Shape<3>& one, const Shape<3>& other, bool face_to_face, RandomStream& random) {
  ClosePair pair;
  pair.first = {&one, 1.0, Vec<3>::Zero(), random_rotation(random)};
  pair.second = {&other, 1.0, Vec<3>::Zero(), random_rotation(random)};
  const Vec<3> towards =
      face_to_face ? lay_face_on_face(pair, random) : Vec<3>(random_vector(random).normalized());
  const Vec<3> begin = pair.second.position;
  const double gap = random.uniform(-kGap, kGap);
  double near = face_to_face ? -0.1 : 0.1, far = 1.1;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (near + far);
    pair.second.position = begin + middle * towards;
    const Manifold<3> contact = contact_manifold<3>(pair.first, pair.second, 2.0);
    (contact.n() > 0 && contact.least_gap() < gap ? near : far) = middle;
  }
  return pair;
}

void close_pairs(benchmark::State& state) {
  const auto generator = static_cast<Generator>(state.range(0));
  const double rounding = 0.01 * static_cast<double>(state.range(1));
  const bool face_to_face = state.range(2) == 1;
  const std::vector<Shape<3>> shapes =
      generator == kCut ? cut_shapes<3>({}, 100, rounding, 1) : hull_shapes<3>({}, 100, rounding, 1);
  RandomStream random(1, 1);
  std::vector<ClosePair> pairs;
  for (int k = 0; k < kPairs; ++k)
    pairs.push_back(close_pair(shapes[random.below(100)], shapes[random.below(100)], face_to_face, random));
  // Each pair goes through the same ten displacements again and again.
  std::vector<Vec<3>> moves;
  for (int k = 0; k < 10; ++k) moves.push_back(1e-5 * random_vector(random));
  double n_points = 0.0, n_contacts = 0.0;
  std::size_t step = 0;
  for (auto _ : state) {
    const Vec<3>& move = moves[step++ % moves.size()];
    for (ClosePair& pair : pairs) {
      PlacedShape<3> second = pair.second;
      second.position += move;
      const Manifold<3> contact = contact_manifold<3>(pair.first, second, 2.0 * kGap, &pair.last);
      n_points += contact.n();
      n_contacts += contact.n() > 0 ? 1.0 : 0.0;
    }
  }
  const double n_calls = static_cast<double>(state.iterations()) * kPairs;
  state.counters["seconds_per_pair"] =
      benchmark::Counter(n_calls, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["contacts_per_pair"] = n_contacts / n_calls;
  state.counters["points_per_contact"] = n_points / n_contacts;
}
BENCHMARK(close_pairs)
    ->ArgNames({"generator", "percent_rounding", "face_to_face"})
    ->ArgsProduct({{kCut, kHull}, {0, 3}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
