#include <gracilis/strings/string_skin.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/point_segment.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gracilis::strings {

namespace {

/// Fibers that a vertex follows.
constexpr std::size_t bound_fibers = 16;
/// Weights fall with the distance plus this, m.
constexpr Real softening = 0.0005;
/// What fibers say about places is smoothed over this length, m, and loses its say towards attachments from this far.
constexpr Real smoothing = 0.02, fading = 0.02;
/// Narrowest and widest that a muscle becomes half-way between its ends: widths change by these shares.
constexpr Real narrowest = -0.5, widest = 1;
constexpr int volume_rounds = 4;

struct NearestOnFiber {
  Real distance = 0;
  Index node = 0;  ///< that the segment begins at
  Real share = 0;  ///< along the segment
};

NearestOnFiber nearest_on_fiber(const MuscleStrings& muscle, Index string, const Vec3& place) {
  NearestOnFiber best{std::numeric_limits<Real>::infinity(), 0, 0};
  for (Index i = 0; i + 1 < muscle.nodes; ++i) {
    const Index p = muscle.node(string, i);
    const Vec3 from = muscle.fibers.col(p), to = muscle.fibers.col(p + 1);
    const Real share = nearest_on_segment<Vec3>(place, from, to);
    const Real distance = (from + share * (to - from) - place).norm();
    if (distance < best.distance) best = {distance, p, share};
  }
  return best;
}

/// The nearest fibers, and their weights: falling with distance, 0 at the first fiber that is left out.
std::vector<std::pair<NearestOnFiber, Real>> weighted_fibers(const MuscleStrings& muscle, const Vec3& place) {
  std::vector<NearestOnFiber> all;
  for (Index s = 0; s < muscle.strings; ++s) all.push_back(nearest_on_fiber(muscle, s, place));
  std::sort(all.begin(), all.end(), [](const NearestOnFiber& a, const NearestOnFiber& b) {
    return std::tie(a.distance, a.node) < std::tie(b.distance, b.node);
  });
  const std::size_t count = std::min(bound_fibers, all.size());
  // Where more fibers than these end in the vertex itself, all of them are as near as can be.
  const bool all_are_near = count < all.size() && all[count].distance > 0;
  const Real cut = all_are_near ? all[count].distance : all.back().distance * 1.1 + softening;
  std::vector<std::pair<NearestOnFiber, Real>> weighted;
  Real sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Real nearness = std::max(1 - all[k].distance / cut, 1e-6) / (all[k].distance + softening);
    weighted.emplace_back(all[k], nearness * nearness);
    sum += nearness * nearness;
  }
  for (auto& [fiber, weight] : weighted) weight /= sum;
  return weighted;
}

struct VertexBinding {
  std::vector<std::pair<Index, Real>> nodes;
  Vec3 offset, direction;
  Real along = 0;
};

VertexBinding bind_vertex(const MuscleStrings& muscle, const Vec3& place) {
  VertexBinding binding{{}, place, Vec3::Zero(), 0};
  for (const auto& [fiber, weight] : weighted_fibers(muscle, place)) {
    const Index i = fiber.node % muscle.nodes, string = fiber.node / muscle.nodes;
    binding.nodes.emplace_back(fiber.node, weight * (1 - fiber.share));
    binding.nodes.emplace_back(fiber.node + 1, weight * fiber.share);
    binding.direction += weight * ((1 - fiber.share) * string_direction(muscle, muscle.taut, string, i) +
                                   fiber.share * string_direction(muscle, muscle.taut, string, i + 1));
    binding.along += weight * (i + fiber.share) / static_cast<Real>(muscle.nodes - 1);
  }
  for (const auto& [node, weight] : binding.nodes) binding.offset -= weight * muscle.fibers.col(node);
  binding.direction.normalize();
  return binding;
}

/// How far the places that fibers give to vertices are trusted: not at all at attachments, fully this far from them.
Eigen::VectorXd trust_beyond_attachments(const Points& rest, const std::vector<Index>& attached_body) {
  Points attached(3, 0);
  for (Index v = 0; v < rest.cols(); ++v) {
    if (attached_body[static_cast<std::size_t>(v)] < 0) continue;
    attached.conservativeResize(3, attached.cols() + 1);
    attached.rightCols<1>() = rest.col(v);
  }
  Eigen::VectorXd trust = Eigen::VectorXd::Ones(rest.cols());
  if (attached.cols() == 0) return trust;
  const NearestPoints nearest(attached);
  for (Index v = 0; v < rest.cols(); ++v) {
    const Real share = std::min((attached.col(nearest.nearest(rest.col(v))) - rest.col(v)).norm() / fading, Real{1});
    trust[v] = share * share;
  }
  return trust;
}

/// Two shapes of a surface, one above the other: at rest width, and by how much all of it moves per unit of widening.
using WidenedSurface = Eigen::Matrix<Real, 6, Eigen::Dynamic>;

