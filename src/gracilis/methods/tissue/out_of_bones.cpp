#include <gracilis/methods/tissue/out_of_bones.hpp>

#include <gracilis/geometry/field_spline.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace gracilis::tissue {

namespace {

/// Edges share their ends, so those that were pushed out of bones are looked at again, so often.
constexpr int edge_rounds = 2;
/// At the middles of edges splines of fields count as off by less than this, m: a bone is looked at less often than
/// at vertices, of which there are fewer.
constexpr Real edge_field_error = 3e-4;

/// A place in a bone's frame, which was looked at from vertex `seen_from` close by, how far from the bone it is to be,
/// and by how much the field may be wrong there, m.
struct NearPlace {
  Index seen_from = 0;
  Vec3 there;
  Real least = 0, error = 0;
};

/// How far from the bone a place is, the same whatever the field says of it, and the faster the nearer that is.
SignedDistance::Answer distance_near(const SignedDistance& exact, const Vec3& there, Real by_field, Real error) {
  const SignedDistance::Answer found = exact.query(there, std::abs(by_field) + error);
  return found.nearest.face >= 0 ? found : exact.query(there);
}

/// The field, which is round where the bone has an edge, says which way is out, and the bone itself how far. It is not
/// straight out, so once may not be enough. In the bone's frame.
Vec3 push_out_of(const BoneGap& bone, const SignedDistance& exact, const NearPlace& place, Real by_field) {
  Vec3 push = Vec3::Zero();
  SignedDistance::Answer found = distance_near(exact, place.there, by_field, place.error);
  for (int i = 0; i < bone_rounds && found.distance < place.least; ++i) {
    push += (place.least - found.distance) *
            sample_spline_precise(bone.field.grid, place.there + push).gradient.normalized();
    found = exact.query_from(found.nearest.face, place.there + push);
  }
  return push;
}

/// What takes the place out of the bone, nothing where the field says that it is clear.
Vec3 push_from(const PreparedTissue& muscle, const Surroundings& around, std::size_t b, const SignedDistance& exact,
               const NearPlace& place) {
  const BoneGap& bone = muscle.bones[b];
  const Real clear = place.least + place.error;
  if (least_distance(around.queries[b], place.seen_from, place.there) > clear) return Vec3::Zero();
  const Real by_field = distance_in(bone, place.there);
  if (by_field > clear) return Vec3::Zero();
  return around.bodies[static_cast<std::size_t>(bone.body)].linear() * push_out_of(bone, exact, place, by_field);
}

/// Vertices that contact, which is soft, lets come too near.
void push_vertices_out(const PreparedTissue& muscle, const Surroundings& around,
                       const std::vector<SignedDistance>& distances, Points& x) {
  for (Index v = 0; v < muscle.vertex_count; ++v)
    for (const NearBone& near : bones_near(around, v)) {
      const auto b = static_cast<std::size_t>(near.bone);
      const BoneGap& bone = muscle.bones[b];
      const Real least = bone.seen_least[static_cast<std::size_t>(v)];
      const Vec3 there = around.inverses[static_cast<std::size_t>(bone.body)] * x.col(v);
      x.col(v) += push_from(muscle, around, b, distances[b], {v, there, least, field_error});
    }
}

/// The middle of an edge, by its ends that are free. True when it had to be pushed.
bool push_edge_out(const PreparedTissue& muscle, const Surroundings& around, std::size_t b, const SignedDistance& exact,
                   std::size_t edge, Points& x) {
  const BoneGap& bone = muscle.bones[b];
  const auto [first, second] = muscle.edges[edge];
  const Vec3 there = around.inverses[static_cast<std::size_t>(bone.body)] * Vec3((x.col(first) + x.col(second)) / 2);
  const Vec3 push = push_from(muscle, around, b, exact, {first, there, bone.edge_least[edge], edge_field_error});
  for (const Index v : {first, second})
    if (muscle.points[static_cast<std::size_t>(v)].held_by < 0) x.col(v) += push;
  return !push.isZero(0);
}

/// The middles of edges, which are deeper than both ends where a bone has a ridge.
void push_edges_out(const PreparedTissue& muscle, const Surroundings& around,
                    const std::vector<SignedDistance>& distances, Points& x) {
  std::vector<std::pair<std::size_t, std::size_t>> pushed;  // bones and edges
  for (Index v = 0; v < muscle.vertex_count; ++v)
    for (const NearBone& near : bones_near(around, v)) {
      const auto b = static_cast<std::size_t>(near.bone);
      const auto is_this = [&](const NearBone& each) { return each.bone == near.bone; };
      for (const Index at : muscle.edges_of_vertices.with(v)) {
        const auto edge = static_cast<std::size_t>(at / 2);
        const Index other = muscle.edges[edge][1 - static_cast<std::size_t>(at % 2)];
        const std::span<const NearBone> at_other = bones_near(around, other);
        if (other < v && std::any_of(at_other.begin(), at_other.end(), is_this)) continue;  // had its turn there
        if (push_edge_out(muscle, around, b, distances[b], edge, x)) pushed.emplace_back(b, edge);
      }
    }
  for (int round = 1; round < edge_rounds; ++round)
    for (const auto& [b, edge] : pushed) push_edge_out(muscle, around, b, distances[b], edge, x);
}

}  // namespace

void push_out_of_bones(const PreparedTissue& muscle, const Surroundings& around,
                       const std::vector<SignedDistance>& distances, Points& x) {
  push_vertices_out(muscle, around, distances, x);
  push_edges_out(muscle, around, distances, x);
}

}  // namespace gracilis::tissue
