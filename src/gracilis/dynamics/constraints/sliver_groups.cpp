#include <gracilis/dynamics/constraints/sliver_groups.hpp>

#include <gracilis/dynamics/constraints/slivers.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// For each tip the first turn in which all those before it have had theirs whose moves it looks at, or who look at
/// what it moves.
std::vector<Index> turns_of(const SliverSet& set, const Particles& rest) {
  std::vector<Index> turns, moved(static_cast<std::size_t>(rest.count()), 0), looked_at = moved;
  for (const SliverTip& tip : set.tips) {
    std::vector<Index> looks = {tip.particle, tip.a, tip.b}, moves = {tip.a, tip.b};
    if (rest.inverse_mass(tip.particle) > 0) moves = {tip.particle};
    for (Index i = tip.begin; i < tip.end; ++i)
      for (const Index corner : set.faces[static_cast<std::size_t>(i)]) looks.push_back(corner);
    Index turn = 0;
    for (const Index p : looks) turn = std::max(turn, moved[static_cast<std::size_t>(p)]);
    for (const Index p : moves) turn = std::max(turn, looked_at[static_cast<std::size_t>(p)]);
    for (const Index p : moves) moved[static_cast<std::size_t>(p)] = turn + 1;
    for (const Index p : looks) {
      Index& last = looked_at[static_cast<std::size_t>(p)];
      last = std::max(last, turn + 1);
    }
    turns.push_back(turn);
  }
  return turns;
}

using Fan = std::vector<std::array<Index, 2>>;

/// The other two corners of the faces around one end of a tip's side that are not its own.
Fan fan_around(const VertexFaces& vertex_faces, Index end, Index tip) {
  Fan fan;
  for (Index i = vertex_faces.offsets[static_cast<std::size_t>(end)];
       i < vertex_faces.offsets[static_cast<std::size_t>(end) + 1]; ++i)
    if ((vertex_faces.ends.col(i).array() != tip).all())
      fan.push_back({vertex_faces.ends(0, i), vertex_faces.ends(1, i)});
  return fan;
}

/// Puts the lanes' fans side by side; what a lane has less of is filled with the end itself, which has no area.
AlignedVector<Index> side_by_side(const std::vector<Fan>& fans, const std::array<Index, group_width>& ends) {
  std::size_t most = 0;
  for (const Fan& fan : fans) most = std::max(most, fan.size());
  AlignedVector<Index> corners;
  for (std::size_t face = 0; face < most; ++face)
    for (std::size_t corner = 0; corner < 2; ++corner)
      for (std::size_t lane = 0; lane < fans.size(); ++lane)
        corners.push_back(face < fans[lane].size() ? fans[lane][face][corner] : ends[lane]);
  return corners;
}

SliverGroup make_group(const SliverSet& set, const VertexFaces& vertex_faces, std::vector<Index> members) {
  SliverGroup group;
  std::vector<Fan> around_a, around_b;
  for (std::size_t lane = 0; lane < group.tip.size(); ++lane) {
    const Index member = members[std::min(lane, members.size() - 1)];
    const SliverTip& tip = set.tips[static_cast<std::size_t>(member)];
    group.tip[lane] = tip.particle, group.a[lane] = tip.a, group.b[lane] = tip.b;
    group.share[lane] = tip.share;
    const Eigen::Vector2f offset = tip.offset.tail<2>(), toward = offset.stableNormalized();
    group.across[lane] = toward.x(), group.out[lane] = toward.y(), group.least[lane] = least_ahead(tip);
    around_a.push_back(fan_around(vertex_faces, tip.a, tip.particle));
    around_b.push_back(fan_around(vertex_faces, tip.b, tip.particle));
  }
  group.around_a = side_by_side(around_a, group.a), group.around_b = side_by_side(around_b, group.b);
  group.members = std::move(members);
  return group;
}

}  // namespace

std::vector<SliverGroup> group_slivers(const SliverSet& set, const VertexFaces& vertex_faces, const Particles& rest) {
  const std::vector<Index> turns = turns_of(set, rest);
  std::vector<std::vector<Index>> of_turn;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto turn = static_cast<std::size_t>(turns[i]);
    of_turn.resize(std::max(of_turn.size(), turn + 1));
    of_turn[turn].push_back(static_cast<Index>(i));
  }
  const auto face_count = [&](Index member) {
    const SliverTip& tip = set.tips[static_cast<std::size_t>(member)];
    return tip.end - tip.begin;
  };
  std::vector<SliverGroup> groups;
  for (std::vector<Index>& members : of_turn) {
    // Alike beside alike: a lane takes as long as the one with most faces.
    std::stable_sort(members.begin(), members.end(), [&](Index l, Index r) { return face_count(l) > face_count(r); });
    for (std::size_t begin = 0; begin < members.size(); begin += group_width) {
      const std::size_t end = std::min(begin + group_width, members.size());
      groups.push_back(make_group(
          set, vertex_faces,
          {members.begin() + static_cast<std::ptrdiff_t>(begin), members.begin() + static_cast<std::ptrdiff_t>(end)}));
    }
  }
  return groups;
}

}  // namespace gracilis