/// The volume that the first shape plus so many times the second encloses: coefficients of a cubic.
Eigen::Vector4d volume_by_widening(const WidenedSurface& surface, const Eigen::Matrix3Xi& faces) {
  using Corner = Eigen::Matrix<Real, 6, 1>;
  Eigen::Vector4d six_volumes = Eigen::Vector4d::Zero();
  const Corner origin = surface.col(0);
  for (Index face = 0; face < faces.cols(); ++face) {
    const Corner a = surface.col(faces(0, face)) - origin, b = surface.col(faces(1, face)) - origin,
                 c = surface.col(faces(2, face)) - origin;
    const Vec3 a0 = a.head<3>(), a1 = a.tail<3>(), b0 = b.head<3>(), b1 = b.tail<3>(), c0 = c.head<3>(),
               c1 = c.tail<3>();
    const Vec3 area0 = b0.cross(c0), area1 = b0.cross(c1) + b1.cross(c0), area2 = b1.cross(c1);
    six_volumes +=
        Eigen::Vector4d(a0.dot(area0), a1.dot(area0) + a0.dot(area1), a1.dot(area1) + a0.dot(area2), a1.dot(area2));
  }
  return six_volumes / 6;
}

/// The widening for which the surface encloses its volume at rest, by secants.
Real widening_to_volume(const WidenedSurface& surface, const Eigen::Matrix3Xi& faces, Real volume) {
  const Eigen::Vector4d cubic = volume_by_widening(surface, faces) / volume;
  const auto excess = [&](Real share) {
    return cubic[0] + share * (cubic[1] + share * (cubic[2] + share * cubic[3])) - 1;
  };
  Real before = 0, excess_before = excess(before);
  Real now = std::clamp(-excess_before, narrowest, widest);
  for (int round = 0; round < volume_rounds && now != before; ++round) {
    const Real excess_now = excess(now);
    const Real slope = (excess_now - excess_before) / (now - before);
    before = now, excess_before = excess_now;
    if (!(slope > 0)) break;
    now = std::clamp(now - excess_now / slope, narrowest, widest);
  }
  return now;
}

}  // namespace

StringSkin bind_skin(const MuscleStrings& muscle, const TriangleMesh& surface,
                     const std::vector<Index>& attached_body) {
  const Points& rest = surface.vertices;
  const Index count = static_cast<Index>(rest.cols());
  std::vector<VertexBinding> bindings(static_cast<std::size_t>(count));
  parallel_for(count, 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) bindings[static_cast<std::size_t>(v)] = bind_vertex(muscle, rest.col(v));
  });
  StringSkin skin;
  skin.offsets.resize(3, count), skin.directions.resize(3, count), skin.widening.resize(count);
  skin.attached_body = attached_body;
  skin.volume = enclosed_volume(rest, surface.faces);
  for (Index v = 0; v < count; ++v) {
    const VertexBinding& binding = bindings[static_cast<std::size_t>(v)];
    skin.begin.push_back(static_cast<Index>(skin.nodes.size()));
    for (const auto& [node, weight] : binding.nodes) {
      if (!(weight > 0)) continue;
      skin.nodes.push_back(node);
      skin.weights.push_back(static_cast<float>(weight));
    }
    skin.offsets.col(v) = binding.offset, skin.directions.col(v) = binding.direction,
    skin.widening[v] = std::sin(pi * binding.along);
  }
  skin.begin.push_back(static_cast<Index>(skin.nodes.size()));
  std::vector<char> is_attached;
  for (const Index body : attached_body) is_attached.push_back(body >= 0);
  skin.fit = std::make_shared<const GradientFit>(surface, is_attached, trust_beyond_attachments(rest, attached_body),
                                                 smoothing);
  return skin;
}

namespace {

/// How far each node would move per unit of widening: away from its cross-section's center, across the fibers.
Points node_widening(const MuscleStrings& muscle, const Points& fibers) {
  Points widening(3, fibers.cols());
  for (Index i = 0; i < muscle.nodes; ++i) {
    Vec3 center = Vec3::Zero(), direction = Vec3::Zero();
    for (Index s = 0; s < muscle.strings; ++s) {
      center += fibers.col(muscle.node(s, i)) / muscle.strings;
      direction += string_direction(muscle, fibers, s, i);
    }
    direction.normalize();
    const Real share = std::sin(pi * i / (muscle.nodes - 1));
    for (Index s = 0; s < muscle.strings; ++s) {
      const Vec3 out = fibers.col(muscle.node(s, i)) - center;
      widening.col(muscle.node(s, i)) = share * (out - direction * direction.dot(out));
    }
  }
  return widening;
}

/// Per node the length of its string over that at rest.
Eigen::ArrayXd string_stretches(const MuscleStrings& muscle, const Points& places) {
  Eigen::ArrayXd stretches(places.cols());
  for (Index s = 0; s < muscle.strings; ++s) {
    const Index first = muscle.node(s, 0);
    stretches.segment(first, muscle.nodes) = polyline_length(places.middleCols(first, muscle.nodes)) /
                                             polyline_length(muscle.taut.middleCols(first, muscle.nodes));
  }
  return stretches;
}

/// What nodes say of the vertices that follow them: per node how far it moved further than all do on average, its
/// widening (m), by how much its string is stretched, an unused number, and its turn as a quaternion. Side by side and
/// in single precision, as XPBD has its particles: a vector unit takes four at once.
using NodeColumn = Eigen::Array<float, 12, 1>;
struct FollowedNodes {
  Vec3 moved;  ///< on average
  Eigen::Array<float, 12, Eigen::Dynamic> columns;
};

/// q and -q are the same rotation; a mean wants those of neighbors on one side.
void turn_to_one_side(const MuscleStrings& muscle, Eigen::Matrix4Xd& turns) {
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = s == 0 ? 1 : 0; i < muscle.nodes; ++i) {
      const Index neighbor = i > 0 ? muscle.node(s, i - 1) : muscle.node(s - 1, 0);
      auto turn = turns.col(muscle.node(s, i));
      if (turns.col(neighbor).dot(turn) < 0) turn = -turn;
    }
}

