#include <gracilis/draft/body_frame.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/geometry/symmetry_plane.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {
namespace {

Vec3 middle_of(const TriangleMesh& mesh) {
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  return mesh.vertices * areas / areas.sum();
}

/// Along the principal direction through the middle; which end is which is not said.
BoneAxis longest_line(const TriangleMesh& mesh) {
  const Vec3 middle = middle_of(mesh);
  const Points centered = mesh.vertices.colwise() - middle;
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  const Eigen::Matrix3d spread = centered * areas.asDiagonal() * centered.transpose();
  const Vec3 direction = principal_axes(spread).most();
  const Eigen::RowVectorXd along = direction.transpose() * centered;
  return {middle + along.minCoeff() * direction, middle + along.maxCoeff() * direction};
}

Real distance_between(const Vec3& p, const TriangleMesh& mesh) {
  return (mesh.vertices.colwise() - p).colwise().norm().minCoeff();
}

/// How many segments `below` hangs under `above`; 0 where it does not.
int steps_down(const std::string& above, std::string below) {
  for (int steps = 0; !below.empty(); ++steps) {
    if (below == above) return steps;
    below = dictionary().segment(below).parent;
  }
  return 0;
}

/// Positive where `near` is the end towards the trunk: other bones tell, those above by lying at it.
Real vote(const FoundFolder& found, const FoundBone& bone, const BoneAxis& axis) {
  Real strongest = 0;
  for (const FoundBone& other : found.bones) {
    if (!other.known || (other.side != bone.side && other.side != BodySide::none)) continue;
    const bool above = steps_down(other.known->segment, bone.known->segment) > 0;
    const bool below = steps_down(bone.known->segment, other.known->segment) > 0;
    if (!above && !below) continue;
    const Real nearer = distance_between(axis.far, other.mesh) - distance_between(axis.near, other.mesh);
    const Real says = above ? nearer : -nearer;
    if (std::abs(says) > std::abs(strongest)) strongest = says;
  }
  return strongest;
}

/// Where a bone's points would be in the dictionary's person.
Vec3 of_side(const Vec3& place, BodySide side) {
  return side == BodySide::left ? Vec3(place[0], place[1], -place[2]) : place;
}

struct Pairs {
  std::vector<Vec3> known, found;

  void add(const Vec3& in_dictionary, const Vec3& here) {
    known.push_back(in_dictionary);
    found.push_back(here);
  }
};

Pairs pairs_of(const FoundFolder& found, const std::vector<std::optional<BoneAxis>>& axes) {
  Pairs pairs;
  for (std::size_t b = 0; b < found.bones.size(); ++b) {
    const FoundBone& bone = found.bones[b];
    if (!bone.known) continue;
    pairs.add(of_side(bone.known->place, bone.side), middle_of(bone.mesh));
    if (!bone.known->ends || !axes[b]) continue;
    pairs.add(of_side((*bone.known->ends)[0], bone.side), axes[b]->near);
    pairs.add(of_side((*bone.known->ends)[1], bone.side), axes[b]->far);
  }
  return pairs;
}

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<Real>(points.size());
}

struct Turn {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< columns: forward, up, right in the files' frame
  Real flatness = 0;  ///< second singular value over the first: near 0 the points lie on a line
};

Turn best_turn(const Pairs& pairs) {
  const Vec3 of_known = mean(pairs.known), of_found = mean(pairs.found);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < pairs.known.size(); ++i)
    sum += (pairs.found[i] - of_found) * (pairs.known[i] - of_known).transpose();
  const Vec3 values = sum.jacobiSvd().singularValues();
  return {nearest_rotation(sum), values[0] > 0 ? values[1] / values[0] : 0};
}

/// The nearest axis of the files' frame where it is within the angle, else the direction itself.
Vec3 straightened(const Vec3& direction, Real angle, bool& moved) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const Vec3 straight = Vec3::Unit(axis) * (direction[axis] > 0 ? 1 : -1);
  moved = straight.dot(direction) > std::cos(angle);
  return moved ? straight : direction;
}

/// Below this places say little of where the body looks: a spine's bones lie nearly on a line.
constexpr Real slender = 0.2;

