#include <gracilis/dynamics/constraints/slivers.hpp>

#include <gracilis/dynamics/constraints/lost_slivers.hpp>
#include <gracilis/dynamics/leverage.hpp>
#include <gracilis/dynamics/vertex_faces.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>

namespace gracilis {

namespace {

/// How far anything may go at once, over the length of the side. Tips lie nearer to their sides than a tenth of that:
/// what is missing beyond has been torn away, not turned over, and comes back gradually, or slivers and the limit of
/// stretch would throw it to and fro.
constexpr float longest_push = 0.02f;

struct Candidate {
  Index tip, a, b;
  float height;
};

/// A face seen from the corner opposite its longest side.
Candidate candidate_of(const Eigen::Vector3i& face, const Particles& rest) {
  Candidate flattest{0, 0, 0, 0};
  float longest2 = -1;
  for (int corner = 0; corner < 3; ++corner) {
    const Index tip = face[corner], a = face[(corner + 1) % 3], b = face[(corner + 2) % 3];
    const float length2 = (rest.position(b) - rest.position(a)).squaredNorm();
    if (length2 > longest2) longest2 = length2, flattest = {tip, a, b, 0};
  }
  const Eigen::Vector3f side = rest.position(flattest.b) - rest.position(flattest.a);
  if (longest2 > 0)
    flattest.height = side.cross(rest.position(flattest.tip) - rest.position(flattest.a)).norm() / side.norm();
  return flattest;
}

float mean_side(const Eigen::Matrix3Xi& faces, const Particles& rest) {
  double sum = 0;
  for (const auto& face : faces.colwise())
    for (int corner = 0; corner < 3; ++corner)
      sum += (rest.position(face[(corner + 1) % 3]) - rest.position(face[corner])).norm();
  return faces.size() > 0 ? static_cast<float>(sum / static_cast<double>(faces.size())) : 0;
}

/// Columns: along the side, across it in the surface, out of the surface. False when they cannot be told apart.
bool frame_of(const SliverSet& set, const SliverTip& tip, const Particles& particles, Eigen::Matrix3f& frame) {
  const Eigen::Vector3f along = (particles.position(tip.b) - particles.position(tip.a)).stableNormalized();
  // Four numbers at once, the masses with the places.
  const auto row = [&](Index particle) {
    return Eigen::Map<const Eigen::Vector4f, Eigen::Aligned16>(particles.at(particle));
  };
  Eigen::Vector4f areas = Eigen::Vector4f::Zero();
  for (Index i = tip.begin; i < tip.end; ++i) {
    const Eigen::Vector3i& face = set.faces[static_cast<std::size_t>(i)];
    const Eigen::Vector4f corner = row(face[0]), one = row(face[1]) - corner, other = row(face[2]) - corner;
    areas += one.cross3(other);
  }
  Eigen::Vector3f out = areas.head<3>();
  out = (out - out.dot(along) * along).stableNormalized();
  frame << along, out.cross(along), out;
  return along.squaredNorm() > 0 && out.squaredNorm() > 0;
}

}  // namespace

SliverSet build_sliver_set(const Eigen::Matrix3Xi& faces, const Particles& rest, float flattest) {
  std::vector<Candidate> candidates;
  const float mean = mean_side(faces, rest);
  for (Index f = 0; f < faces.cols(); ++f) {
    const Candidate candidate = candidate_of(faces.col(f), rest);
    const float length = (rest.position(candidate.b) - rest.position(candidate.a)).norm();
    const float mobility =
        rest.inverse_mass(candidate.tip) + rest.inverse_mass(candidate.a) + rest.inverse_mass(candidate.b);
    if (candidate.height < flattest * std::max(length, mean) && mobility > 0) candidates.push_back(candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& l, const Candidate& r) { return l.height > r.height; });
  const VertexFaces vertex_faces = build_vertex_faces(faces, rest.count());

  SliverSet set;
  for (const Candidate& candidate : candidates) {
    SliverTip tip{candidate.tip, candidate.a, candidate.b};
    tip.begin = static_cast<Index>(set.faces.size());
    for (const Index end : {tip.a, tip.b})
      for (const Index f : vertex_faces.around(end))
        if ((faces.col(f).array() != tip.particle).all()) set.faces.push_back(faces.col(f));
    tip.end = static_cast<Index>(set.faces.size());
    Eigen::Matrix3f frame;
    if (!frame_of(set, tip, rest, frame)) continue;
    const Eigen::Vector3f side = rest.position(tip.b) - rest.position(tip.a),
                          from_a = rest.position(tip.particle) - rest.position(tip.a);
    tip.share = std::clamp(from_a.dot(side) / side.squaredNorm(), 0.0f, 1.0f);
    tip.offset = frame.transpose() * (from_a - tip.share * side);
    set.tips.push_back(tip);
  }
  set.groups = group_slivers(set, vertex_faces, rest);
  return set;
}

float least_ahead(const SliverTip& tip) { return 0.5f * tip.offset.tail<2>().norm(); }

void project_sliver(const SliverSet& set, const SliverTip& tip, Particles& particles) {
  Eigen::Matrix3f frame;
  if (!frame_of(set, tip, particles, frame)) return;
  const float share_of_a = 1 - tip.share;
  const Eigen::Vector3f beside = share_of_a * particles.position(tip.a) + tip.share * particles.position(tip.b);
  const Eigen::Vector2f now = frame.rightCols<2>().transpose() * (particles.position(tip.particle) - beside);
  const Eigen::Vector2f toward = tip.offset.tail<2>().stableNormalized();
  const float ahead = now.dot(toward), least = least_ahead(tip);
  const Eigen::Vector2f aside = now - ahead * toward;
  if (ahead >= least && aside.norm() <= ahead) return;
  const float kept = std::max(ahead, least);
  const Eigen::Vector2f missing = kept * toward + std::min(1.0f, kept / aside.norm()) * aside - now;
  const float longest = longest_push * (particles.position(tip.b) - particles.position(tip.a)).norm();
  const Eigen::Vector3f push = std::min(1.0f, longest / missing.norm()) * (frame.rightCols<2>() * missing);
  if (particles.inverse_mass(tip.particle) > 0) {
    particles.position(tip.particle) += push;
    return;
  }
  const float wa = particles.inverse_mass(tip.a), wb = particles.inverse_mass(tip.b);
  const float weight = limit_leverage(share_of_a * share_of_a * wa + tip.share * tip.share * wb,
                                      std::max(share_of_a * wa, tip.share * wb));
  if (!(weight > 0)) return;
  particles.position(tip.a) -= share_of_a * wa / weight * push;
  particles.position(tip.b) -= tip.share * wb / weight * push;
}

void project_slivers(const SliverSet& set, Particles& particles) {
  for (const SliverGroup& group : set.groups)
    for (std::uint32_t lost = lost_tips(group, particles); lost != 0; lost &= lost - 1)
      project_sliver(
          set, set.tips[static_cast<std::size_t>(group.members[static_cast<std::size_t>(std::countr_zero(lost))])],
          particles);
}

}  // namespace gracilis
