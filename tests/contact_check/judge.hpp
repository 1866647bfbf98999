#pragma once

#include "containment.hpp"
#include "folding.hpp"
#include "intersections.hpp"

#include <string>
#include <vector>

/// The judge of what must hold between muscles and bones in every frame. It sees shapes only and shares no code with
/// the solver that made them.
namespace gracilis::contact_check {

/// A muscle in the capture pose ("rest").
struct JudgedMuscle {
  std::string name;
  TriangleMesh rest;
  std::vector<char> attached;  ///< per vertex: fixed to a bone
};

struct JudgedBone {
  std::string name;
  TriangleMesh rest;
};

/// Two muscles in one frame. What lies where is told in the capture pose, m.
struct PairVerdict {
  Index first = 0, second = 0;  ///< muscles, first < second
  Index face_pairs = 0, face_pairs_rest = 0;
  Vec3 faces_at = Vec3::Zero();    ///< mean of the first's intersecting faces
  Real depth = 0, depth_rest = 0;  ///< m, deepest vertex of one in the other
  Real depth_beyond_rest = 0;      ///< m, deepest beyond what that vertex has at rest
  Index deep_vertices = 0;         ///< deeper than 0.2 mm beyond rest
  Vec3 deepest_at = Vec3::Zero();  ///< the vertex deepest beyond rest
  Index excess() const { return face_pairs - face_pairs_rest; }
};

/// One muscle in one frame.
struct MuscleVerdict {
  Index self_pairs = 0, self_pairs_rest = 0;
  Vec3 self_at = Vec3::Zero();  ///< mean of the faces
  Index bone_edges = 0;         ///< edges with a free end that cross a bone they neither crossed nor entered at rest
  Index bone_edges_unattached = 0;                    ///< those of them with two free ends
  Index bone_edges_all = 0, bone_edges_all_rest = 0;  ///< with a free end, whether they crossed at rest or not
  std::string bone;                                   ///< the bone with most of bone_edges
  Vec3 bone_at = Vec3::Zero();                        ///< mean of bone_edges' middles
  Index folded_dihedrals = 0;                         ///< turned by more than 90 degrees, or without an angle
  Vec3 folded_at = Vec3::Zero();
  Real volume_ratio = 1;
  Index self_excess() const { return self_pairs - self_pairs_rest; }
};

struct FrameVerdict {
  int number = 0;
  bool finite = true;  ///< when not, nothing else is judged
  std::vector<PairVerdict> pairs;
  std::vector<MuscleVerdict> muscles;
};

class Judge {
 public:
  /// Every muscle's `attached` has one entry per vertex.
  Judge(std::vector<JudgedMuscle> muscles, std::vector<JudgedBone> bones);

  /// Judges a frame: points of the muscles and bones (m) in the order given to the constructor, as many as at rest.
  FrameVerdict judge(int number, const std::vector<Points>& muscles, const std::vector<Points>& bones) const;

  const std::vector<JudgedMuscle>& muscles() const { return muscles_; }
  const std::vector<JudgedBone>& bones() const { return bones_; }
  Index vertex_count() const;    ///< of all muscles
  Index dihedral_count() const;  ///< of all muscles

 private:
  struct MuscleRest {
    Edges edges;
    std::vector<Dihedral> dihedrals;
    std::vector<Real> angles;
    Real volume = 0;
    Index self_pairs = 0;
    std::vector<std::vector<Index>> bone_edges;      ///< per bone, ascending
    std::vector<std::vector<Index>> forgiven_edges;  ///< per bone: those that cross it and those with an end in it
    std::vector<Eigen::VectorXd> depths;             ///< per other muscle: each vertex's depth in it
  };
  struct PairRest {
    Index first = 0, second = 0, face_pairs = 0;
  };

  PairVerdict judge_pair(const PairRest& pair, const std::vector<TriangleMesh>& now,
                         const std::vector<Solid>& solids) const;
  MuscleVerdict judge_muscle(std::size_t muscle, const TriangleMesh& now, const std::vector<TriangleMesh>& bones) const;

  std::vector<JudgedMuscle> muscles_;
  std::vector<JudgedBone> bones_;
  std::vector<MuscleRest> rest_;
  std::vector<PairRest> pairs_;
};

}  // namespace gracilis::contact_check
