#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace gracilis {

/// Boxes around the triangles of a surface, and boxes around those: what Embree offers, in a hundred lines, for where
/// there is no Embree. Boxes in single precision about `place`. Precondition: at least one face, all coordinates
/// finite.
class BoxTree {
 public:
  explicit BoxTree(const TriangleMesh& mesh);  ///< copies the triangles

  /// Calls near(face) for triangles whose boxes come within `radius` of p; it answers with the radius from then on.
  template <class Near>
  void near(const Vec3& p, float radius, const Near& near) const {
    const Eigen::Vector3f at = (p - place_).cast<float>();
    Waiting waiting;
    waiting.push(0, nodes_[0].squared_distance(at));
    while (!waiting.empty()) {
      const auto [number, squared] = waiting.pop();
      if (squared > radius * radius) continue;
      const Node& node = nodes_[number];
      for (std::size_t i = node.first; i < node.first + node.count; ++i)
        if (boxes_[i].squared_distance(at) <= radius * radius) radius = std::min(radius, near(order_[i]));
      if (node.count > 0) continue;
      const auto left = number + 1, right = node.first;
      const float to_left = nodes_[left].squared_distance(at), to_right = nodes_[right].squared_distance(at);
      // The nearer one is looked at first, so it goes on top.
      if (to_left < to_right)
        waiting.push(right, to_right), waiting.push(left, to_left);
      else
        waiting.push(left, to_left), waiting.push(right, to_right);
    }
  }

  /// Calls met(face, share) for each triangle that the segment from a to b meets, `share` of it before; it answers with
  /// the share of the segment that still matters.
  template <class Met>
  void along(const Vec3& a, const Vec3& b, const Met& met) const {
    const Eigen::Vector3f from = (a - place_).cast<float>(), way = (b - a).cast<float>();
    float end = 1;
    Waiting waiting;
    waiting.push(0, 0);
    while (!waiting.empty()) {
      const std::size_t number = waiting.pop().first;
      const Node& node = nodes_[number];
      if (!node.meets(from, way, end)) continue;
      for (std::size_t i = node.first; i < node.first + node.count; ++i)
        if (const float share = where_met(order_[i], from, way); share <= end)
          end = std::min(end, met(order_[i], share));
      if (node.count == 0) waiting.push(node.first, 0), waiting.push(number + 1, 0);
    }
  }

  const Vec3& place() const { return place_; }  ///< m, about which coordinates are single

 private:
  struct Box {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;

    void add(const Box& other) { low = low.cwiseMin(other.low), high = high.cwiseMax(other.high); }
    float squared_distance(const Eigen::Vector3f& p) const {
      return (low - p).cwiseMax(p - high).cwiseMax(0.f).squaredNorm();
    }
    bool meets(const Eigen::Vector3f& from, const Eigen::Vector3f& way, float end) const;
  };
  /// Inner nodes have no triangles; their left child follows them, `first` is the right one.
  struct Node : Box {
    std::size_t first = 0, count = 0;
  };
  /// Nodes to look at. A tree of halves is never deeper than an Index has bits, and two nodes wait at each depth.
  struct Waiting {
    void push(std::size_t node, float squared) { entries[count++] = {node, squared}; }
    std::pair<std::size_t, float> pop() { return entries[--count]; }
    bool empty() const { return count == 0; }

    std::array<std::pair<std::size_t, float>, 64> entries;
    std::size_t count = 0;
  };

  void split(std::size_t begin, std::size_t end, const std::vector<Box>& of_faces);
  float where_met(Index face, const Eigen::Vector3f& from, const Eigen::Vector3f& way) const;

  Vec3 place_;
  Eigen::Matrix3Xf vertices_;
  Eigen::Matrix3Xi faces_;
  std::vector<Index> order_;  ///< faces, those of a node side by side
  std::vector<Box> boxes_;    ///< in this order
  std::vector<Node> nodes_;
};

}  // namespace gracilis