FollowedNodes followed_nodes(const MuscleStrings& muscle, const StringState& state) {
  FiberFrames frames = fiber_frames(muscle, state);
  turn_to_one_side(muscle, frames.turns);
  const Points moved = frames.fibers - muscle.fibers;
  FollowedNodes nodes{moved.rowwise().mean(), {}};
  nodes.columns.setZero(12, moved.cols());
  nodes.columns.topRows<3>() = (moved.colwise() - nodes.moved).cast<float>();
  nodes.columns.middleRows<3>(3) = node_widening(muscle, frames.fibers).cast<float>();
  nodes.columns.row(6) = (string_stretches(muscle, state.places) - 1).transpose().cast<float>();
  nodes.columns.bottomRows<4>() = frames.turns.cast<float>();
  return nodes;
}

/// Weighted means over a vertex's nodes.
struct Followed {
  Vec3 moved, widening;
  Eigen::Vector4d turn;
  Real stretch;
};

Followed follow_nodes(const StringSkin& skin, Index vertex, const FollowedNodes& nodes) {
  const auto v = static_cast<std::size_t>(vertex);
  NodeColumn sums = NodeColumn::Zero();
  for (auto k = static_cast<std::size_t>(skin.begin[v]); k < static_cast<std::size_t>(skin.begin[v + 1]); ++k) {
    const float weight = skin.weights[k];
    const float* node = nodes.columns.col(skin.nodes[k]).data();
    for (Index i = 0; i < sums.size(); ++i) sums[i] += weight * node[i];
  }
  const Eigen::Matrix<Real, 12, 1> means = sums.cast<Real>();
  return {nodes.moved + means.head<3>(), means.segment<3>(3), means.tail<4>().normalized(), 1 + means[6]};
}

}  // namespace

SkinnedSurface skinned_by_strings(const MuscleStrings& muscle, const StringSkin& skin, const Points& rest,
                                  const Eigen::Matrix3Xi& faces, const StringState& state) {
  const FollowedNodes nodes = followed_nodes(muscle, state);
  const Index count = static_cast<Index>(rest.cols());
  SkinnedSurface skinned{Points(3, count), Eigen::Matrix4Xd(4, count)};
  GradientFit::AimOf<6> aim{WidenedSurface(6, count), {}};
  aim.gradients.resize(static_cast<std::size_t>(count));
  parallel_for(count, 512, [&](Index begin, Index end) {
    for (Index vertex = begin; vertex < end; ++vertex) {
      const auto v = static_cast<std::size_t>(vertex);
      const Followed followed = follow_nodes(skin, vertex, nodes);
      skinned.turns.col(vertex) = followed.turn;
      auto place = aim.places.col(vertex);
      auto& gradient = aim.gradients[v];
      if (const Index body = skin.attached_body[v]; body >= 0) {
        const RigidTransform& moved = state.bodies[static_cast<std::size_t>(body)];
        place << moved * Vec3(rest.col(vertex)), Vec3::Zero();
        gradient << moved.linear(), Eigen::Matrix3d::Zero();
        continue;
      }
      const Eigen::Matrix3d turn = Eigen::Quaterniond(followed.turn).toRotationMatrix();
      const Vec3 direction = skin.directions.col(vertex), offset = skin.offsets.col(vertex);
      const Eigen::Matrix3d turned_along = (turn * direction) * direction.transpose();
      const Eigen::Matrix3d turned_across = turn - turned_along;
      const Eigen::Matrix3d widened = skin.widening[vertex] * turned_across;
      place << rest.col(vertex) + followed.moved + (turn * offset - offset), followed.widening + widened * offset;
      gradient << followed.stretch * turned_along + turned_across / std::sqrt(followed.stretch), widened;
    }
  });
  const WidenedSurface fitted = skin.fit->fitted(aim);
  skinned.vertices = fitted.topRows<3>() + widening_to_volume(fitted, faces, skin.volume) * fitted.bottomRows<3>();
  return skinned;
}

}  // namespace gracilis::strings
