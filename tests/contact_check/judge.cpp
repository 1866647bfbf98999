#include "judge.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gracilis::contact_check {

static constexpr Real deep = 0.2e-3;  // m

static std::vector<Solid> solids_of(const std::vector<TriangleMesh>& surfaces) {
  std::vector<Solid> solids(surfaces.size());
  tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t s) { solids[s] = Solid(surfaces[s]); });
  return solids;
}

static std::vector<Index> with_an_end_inside(const Edges& edges, const Eigen::VectorXd& depths) {
  std::vector<Index> inside;
  for (Index e = 0; e < static_cast<Index>(edges.size()); ++e) {
    const IndexPair& ends = edges[static_cast<std::size_t>(e)];
    if (depths[ends[0]] > 0 || depths[ends[1]] > 0) inside.push_back(e);
  }
  return inside;
}

Judge::Judge(std::vector<JudgedMuscle> muscles, std::vector<JudgedBone> bones)
    : muscles_(std::move(muscles)), bones_(std::move(bones)), rest_(muscles_.size()) {
  std::vector<TriangleMesh> muscles_at_rest, bones_at_rest;
  for (const JudgedMuscle& muscle : muscles_) muscles_at_rest.push_back(muscle.rest);
  for (const JudgedBone& bone : bones_) bones_at_rest.push_back(bone.rest);
  const std::vector<Solid> solids = solids_of(muscles_at_rest), bone_solids = solids_of(bones_at_rest);
  for (Index a = 0; a < static_cast<Index>(muscles_.size()); ++a)
    for (Index b = a + 1; b < static_cast<Index>(muscles_.size()); ++b) pairs_.push_back({a, b, 0});
  tbb::parallel_for(std::size_t{0}, muscles_.size(), [&](std::size_t m) {
    const TriangleMesh& mesh = muscles_[m].rest;
    MuscleRest& rest = rest_[m];
    rest.edges = edges_of(mesh);
    rest.dihedrals = dihedrals_of(mesh);
    for (const Dihedral& dihedral : rest.dihedrals) rest.angles.push_back(dihedral_angle_of(dihedral, mesh.vertices));
    rest.volume = enclosed_volume(mesh.vertices, mesh.faces);
    rest.self_pairs = static_cast<Index>(self_intersecting_faces(mesh).size());
    for (std::size_t b = 0; b < bones_.size(); ++b) {
      rest.bone_edges.push_back(crossing_edges(mesh.vertices, rest.edges, bones_[b].rest));
      rest.forgiven_edges.push_back(with_an_end_inside(rest.edges, bone_solids[b].depths(mesh.vertices)));
      std::vector<Index>& forgiven = rest.forgiven_edges.back();
      forgiven.insert(forgiven.end(), rest.bone_edges.back().begin(), rest.bone_edges.back().end());
      std::sort(forgiven.begin(), forgiven.end());
    }
    for (std::size_t other = 0; other < muscles_.size(); ++other)
      rest.depths.push_back((other == m ? Solid() : solids[other]).depths(mesh.vertices));
  });
  tbb::parallel_for(std::size_t{0}, pairs_.size(), [&](std::size_t p) {
    const auto& rest = [&](Index m) -> const TriangleMesh& { return muscles_[static_cast<std::size_t>(m)].rest; };
    pairs_[p].face_pairs = static_cast<Index>(intersecting_faces(rest(pairs_[p].first), rest(pairs_[p].second)).size());
  });
}

Index Judge::vertex_count() const {
  Index count = 0;
  for (const JudgedMuscle& muscle : muscles_) count += muscle.rest.vertex_count();
  return count;
}

Index Judge::dihedral_count() const {
  std::size_t count = 0;
  for (const MuscleRest& rest : rest_) count += rest.dihedrals.size();
  return static_cast<Index>(count);
}

static Vec3 face_center(const TriangleMesh& mesh, Index face) {
  return mesh.vertices(Eigen::all, mesh.faces.col(face)).rowwise().mean();
}

PairVerdict Judge::judge_pair(const PairRest& pair, const std::vector<TriangleMesh>& now,
                              const std::vector<Solid>& solids) const {
  PairVerdict verdict;
  verdict.first = pair.first, verdict.second = pair.second;
  verdict.face_pairs_rest = pair.face_pairs;
  const auto one = static_cast<std::size_t>(pair.first), other = static_cast<std::size_t>(pair.second);
  const std::vector<IndexPair> found = intersecting_faces(now[one], now[other]);
  verdict.face_pairs = static_cast<Index>(found.size());
  for (const IndexPair& faces : found)
    verdict.faces_at += face_center(muscles_[one].rest, faces[0]) / static_cast<Real>(found.size());
  const auto add_depths = [&](std::size_t in, std::size_t of) {
    const Eigen::VectorXd depths = solids[in].depths(now[of].vertices);
    const Eigen::VectorXd& rest = rest_[of].depths[in];
    verdict.depth = std::max(verdict.depth, depths.maxCoeff());
    verdict.depth_rest = std::max(verdict.depth_rest, rest.maxCoeff());
    Index vertex = 0;
    const Real most = (depths - rest).maxCoeff(&vertex);
    if (most > verdict.depth_beyond_rest) {
      verdict.depth_beyond_rest = most;
      verdict.deepest_at = muscles_[of].rest.vertices.col(vertex);
    }
    verdict.deep_vertices += static_cast<Index>(((depths - rest).array() > deep).count());
  };
  add_depths(one, other);
  add_depths(other, one);
  return verdict;
}

