#include <gracilis/strings/string_lanes.hpp>

#include <gracilis/dynamics/simd/group_width.hpp>
#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/muscle_strings.hpp>
#include <gracilis/strings/node_forces.hpp>

#include <algorithm>

namespace gracilis::strings {

namespace {

/// Fills an array for all nodes of all lanes with what `number` says of a string and a node.
template <class Number>
std::vector<float> per_node(const StringLanes& lanes, const Number& number) {
  std::vector<float> numbers(static_cast<std::size_t>(lanes.width * lanes.nodes));
  for (Index i = 0; i < lanes.nodes; ++i)
    for (Index s = 0; s < lanes.width; ++s)
      numbers[static_cast<std::size_t>(i * lanes.width + s)] =
          static_cast<float>(number(std::min(s, lanes.strings - 1), i));
  return numbers;
}

template <class Place>
LanePoints points_per_node(const StringLanes& lanes, const Place& place) {
  LanePoints points;
  for (std::size_t axis = 0; axis < 3; ++axis)
    points[axis] = per_node(lanes, [&](Index s, Index i) -> Real { return place(s, i)[static_cast<Index>(axis)]; });
  return points;
}

void share_among_bodies(const MuscleStrings& muscle, StringLanes& lanes) {
  for (Index body = 0; body < muscle.shares.rows(); ++body) {
    std::vector<float> shares = per_node(lanes, [&](Index s, Index i) -> Real {
      const Index holding = body_holding(muscle, s, i);
      return holding >= 0 ? holding == body : muscle.shares(body, muscle.node(s, i));
    });
    if (*std::max_element(shares.begin(), shares.end()) <= 0) continue;
    lanes.bodies.push_back(body);
    std::vector<Real>& means = lanes.section_shares.emplace_back(static_cast<std::size_t>(lanes.nodes), 0);
    for (Index i = 0; i < lanes.nodes; ++i)
      for (Index s = 0; s < lanes.strings; ++s)
        means[static_cast<std::size_t>(i)] +=
            static_cast<Real>(shares[static_cast<std::size_t>(i * lanes.width + s)]) / lanes.strings;
    lanes.shares.push_back(std::move(shares));
  }
  lanes.free = per_node(lanes, [&](Index s, Index i) { return body_holding(muscle, s, i) < 0; });
}

const NodeSupport& support_at(const MuscleStrings& muscle, Index s, Index i) {
  return muscle.supports[static_cast<std::size_t>(muscle.node(s, i))];
}

void lay_on_supports(const MuscleStrings& muscle, StringLanes& lanes) {
  lanes.normal = points_per_node(lanes, [&](Index s, Index i) { return support_at(muscle, s, i).normal; });
  lanes.plane_share = per_node(lanes, [&](Index s, Index i) {
    Real share = support_at(muscle, s, i).normal.isZero(0) ? 0 : 1;
    for (const Slide& slide : support_at(muscle, s, i).slides) share -= slide.share;
    return share > least_plane_share ? share : 0;
  });
}

void keep_to_bones(const MuscleStrings& muscle, StringLanes& lanes) {
  for (Index b = 0; b < muscle.bone_distances.rows(); ++b) {
    const auto bone = static_cast<std::size_t>(b);
    const auto slide = [&](Index s, Index i) {
      for (const Slide& each : support_at(muscle, s, i).slides)
        if (each.bone == b) return each;
      return Slide{};
    };
    StringLanes::Bone& numbers = lanes.bones.emplace_back();
    numbers.kept = per_node(lanes, [&](Index s, Index i) { return kept_at_node(muscle, bone, muscle.node(s, i)); });
    numbers.kept_middle = per_node(lanes, [&](Index s, Index i) {
      const Index next = std::min(i + 1, muscle.nodes - 1);
      return kept_at_middle(muscle, bone, muscle.node(s, i), muscle.node(s, next));
    });
    numbers.slide_share = per_node(lanes, [&](Index s, Index i) { return slide(s, i).share; });
    numbers.slide_distance = per_node(lanes, [&](Index s, Index i) { return slide(s, i).distance; });
    for (std::size_t at = 0; at < numbers.kept.size(); ++at)
      numbers.acts_within.push_back(numbers.slide_share[at] > 0 ? std::max(numbers.kept[at], numbers.slide_distance[at])
                                                                : std::max(numbers.kept[at], -1.0F));
  }
}

void hold_among_neighbors(const MuscleStrings& muscle, StringLanes& lanes) {
  if (muscle.neighbors.empty() || muscle.neighbors.front().empty()) return;
  lanes.neighbor_weight.assign(static_cast<std::size_t>(muscle.strings * lanes.width), 0);
  lanes.neighbor_weight_of = lanes.neighbor_weight;
  for (Index s = 0; s < muscle.strings; ++s) {
    const std::vector<Index>& neighbors = muscle.neighbors[static_cast<std::size_t>(s)];
    for (const Index j : neighbors) {
      const float weight = 1 / static_cast<float>(neighbors.size());
      lanes.neighbor_weight[static_cast<std::size_t>(j * lanes.width + s)] = weight;
      lanes.neighbor_weight_of[static_cast<std::size_t>(s * lanes.width + j)] = weight;
    }
  }
  lanes.from_neighbors = points_per_node(lanes, [&](Index s, Index i) -> Vec3 {
    Vec3 mean = Vec3::Zero();
    const std::vector<Index>& neighbors = muscle.neighbors[static_cast<std::size_t>(s)];
    for (const Index j : neighbors) mean += muscle.taut.col(muscle.node(j, i)) / static_cast<Real>(neighbors.size());
    return muscle.taut.col(muscle.node(s, i)) - mean;
  });
}

void measure_sections(const MuscleStrings& muscle, StringLanes& lanes) {
  Points centers(3, muscle.nodes);
  for (Index i = 0; i < muscle.nodes; ++i) {
    const StringSection section = string_section(muscle, muscle.taut, i);
    centers.col(i) = section.center;
    lanes.section_direction.emplace_back((section.spread * section.direction.normalized()).cast<float>());
  }
  lanes.from_section = points_per_node(
      lanes, [&](Index s, Index i) -> Vec3 { return muscle.taut.col(muscle.node(s, i)) - centers.col(i); });
  for (std::vector<float>& axis : lanes.from_section)
    for (Index i = 0; i < lanes.nodes; ++i)
      for (Index s = lanes.strings; s < lanes.width; ++s) axis[static_cast<std::size_t>(i * lanes.width + s)] = 0;
}

}  // namespace

StringLanes string_lanes(const MuscleStrings& muscle) {
  StringLanes lanes;
  lanes.strings = muscle.strings, lanes.nodes = muscle.nodes;
  lanes.width = (muscle.strings + group_width - 1) / group_width * group_width;
  lanes.center = muscle.taut.rowwise().mean();
  const Real segments = static_cast<Real>(muscle.nodes - 1);
  for (Index s = 0; s < lanes.width; ++s) {
    const Real length = muscle.lengths[static_cast<std::size_t>(std::min(s, lanes.strings - 1))];
    lanes.tension.push_back(static_cast<float>(segments / length));
    lanes.node_length.push_back(static_cast<float>(length / segments));
  }
  share_among_bodies(muscle, lanes);
  const auto seen_from_center = [&](const Points& places) {
    return points_per_node(lanes,
                           [&](Index s, Index i) -> Vec3 { return places.col(muscle.node(s, i)) - lanes.center; });
  };
  lanes.taut = seen_from_center(muscle.taut), lanes.fiber = seen_from_center(muscle.fibers);
  lanes.tie = per_node(lanes, [&](Index s, Index i) { return muscle.ties[muscle.node(s, i)]; });
  lay_on_supports(muscle, lanes);
  keep_to_bones(muscle, lanes);
  hold_among_neighbors(muscle, lanes);
  measure_sections(muscle, lanes);
  return lanes;
}

}  // namespace gracilis::strings
