#include <gracilis/geometry/winding_number.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gracilis {

static constexpr Index leaf_size = 8;
/// A node farther than this many radii is answered by its expansion. A dipole alone would ask for 4.5: patches of a
/// convex surface all bend the same way, so that their errors add up.
static constexpr Real far_factor = 2.0;

Real solid_angle_share(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 pa = a - p, pb = b - p, pc = c - p;
  const Real la = pa.norm(), lb = pb.norm(), lc = pc.norm();
  const Real numerator = pa.dot(pb.cross(pc));
  const Real denominator = la * lb * lc + pa.dot(pb) * lc + pb.dot(pc) * la + pc.dot(pa) * lb;
  return std::atan2(numerator, denominator) / (2 * pi);
}

WindingNumber::WindingNumber(const TriangleMesh& mesh)
    : mesh_(mesh), order_(static_cast<std::size_t>(mesh.face_count())) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(order_.size() / 2 + 1);
  if (!order_.empty()) build(0, mesh.face_count());
}

Index WindingNumber::build(Index begin, Index end) {
  const auto index = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.begin = begin, node.end = end;
  node.spread.fill(Eigen::Matrix3d::Zero());
  Eigen::AlignedBox3d box;
  Real area = 0;
  for (Index i = begin; i < end; ++i) {
    const Index triangle = order_[static_cast<std::size_t>(i)];
    const Vec3 vector = area_vector(mesh_.vertices, mesh_.faces.col(triangle)) / 2;
    const Vec3 centroid = (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3;
    node.area_vector += vector;
    node.center += vector.norm() * centroid;
    area += vector.norm();
    box.extend(centroid);
  }
  node.center = area > 0 ? Vec3(node.center / area) : box.center();
  for (Index i = begin; i < end; ++i) {
    const Index triangle = order_[static_cast<std::size_t>(i)];
    Vec3 centroid = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      node.radius = std::max(node.radius, (corner(triangle, k) - node.center).norm());
      centroid += corner(triangle, k) / 3;
    }
    const Vec3 vector = area_vector(mesh_.vertices, mesh_.faces.col(triangle)) / 2;
    const Vec3 offset = centroid - node.center;
    node.moment += offset * vector.transpose();
    Eigen::Matrix3d square = 9 * offset * offset.transpose();
    for (int k = 0; k < 3; ++k) {
      const Vec3 to_corner = corner(triangle, k) - node.center;
      square += to_corner * to_corner.transpose();
    }
    for (int axis = 0; axis < 3; ++axis) node.spread[static_cast<std::size_t>(axis)] += vector[axis] / 12 * square;
  }
  if (end - begin > leaf_size) {
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const Index middle = (begin + end) / 2;
    const auto center_along = [&](Index t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](Index l, Index r) { return center_along(l) < center_along(r); });
    node.left = build(begin, middle);
    node.right = build(middle, end);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

/// The integral of n·g, g = r / |r|³, by the Taylor series of g about the node's center to second order; `u` is the
/// direction to the center.
Real WindingNumber::far_share(const Node& node, const Vec3& u, Real distance) {
  const Real first = u.dot(node.area_vector);
  const Real second = node.moment.trace() - 3 * u.dot(node.moment * u);
  Real third = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d& spread = node.spread[static_cast<std::size_t>(axis)];
    const Vec3 along = spread * u;
    third += 7.5 * u[axis] * u.dot(along) - 3 * along[axis] - 1.5 * u[axis] * spread.trace();
  }
  return (first + (second + third / distance) / distance) / (4 * pi * distance * distance);
}

Real WindingNumber::query(const Vec3& p) const {
  if (nodes_.empty()) return 0;
  Real winding = 0;
  Index stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
    const Vec3 offset = node.center - p;
    const Real distance = offset.norm();
    if (distance > far_factor * node.radius) {
      winding += far_share(node, offset / distance, distance);
    } else if (node.left < 0) {
      for (Index i = node.begin; i < node.end; ++i) {
        const Index triangle = order_[static_cast<std::size_t>(i)];
        winding += solid_angle_share(p, corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
      }
    } else {
      stack[top++] = node.left;
      stack[top++] = node.right;
    }
  }
  return winding;
}

}  // namespace gracilis
