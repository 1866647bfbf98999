#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/belly_place.hpp>
#include <gracilis/simulate/gates.hpp>
#include <gracilis/simulate/muscle_depths.hpp>
#include <gracilis/simulate/surface_flaws.hpp>
#include <gracilis/simulate/way_measures.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace gracilis {

/// How good one muscle's shape is, against the capture pose; the measures of the field's literature (Cervenka and
/// Kohout 2020) and exact depths in the bones.
struct MuscleMeasures {
  Real volume_ratio = 1;
  Real edge_ratio_mean = 1;  ///< mean of length over length at rest
  Real edge_ratio_max = 1;
  Real edge_ratio_max_free = 1;                  ///< over edges farther from attachments than 15 mm at rest
  Real edge_ratio_max_near = 1;                  ///< over the others, see SurfaceFlaws::edge_ratio
  Real spike = 0, thickening = 1, thinning = 1;  ///< see SurfaceFlaws
  Real dihedral_change_mean = 0;                 ///< rad, mean of |θ - θ_rest|
  Real dihedral_change_max = 0;
  Index dihedrals_over_90 = 0;          ///< dihedrals turned by more than 90 degrees
  Real vertex_depth = 0;                ///< m, deepest free vertex in a bone
  Real vertex_depth_beyond_rest = 0;    ///< m, deepest beyond that vertex's depth in that bone at rest
  Real midpoint_depth_beyond_rest = 0;  ///< m, the same for midpoints of edges with a free end
  Real muscle_depth_beyond_rest = 0;    ///< m, see MuscleDepths; 0 where muscles are not kept out of each other
  std::string deepest_in = {};  ///< the muscle that it lies so deep in; empty where it lies in none, or is not known
  Real belly_off_place = 0;     ///< m, see BellyPlace
  Real wrong_side = 0;          ///< share of the muscle's lines, see is_on_wrong_side
  Real slack = 0;               ///< mean over the muscle's lines, see slack_of
  bool finite = true;
  MeasureLevel level = MeasureLevel::full;  ///< what of this was measured; the rest is as at rest
};

/// Measures frames of one scene. Shares no code with the solver: exact nearest triangles instead of grids, double
/// precision.
class Measurer {
 public:
  /// With `tracker`, a muscle's way is measured along some of the fibers that it follows, otherwise along a few of its
  /// own, which takes longer to prepare. Both must outlive this.
  explicit Measurer(const Scene& scene, const FiberTracker* tracker = nullptr, MeasureLevel level = MeasureLevel::full);
  Measurer(const Measurer&) = delete;
  Measurer& operator=(const Measurer&) = delete;

  /// Measures one frame. Remembers where points were last measured, so frames in order are cheap, and the poses that it
  /// went through, for the side on which taut ways pass the bones. `fibers` are what the tracker says of the frame; it
  /// is asked where they are not given.
  std::vector<MuscleMeasures> measure(const Frame& frame, const std::vector<MuscleFibers>& fibers = {});
  /// Goes through the pose of a frame that was measured before, as a run that goes on does: what comes after is
  /// measured as if this had measured them all.
  void pass(const Pose& pose) {
    if (ways_) ways_->follow(pose);
  }

 private:
  struct MuscleRest {
    std::vector<MeshEdge> edges;
    std::vector<Real> lengths, angles;
    std::vector<char> far_edge;                       ///< farther from attachments than 15 mm
    std::vector<Index> free_vertices;                 ///< that are not attached
    std::vector<std::pair<Index, Index>> free_edges;  ///< the ends of those that are not attached with both
    Real volume = 0;
    SurfaceFlaws flaws;
    Eigen::MatrixXd vertex_depth, midpoint_depth;  ///< free vertices (edges) × bones, m, 0 outside
  };

  /// Where a point was, in the bone's frame, and how far from the bone: until it has moved that far it cannot be
  /// inside.
  struct LastSeen {
    Points points;
    Eigen::VectorXd clearances;  ///< m
  };

  MuscleRest rest_of(const Muscle& muscle, std::vector<LastSeen>& last) const;
  Eigen::VectorXd depths_in(std::size_t bone, const Points& points, LastSeen& last) const;
  void measure_depths(const MuscleRest& rest, const Points& points, const Pose& pose, std::vector<LastSeen>& last,
                      MuscleMeasures& measures) const;

  MuscleMeasures measure_shape(std::size_t muscle, const Points& x, const Pose& pose);
  void measure_muscle_depths(const Frame& frame, std::vector<MuscleMeasures>& measures) const;
  void measure_places(const Frame& frame, const std::vector<MuscleFibers>& fibers,
                      std::vector<MuscleMeasures>& measures);

  const Scene& scene_;
  MeasureLevel level_;
  std::vector<SignedDistance> bones_;  ///< these and what follows are there where depths and places are measured
  std::vector<Eigen::AlignedBox3d> bone_boxes_;  ///< in the capture pose
  std::optional<MuscleDepths> muscle_depths_;    ///< where the method keeps muscles out of each other
  std::optional<WayMeasures> ways_;
  std::optional<BellyPlace> bellies_;  ///< looks at the ways
  std::vector<MuscleRest> muscles_;
  std::vector<std::vector<LastSeen>> last_;  ///< per muscle: of vertices, then of midpoints, per bone
};

}  // namespace gracilis
