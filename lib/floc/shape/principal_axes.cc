#include "floc/shape/principal_axes.h"

#include <cmath>

namespace floc {

Mat<3> principal_axes(Mat<3> matrix) {
  Mat<3> axes = Mat<3>::Identity();
  const double threshold = 1e-13 * std::abs(matrix.trace());
  for (int sweep = 0; sweep < 50; ++sweep) {
    bool turned = false;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        // In the first sweep, an element causes a rotation only if it exceeds the threshold; later sweeps have a much
        // smaller threshold and reduce off-diagonal elements to rounding errors.
        if (std::abs(matrix(p, q)) <= (sweep == 0 ? threshold : 1e-4 * threshold)) continue;
        turned = true;
        // t is the tangent of the smaller of the two angles of rotation that make this off-diagonal element zero
        // (Rutishauser 1966).
        const double ratio = 0.5 * (matrix(q, q) - matrix(p, p)) / matrix(p, q);
        const double t = (ratio < 0.0 ? -1.0 : 1.0) / (std::abs(ratio) + std::hypot(1.0, ratio));
        const double c = 1.0 / std::hypot(1.0, t), s = t * c;
        Mat<3> turn = Mat<3>::Identity();
        turn(p, p) = turn(q, q) = c;
        turn(p, q) = s, turn(q, p) = -s;
        matrix = (turn.transpose() * matrix * turn).eval();
        axes = (axes * turn).eval();
      }
    if (!turned) break;
  }
  return axes;
}

}  // namespace floc