MuscleVerdict Judge::judge_muscle(std::size_t muscle, const TriangleMesh& now,
                                  const std::vector<TriangleMesh>& bones) const {
  const MuscleRest& rest = rest_[muscle];
  const TriangleMesh& rest_mesh = muscles_[muscle].rest;
  const std::vector<char>& attached = muscles_[muscle].attached;
  MuscleVerdict verdict;
  verdict.volume_ratio = enclosed_volume(now.vertices, now.faces) / rest.volume;

  const std::vector<IndexPair> self = self_intersecting_faces(now);
  verdict.self_pairs = static_cast<Index>(self.size());
  verdict.self_pairs_rest = rest.self_pairs;
  for (const IndexPair& faces : self)
    verdict.self_at += face_center(rest_mesh, faces[0]) / static_cast<Real>(self.size());

  for (std::size_t h = 0; h < rest.dihedrals.size(); ++h) {
    const Dihedral& dihedral = rest.dihedrals[h];
    if (turned_by(dihedral_angle_of(dihedral, now.vertices), rest.angles[h]) <= pi / 2 || std::isnan(rest.angles[h]))
      continue;
    ++verdict.folded_dihedrals;
    verdict.folded_at += (rest_mesh.vertices.col(dihedral.start) + rest_mesh.vertices.col(dihedral.end)) / 2;
  }
  if (verdict.folded_dihedrals > 0) verdict.folded_at /= static_cast<Real>(verdict.folded_dihedrals);

  const auto free_ends = [&](Index edge) {
    const IndexPair& ends = rest.edges[static_cast<std::size_t>(edge)];
    return (attached[static_cast<std::size_t>(ends[0])] ? 0 : 1) +
           (attached[static_cast<std::size_t>(ends[1])] ? 0 : 1);
  };
  const auto count_free = [&](const std::vector<Index>& edges) {
    return static_cast<Index>(std::count_if(edges.begin(), edges.end(), [&](Index e) { return free_ends(e) > 0; }));
  };
  Index most = 0;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const std::vector<Index> crossing = crossing_edges(now.vertices, rest.edges, bones[b]);
    std::vector<Index> fresh;
    std::set_difference(crossing.begin(), crossing.end(), rest.forgiven_edges[b].begin(), rest.forgiven_edges[b].end(),
                        std::back_inserter(fresh));
    std::erase_if(fresh, [&](Index edge) { return free_ends(edge) == 0; });
    const auto count = static_cast<Index>(fresh.size());
    if (count > most) most = count, verdict.bone = bones_[b].name;
    verdict.bone_edges += count;
    verdict.bone_edges_all += count_free(crossing);
    verdict.bone_edges_all_rest += count_free(rest.bone_edges[b]);
    for (const Index edge : fresh) {
      const IndexPair& ends = rest.edges[static_cast<std::size_t>(edge)];
      if (free_ends(edge) == 2) ++verdict.bone_edges_unattached;
      verdict.bone_at += (rest_mesh.vertices.col(ends[0]) + rest_mesh.vertices.col(ends[1])) / 2;
    }
  }
  if (verdict.bone_edges > 0) verdict.bone_at /= static_cast<Real>(verdict.bone_edges);
  return verdict;
}

FrameVerdict Judge::judge(int number, const std::vector<Points>& muscles, const std::vector<Points>& bones) const {
  FrameVerdict verdict;
  verdict.number = number;
  std::vector<TriangleMesh> now, bones_now;
  for (std::size_t m = 0; m < muscles_.size(); ++m) now.push_back({muscles[m], muscles_[m].rest.faces});
  for (std::size_t b = 0; b < bones_.size(); ++b) bones_now.push_back({bones[b], bones_[b].rest.faces});
  for (const TriangleMesh& mesh : now) verdict.finite = verdict.finite && mesh.vertices.allFinite();
  if (!verdict.finite) return verdict;
  const std::vector<Solid> solids = solids_of(now);
  verdict.pairs.resize(pairs_.size());
  verdict.muscles.resize(muscles_.size());
  tbb::parallel_for(std::size_t{0}, pairs_.size() + muscles_.size(), [&](std::size_t task) {
    if (task < muscles_.size())
      verdict.muscles[task] = judge_muscle(task, now[task], bones_now);
    else
      verdict.pairs[task - muscles_.size()] = judge_pair(pairs_[task - muscles_.size()], now, solids);
  });
  return verdict;
}

}  // namespace gracilis::contact_check
