#include <gracilis/strings/string_skin.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
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
    const Vec3 from = muscle.fibers.col(p), along = muscle.fibers.col(p + 1) - from;
    const Real length2 = along.squaredNorm();
    const Real share = length2 > 0 ? std::clamp((place - from).dot(along) / length2, 0.0, 1.0) : 0;
    const Real distance = (from + share * along - place).norm();
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

/// The sum of two shapes of a surface: at rest width, and by how much all of it moves per unit of widening.
struct WidenedSurface {
  Points narrow, widening;
  Points at(Real share) const { return narrow + share * widening; }
};

/// The widening for which the surface encloses its volume at rest, by secants; the volume is a cubic in it.
Real widening_to_volume(const WidenedSurface& surface, const Eigen::Matrix3Xi& faces, Real volume) {
  const auto excess = [&](Real share) { return enclosed_volume(surface.at(share), faces) / volume - 1; };
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
  skin.offsets.resize(3, count), skin.directions.resize(3, count), skin.along.resize(count);
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
    skin.offsets.col(v) = binding.offset, skin.directions.col(v) = binding.direction, skin.along[v] = binding.along;
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
std::vector<Real> string_stretches(const MuscleStrings& muscle, const Points& places) {
  std::vector<Real> stretches;
  for (Index s = 0; s < muscle.strings; ++s) {
    const Index first = muscle.node(s, 0);
    const Real stretch = polyline_length(places.middleCols(first, muscle.nodes)) /
                         polyline_length(muscle.taut.middleCols(first, muscle.nodes));
    stretches.insert(stretches.end(), static_cast<std::size_t>(muscle.nodes), stretch);
  }
  return stretches;
}

/// Weighted means over a vertex's nodes.
struct Followed {
  Vec3 place = Vec3::Zero(), widening = Vec3::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  Real stretch = 0;
};

/// Where strings are, and what follows from it for their nodes.
struct StringFrames {
  FiberFrames frames;
  Points widening;
  std::vector<Real> stretches;
};

Followed follow_nodes(const StringSkin& skin, Index vertex, const StringFrames& now) {
  const auto v = static_cast<std::size_t>(vertex);
  Followed followed;
  const Eigen::Vector4d first = now.frames.turns.col(skin.nodes[static_cast<std::size_t>(skin.begin[v])]);
  Real sum = 0;
  for (auto k = static_cast<std::size_t>(skin.begin[v]); k < static_cast<std::size_t>(skin.begin[v + 1]); ++k) {
    const Real weight = static_cast<Real>(skin.weights[k]);
    const Index node = skin.nodes[k];
    followed.place += weight * now.frames.fibers.col(node);
    followed.widening += weight * now.widening.col(node);
    followed.stretch += weight * now.stretches[static_cast<std::size_t>(node)];
    // q and -q are the same rotation; the mean wants them on one side.
    followed.turn += (first.dot(now.frames.turns.col(node)) < 0 ? -weight : weight) * now.frames.turns.col(node);
    sum += weight;
  }
  followed.place /= sum;
  followed.widening /= sum;
  followed.stretch /= sum;
  followed.turn.normalize();
  return followed;
}

GradientFit::Aim room_for(Index vertices) {
  return {Points(3, vertices), std::vector<Eigen::Matrix3d>(static_cast<std::size_t>(vertices))};
}

}  // namespace

SkinnedSurface skinned_by_strings(const MuscleStrings& muscle, const StringSkin& skin, const Points& rest,
                                  const Eigen::Matrix3Xi& faces, const StringState& state) {
  FiberFrames frames = fiber_frames(muscle, state);
  Points node_widths = node_widening(muscle, frames.fibers);
  const StringFrames now{std::move(frames), std::move(node_widths), string_stretches(muscle, state.places)};
  const Index count = static_cast<Index>(rest.cols());
  SkinnedSurface skinned{Points(3, count), Eigen::Matrix4Xd(4, count)};
  GradientFit::Aim narrow = room_for(count), widening = room_for(count);
  parallel_for(count, 512, [&](Index begin, Index end) {
    for (Index vertex = begin; vertex < end; ++vertex) {
      const auto v = static_cast<std::size_t>(vertex);
      const Followed followed = follow_nodes(skin, vertex, now);
      skinned.turns.col(vertex) = followed.turn;
      if (const Index body = skin.attached_body[v]; body >= 0) {
        const RigidTransform& moved = state.bodies[static_cast<std::size_t>(body)];
        narrow.places.col(vertex) = moved * Vec3(rest.col(vertex)), narrow.gradients[v] = moved.linear();
        widening.places.col(vertex).setZero(), widening.gradients[v].setZero();
        continue;
      }
      const Eigen::Matrix3d turn = Eigen::Quaterniond(followed.turn).toRotationMatrix();
      const Vec3 direction = skin.directions.col(vertex), offset = skin.offsets.col(vertex);
      const Eigen::Matrix3d along = direction * direction.transpose();
      const Eigen::Matrix3d turned_across = turn - turn * along;
      const Real share = std::sin(pi * skin.along[vertex]);
      narrow.places.col(vertex) = followed.place + turn * offset;
      narrow.gradients[v] = followed.stretch * turn * along + turned_across / std::sqrt(followed.stretch);
      widening.places.col(vertex) = followed.widening + share * turned_across * offset;
      widening.gradients[v] = share * turned_across;
    }
  });
  auto [narrow_fit, widening_fit] = skin.fit->fitted(narrow, widening);
  const WidenedSurface widened{std::move(narrow_fit), std::move(widening_fit)};
  skinned.vertices = widened.at(widening_to_volume(widened, faces, skin.volume));
  return skinned;
}

}  // namespace gracilis::strings
