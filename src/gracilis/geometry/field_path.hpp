#pragma once

#include <gracilis/geometry/distance_field.hpp>

namespace gracilis {

/// A field with the least distance on its grid's border, so that far points can be answered, too.
struct BoundedField {
  const DistanceField* field = nullptr;  ///< must outlive this
  FieldGrid grid;                        ///< the same, to be asked
  float border = 0;                      ///< m; least value on the border, at least 0
  Eigen::Vector3f low, size;             ///< m; of the grid
};

/// The field must outlive the result.
BoundedField bounded(const DistanceField& field);

/// Distance and gradient within the grid; beyond it a lower bound of the distance (to the grid, plus the border's) and
/// no gradient.
FieldSample sample_bounded(const BoundedField& field, const Eigen::Vector3f& p);

/// The longest step (m) whose end can be judged alone: half of the smallest cell. A point that enters an obstacle by no
/// more than this is still on the side from which it came, whatever is thicker than a cell.
float safe_step(const DistanceField& field);

/// Goes straight from `from` towards `to` as far as the obstacle allows, sliding along the level set `level` where it
/// stands in the way: steps as long as the distance allows (sphere tracing; Hart 1996) and never longer than a safe one
/// near the obstacle, each pushed back out to `level`. Never comes out on another side of what is thicker than a cell.
/// Returns where it ends; gives up where it makes no headway.
Eigen::Vector3f kept_path(const BoundedField& field, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                          float level);

/// In the header, as sample.
[[gnu::always_inline]] inline FieldSample sample_bounded(const BoundedField& bounded, const Eigen::Vector3f& p) {
  FieldSample answer = sample(bounded.grid, p);
  if (answer.distance < std::numeric_limits<float>::infinity()) return answer;
  const Eigen::Vector3f beyond = (bounded.low - p).cwiseMax(p - bounded.low - bounded.size).cwiseMax(0.0f);
  answer.distance = beyond.norm() + bounded.border;
  return answer;
}

}  // namespace gracilis
