#pragma once

#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Which way the nearest of many fibers runs, for the anisotropy of edges (Cervenka and Kohout 2020, eq. 5; Havlíček
/// 2024, eq. 4.1).
class NearestFiber {
 public:
  /// No fiber.
  NearestFiber() = default;
  explicit NearestFiber(const Polylines& fibers);  ///< copies what it needs of them

  /// Whether any fiber has a length.
  bool any() const { return nearest_.has_value(); }

  /// Unit direction of the fiber piece whose middle is nearest to p; zero without fibers.
  Vec3 direction(const Vec3& p) const;

 private:
  std::vector<Vec3> directions_;
  std::optional<NearestPoints> nearest_;
};

}  // namespace gracilis