/// Of one vertebra: along its plane of symmetry, away from where it reaches farther, which is along its spinous
/// process.
Vec3 forward_of(const TriangleMesh& vertebra, const Vec3& up) {
  const Vec3 start = up.unitOrthogonal();
  SymmetryPlane best{{}, {}, std::numeric_limits<Real>::infinity()};
  for (const Real angle : {0.0, 45.0, 90.0, 135.0}) {
    const SymmetryPlane plane = symmetry_plane(vertebra, Eigen::AngleAxisd(radians(angle), up) * start);
    if (std::abs(plane.normal.dot(up)) < 0.5 && plane.misfit < best.misfit) best = plane;
  }
  if (!std::isfinite(best.misfit)) return Vec3::Zero();
  const Vec3 along = up.cross(best.normal).normalized();
  const Eigen::RowVectorXd places = along.transpose() * (vertebra.vertices.colwise() - middle_of(vertebra));
  return places.maxCoeff() > -places.minCoeff() ? Vec3(-along) : along;
}

/// Where two vertebrae and more look, which the atlas, a ring, does not tell; nothing where they do not agree.
std::optional<Vec3> forward_by_vertebrae(const FoundFolder& found, const Vec3& up) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const FoundBone& bone : found.bones) {
    if (!bone.known || !bone.known->name.starts_with("vertebra_") || bone.known->name == "vertebra_c1") continue;
    sum += forward_of(bone.mesh, up);
    ++count;
  }
  const Vec3 level = sum - sum.dot(up) * up;
  if (count < 2 || level.norm() < 0.7 * count) return std::nullopt;
  return level.normalized();
}

constexpr Real nearly_straight = radians(22);

}  // namespace

std::vector<std::optional<BoneAxis>> bone_axes(const FoundFolder& found) {
  std::vector<std::optional<BoneAxis>> axes(found.bones.size());
  for (std::size_t b = 0; b < found.bones.size(); ++b) {
    const FoundBone& bone = found.bones[b];
    if (!bone.known || !bone.known->ends) continue;
    BoneAxis axis = longest_line(bone.mesh);
    if (vote(found, bone, axis) < 0) std::swap(axis.near, axis.far);
    axes[b] = axis;
  }
  return axes;
}

Vec3 BodyFrame::named(const std::string& direction, BodySide side) const {
  const bool negative = direction.starts_with("-");
  const std::string name = negative ? direction.substr(1) : direction;
  Vec3 axis = name == "anterior" ? anterior : name == "superior" ? superior : right();
  if (side == BodySide::left && name != "right") axis = -axis;
  return negative ? Vec3(-axis) : axis;
}

BodyFrame body_frame(const FoundFolder& found, const std::vector<std::optional<BoneAxis>>& axes) {
  const Turn turn = best_turn(pairs_of(found, axes));
  BodyFrame frame;
  bool up_is_straight = false, forward_is_straight = false;
  frame.superior = straightened(turn.rotation.col(1), nearly_straight, up_is_straight);
  const std::optional<Vec3> of_vertebrae =
      turn.flatness < slender ? forward_by_vertebrae(found, turn.rotation.col(1)) : std::nullopt;
  Vec3 forward = of_vertebrae.value_or(turn.rotation.col(0));
  forward = (forward - forward.dot(frame.superior) * frame.superior).normalized();
  frame.anterior = up_is_straight ? straightened(forward, nearly_straight, forward_is_straight) : forward;
  const bool on_a_line = turn.flatness < 0.02 && !of_vertebrae;
  frame.certainty = up_is_straight && forward_is_straight ? (on_a_line ? 0.8 : 0.95) : on_a_line ? 0.5 : 0.8;
  frame.how = fmt::format("the turn that brings {} bones nearest to a standing person's{}{}", found.bones.size(),
                          of_vertebrae ? ", about the upright as the vertebrae look" : "",
                          up_is_straight && forward_is_straight ? ", taken to the nearest axes of the files' frame"
                          : on_a_line                           ? "; they lie nearly on one line"
                                                                : "");
  return frame;
}

}  // namespace gracilis
