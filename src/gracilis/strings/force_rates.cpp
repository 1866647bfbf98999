#include <gracilis/strings/force_rates.hpp>

#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/strings/node_forces.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <algorithm>

namespace gracilis::strings {

namespace {

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// A bone near a point: how much nearer than wanted, which way leads out, and how both change with the point.
struct BoneContact {
  Real depth = 0;               ///< m, negative
  Real slope = 0;               ///< of the distance along the normal
  Vec3 normal;                  ///< unit, world
  Eigen::Matrix3d normal_rate;  ///< by the point, 1/m
};

/// The spline and the trilinear interpolant, which is asked first, differ by far less than this, m.
constexpr Real margin = 0.002;

Real trilinear_distance(const BoundedField& field, const RigidTransform& body, const Vec3& place) {
  return static_cast<Real>(sample_bounded(field, (body.inverse() * place).cast<float>()).distance);
}

bool touches(const BoundedField& field, const RigidTransform& body, const Vec3& place, Real kept,
             BoneContact& contact) {
  const Vec3 local = body.inverse() * place;
  if (static_cast<Real>(sample_bounded(field, local.cast<float>()).distance) > kept + margin) return false;
  const CurvedSample seen = sample_spline_curved(field.grid, local);
  contact.slope = seen.gradient.norm();
  contact.depth = seen.distance - kept;
  if (contact.depth >= 0 || contact.slope < least_slope) return false;
  const Eigen::Matrix3d& turn = body.linear();
  contact.normal = turn * seen.gradient / contact.slope;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - contact.normal * contact.normal.transpose();
  contact.normal_rate = across * turn * seen.curvature * turn.transpose() / contact.slope;
  return true;
}

}  // namespace

/// A free node while its forces are differentiated.
struct ForceRates::Node {
  Index string, i, p;
  Real tension, length;   ///< 1/m; m, of string that it stands for
  Vec3 place, direction;  ///< of the string, unit
  Real reach;             ///< m, between its neighbors
  Vec3 across(const Vec3& v) const { return v - direction * direction.dot(v); }
  Eigen::Matrix3d projection() const { return Eigen::Matrix3d::Identity() - direction * direction.transpose(); }
  /// How a constant vector's part across the string changes, negative, with the difference of the node's neighbors.
  Eigen::Matrix3d across_rate(const Vec3& v) const {
    return (direction.dot(v) * projection() + direction * across(v).transpose()) / reach;
  }
};

ForceRates::ForceRates(const MuscleStrings& muscle, const BoneDistances& bones, const Points& places,
                       const std::vector<RigidTransform>& bodies)
    : muscle_(muscle),
      places_(places),
      poses_(bodies),
      bodies_(static_cast<Index>(bodies.size())),
      sections_(muscle, places),
      neighbor_arms_(Points::Zero(3, places.cols())) {
  const auto count = static_cast<std::size_t>(places.cols());
  here_.assign(count, Eigen::Matrix3d::Zero());
  before_ = after_ = neighbor_pull_ = here_;
  by_body_.assign(count * bodies.size(), BodyRate::Zero());
  const Real segments = static_cast<Real>(muscle.nodes - 1);
  find_bones_around(bones);
  Index searched = -1;
  for_each_free_node([&](Index s, Index i, Index p) {
    if (s != searched) find_near_bones(s, bones), searched = s;
    const Real length = muscle.lengths[static_cast<std::size_t>(s)];
    const Node node{s,
                    i,
                    p,
                    segments / length,
                    length / segments,
                    places.col(p),
                    string_direction(muscle, places, s, i),
                    (places.col(p + 1) - places.col(p - 1)).norm()};
    const auto row = static_cast<std::size_t>(p);
    here_[row].diagonal().array() += 2 * node.tension;
    before_[row].diagonal().array() -= node.tension, after_[row].diagonal().array() -= node.tension;
    tie(node);
    support_by_plane(node, support_by_bones(node, bones));
    hold_among_neighbors(node);
    keep_from_bones(node, bones);
  });
}

void ForceRates::turn_with_string(const Node& node, const Eigen::Matrix3d& by_difference) {
  before_[static_cast<std::size_t>(node.p)] -= by_difference;
  after_[static_cast<std::size_t>(node.p)] += by_difference;
}

/// The force is pulled by `pull` times how the node moves against a place of the body.
void ForceRates::go_with_body(const Node& node, Index body, const Eigen::Matrix3d& pull, const Vec3& place) {
  BodyRate& rate = body_rate(node.p, body);
  rate.leftCols<3>() -= pull;
  rate.rightCols<3>() += pull * cross_matrix(place);
}

void ForceRates::turn_with_body(const Node& node, Index body, const Eigen::Matrix3d& by_turn) {
  body_rate(node.p, body).rightCols<3>() += by_turn;
}

void ForceRates::tie(const Node& node) {
  const Real reach = muscle_.settings.tie_length;
  const Real k = muscle_.ties[node.p] * node.length / (reach * reach);
  if (!(k > 0)) return;
  const Eigen::Matrix3d pull = k * node.projection();
  Vec3 tied_to = Vec3::Zero();
  for (Index b = 0; b < bodies_; ++b) {
    const Real share = muscle_.shares(b, node.p);
    if (!(share > 0)) continue;
    const Vec3 place = poses_[static_cast<std::size_t>(b)] * Vec3(muscle_.taut.col(node.p));
    tied_to += share * place;
    go_with_body(node, b, share * pull, place);
  }
  here_[static_cast<std::size_t>(node.p)] += pull;
  turn_with_string(node, -k * node.across_rate(node.place - tied_to));
}

/// Returns what share of the support is left for the plane.
Real ForceRates::support_by_bones(const Node& node, const BoneDistances& bones) {
  const Real reach = muscle_.settings.support_length;
  const Real k = node.length / (reach * reach);
  Real plane_share = 1;
  for (const Slide& slide : muscle_.supports[static_cast<std::size_t>(node.p)].slides) {
    plane_share -= slide.share;
    const auto bone = static_cast<std::size_t>(slide.bone);
    const Index body = bones.bodies[bone];
    BoneContact contact;
    if (!touches(bones.fields[bone], poses_[static_cast<std::size_t>(body)], node.place, slide.distance, contact))
      continue;
    const Real stiffness = slide.share * k;
    const Eigen::Matrix3d across = node.projection();
    const Eigen::Matrix3d pull = stiffness * (contact.slope * node.across(contact.normal) * contact.normal.transpose() +
                                              contact.depth * across * contact.normal_rate);
    here_[static_cast<std::size_t>(node.p)] += pull;
    go_with_body(node, body, pull, node.place);
    turn_with_body(node, body, -stiffness * contact.depth * across * cross_matrix(contact.normal));
    turn_with_string(node, -stiffness * contact.depth * node.across_rate(contact.normal));
  }
  return plane_share;
}

void ForceRates::support_by_plane(const Node& node, Real share) {
  const Vec3& rest_normal = muscle_.supports[static_cast<std::size_t>(node.p)].normal;
  if (rest_normal.isZero(0) || share <= least_plane_share) return;
  Vec3 plane = Vec3::Zero(), blend = Vec3::Zero();
  for (Index b = 0; b < bodies_; ++b) {
    const RigidTransform& body = poses_[static_cast<std::size_t>(b)];
    if (!(muscle_.shares(b, node.p) > 0)) continue;
    plane += muscle_.shares(b, node.p) * (body * Vec3(muscle_.fibers.col(node.p)));
    blend += muscle_.shares(b, node.p) * (body.linear() * rest_normal);
  }
  const Vec3 unit = blend.normalized(), normal = node.across(unit), offset = node.place - plane;
  const Real depth = normal.dot(offset);
  if (depth >= 0) return;
  const Real reach = muscle_.settings.support_length;
  const Real k = share * node.length / (reach * reach);
  const Eigen::Matrix3d pull = k * normal * normal.transpose();
  const Eigen::Matrix3d by_normal = k * (normal * offset.transpose() + depth * Eigen::Matrix3d::Identity());
  here_[static_cast<std::size_t>(node.p)] += pull;
  turn_with_string(node, -by_normal * node.across_rate(unit));
  const Eigen::Matrix3d unit_rate = rate_of_unit(blend);
  for (Index b = 0; b < bodies_; ++b) {
    const Real of_body = muscle_.shares(b, node.p);
    if (!(of_body > 0)) continue;
    const RigidTransform& body = poses_[static_cast<std::size_t>(b)];
    go_with_body(node, b, of_body * pull, body * Vec3(muscle_.fibers.col(node.p)));
    const Vec3 turned = body.linear() * rest_normal;
    turn_with_body(node, b, -of_body * by_normal * node.projection() * unit_rate * cross_matrix(turned));
  }
}

void ForceRates::hold_among_neighbors(const Node& node) {
  const std::vector<Index>& neighbors = muscle_.neighbors[static_cast<std::size_t>(node.string)];
  if (neighbors.empty()) return;
  const Real reach = muscle_.settings.neighbor_length;
  const Real k = node.length / (reach * reach), count = static_cast<Real>(neighbors.size());
  Vec3 there = Vec3::Zero(), at_rest = Vec3::Zero();
  for (const Index neighbor : neighbors) {
    const Index q = muscle_.node(neighbor, node.i);
    there += places_.col(q) / count, at_rest += muscle_.taut.col(q) / count;
  }
  const auto row = static_cast<std::size_t>(node.p);
  neighbor_arms_.col(node.p) = sections_.turn(node.i) * (muscle_.taut.col(node.p) - at_rest);
  neighbor_pull_[row] = k * node.projection();
  here_[row] += neighbor_pull_[row];
  turn_with_string(node, -k * node.across_rate(node.place - there - neighbor_arms_.col(node.p)));
}

/// Those that the ball around all nodes comes near.
void ForceRates::find_bones_around(const BoneDistances& bones) {
  const Vec3 center = places_.rowwise().mean();
  const Real radius = (places_.colwise() - center).colwise().norm().maxCoeff();
  for (std::size_t bone = 0; bone < bones.fields.size(); ++bone) {
    const RigidTransform& body = poses_[static_cast<std::size_t>(bones.bodies[bone])];
    if (trilinear_distance(bones.fields[bone], body, center) <= radius + muscle_.settings.bone_gap + margin)
      bones_around_.push_back(bone);
  }
}

/// No bone is nearer to a node, or to the middles beside it, than a few nodes of its string tell.
void ForceRates::find_near_bones(Index string, const BoneDistances& bones) {
  constexpr Index stride = 4;
  near_bones_.clear();
  for (const std::size_t bone : bones_around_) {
    const RigidTransform& body = poses_[static_cast<std::size_t>(bones.bodies[bone])];
    bool is_near = false;
    for (Index i = 0; i < muscle_.nodes && !is_near; i += stride) {
      const Vec3 place = places_.col(muscle_.node(string, i));
      Real reach = 0;
      for (Index j = std::max<Index>(i - stride, 0); j <= std::min(i + stride, muscle_.nodes - 1); ++j)
        reach = std::max(reach, (places_.col(muscle_.node(string, j)) - place).norm());
      is_near = trilinear_distance(bones.fields[bone], body, place) <= reach + muscle_.settings.bone_gap + margin;
    }
    if (is_near) near_bones_.push_back(bone);
  }
}

void ForceRates::press_out(Index p, Index body, const Pressure& pressure, Real share) {
  const Eigen::Matrix3d pull = share * pressure.pull;
  BodyRate& rate = body_rate(p, body);
  rate.leftCols<3>() -= pull;
  rate.rightCols<3>() += share * pressure.by_turn;
}

/// The middle of a segment is shared by its two nodes, each of which has half of its stiffness.
void ForceRates::press_middle(Index p, Index body, const Pressure& pressure, bool is_first) {
  constexpr Real half = 0.5;
  const auto row = static_cast<std::size_t>(p);
  const Eigen::Matrix3d by_node = half * half * pressure.pull;
  here_[row] += by_node, (is_first ? after_ : before_)[row] += by_node;
  press_out(p, body, pressure, half);
}

void ForceRates::keep_from_bones(const Node& node, const BoneDistances& bones) {
  const Real k = muscle_.settings.bone_stiffness * node.tension;
  for (const std::size_t bone : near_bones_) {
    const Index body = bones.bodies[bone];
    const RigidTransform& pose = poses_[static_cast<std::size_t>(body)];
    const Real distance = trilinear_distance(bones.fields[bone], pose, node.place);
    const auto pressure = [&](const Vec3& place, Real kept, Pressure& result) {
      BoneContact contact;
      if (!touches(bones.fields[bone], pose, place, kept, contact)) return false;
      result.pull =
          k * (contact.slope * contact.normal * contact.normal.transpose() + contact.depth * contact.normal_rate);
      result.by_turn = result.pull * cross_matrix(place) - k * contact.depth * cross_matrix(contact.normal);
      return true;
    };
    Pressure found;
    if (const Real kept = kept_at_node(muscle_, bone, node.p);
        distance <= kept + margin && pressure(node.place, kept, found)) {
      here_[static_cast<std::size_t>(node.p)] += found.pull;
      press_out(node.p, body, found, 1);
    }
    const auto middle = [&](Index other) {
      const Real half = (places_.col(other) - node.place).norm() / 2;
      if (distance - half > muscle_.settings.bone_gap + margin) return false;
      const Vec3 place = (node.place + places_.col(other)) / 2;
      return pressure(place, kept_at_middle(muscle_, bone, node.p, other), found);
    };
    if (node.i + 2 < muscle_.nodes && middle(node.p + 1)) {
      press_middle(node.p, body, found, true);
      if (body_holding(muscle_, node.string, node.i + 1) < 0) press_middle(node.p + 1, body, found, false);
    }
    // Otherwise the node before has seen to it.
    if (node.i > 1 && body_holding(muscle_, node.string, node.i - 1) >= 0 && middle(node.p - 1))
      press_middle(node.p, body, found, false);
  }
}

Points ForceRates::by_places(const Points& rates) const {
  Points forces = Points::Zero(3, rates.cols());
  const Points turning = sections_.turning(rates);
  for_each_free_node([&](Index s, Index i, Index p) {
    const std::vector<Index>& neighbors = muscle_.neighbors[static_cast<std::size_t>(s)];
    const auto row = static_cast<std::size_t>(p);
    forces.col(p) = before_[row] * rates.col(p - 1) + here_[row] * rates.col(p) + after_[row] * rates.col(p + 1);
    if (neighbors.empty()) return;
    Vec3 there = Vec3(turning.col(i)).cross(Vec3(neighbor_arms_.col(p)));
    for (const Index neighbor : neighbors)
      there += rates.col(muscle_.node(neighbor, i)) / static_cast<Real>(neighbors.size());
    forces.col(p) -= neighbor_pull_[row] * there;
  });
  return forces;
}

Points ForceRates::by_places_transposed(const Points& weights) const {
  Points rates = Points::Zero(3, weights.cols()), turning = Points::Zero(3, muscle_.nodes);
  for_each_free_node([&](Index s, Index i, Index p) {
    const std::vector<Index>& neighbors = muscle_.neighbors[static_cast<std::size_t>(s)];
    const auto row = static_cast<std::size_t>(p);
    const Vec3 weight = weights.col(p);
    rates.col(p - 1) += before_[row].transpose() * weight;
    rates.col(p) += here_[row].transpose() * weight;
    rates.col(p + 1) += after_[row].transpose() * weight;
    if (neighbors.empty()) return;
    const Vec3 there = -(neighbor_pull_[row].transpose() * weight);
    turning.col(i) += Vec3(neighbor_arms_.col(p)).cross(there);
    for (const Index neighbor : neighbors)
      rates.col(muscle_.node(neighbor, i)) += there / static_cast<Real>(neighbors.size());
  });
  sections_.add_transposed(turning, rates);
  return rates;
}

Points ForceRates::by_bodies(const std::vector<Twist>& twists) const {
  Points forces = Points::Zero(3, places_.cols());
  for (Index p = 0; p < places_.cols(); ++p)
    for (Index b = 0; b < bodies_; ++b) {
      const Twist& twist = twists[static_cast<std::size_t>(b)];
      const BodyRate& rate = by_body_[static_cast<std::size_t>(p * bodies_ + b)];
      forces.col(p) += rate.leftCols<3>() * twist.velocity + rate.rightCols<3>() * twist.turning;
    }
  return forces;
}

Eigen::MatrixXd ForceRates::by_bodies_transposed(const Points& weights) const {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(6, bodies_);
  for (Index p = 0; p < places_.cols(); ++p)
    for (Index b = 0; b < bodies_; ++b)
      wrenches.col(b) += by_body_[static_cast<std::size_t>(p * bodies_ + b)].transpose() * weights.col(p);
  return wrenches;
}

}  // namespace gracilis::strings
