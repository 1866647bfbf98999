#pragma once

#include <gracilis/core/types.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// Finds the nearest of many points by a k-d tree over a copy of them.
class NearestPoints {
 public:
  explicit NearestPoints(const Points& points);  ///< copies them
  ~NearestPoints();
  /// One that is moved from may only be assigned to or destroyed.
  NearestPoints(NearestPoints&&) noexcept;
  NearestPoints& operator=(NearestPoints&&) noexcept;  ///< as the constructor

  /// Numbers of the `count` nearest points, nearest first; all where there are fewer.
  std::vector<Index> query(const Vec3& p, std::size_t count) const;
  /// Number of the nearest point. Precondition: there is one.
  Index nearest(const Vec3& p) const { return query(p, 1).front(); }
  /// Numbers of all points nearer than `reach` (m, above 0), ascending.
  std::vector<Index> within(const Vec3& p, Real reach) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gracilis
