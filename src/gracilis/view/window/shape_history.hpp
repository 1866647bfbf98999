#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// Points as they are drawn, m.
using ShownPoints = Eigen::Matrix3Xf;

/// What of a body a vertex of a muscle holds on to.
enum class HeldAt : std::uint8_t { nothing, origin, insertion };

/// What a window shows of a scene or a run and what never changes about it. Surfaces are thinned for drawing; entries
/// are per muscle or per bone, and then per vertex of the thinned surface.
struct ShownShapes {
  std::string title;
  AnatomicalAxes axes;
  bool left_side = false;  ///< lateral is the subject's left
  std::vector<std::string> muscles, bones;
  std::vector<Eigen::Matrix3Xi> muscle_faces, bone_faces;
  std::vector<ShownPoints> bone_points;            ///< at rest
  std::vector<std::vector<HeldAt>> held;           ///< of muscles; an empty entry: nobody knows
  std::vector<std::vector<float>> belly;           ///< of muscles: 0 tendon to 1 belly; an empty entry: nobody knows
  std::vector<std::vector<Color>> natural;         ///< of muscles: what they look like, see MuscleLook
  std::vector<std::vector<Real>> stripes;          ///< of muscles: m across the fibers
  std::vector<std::vector<Index>> vertex_numbers;  ///< of muscles: which vertices of the whole surface are shown
  std::vector<std::vector<Index>> arrow_roots;     ///< of muscles: evenly spread vertices
};

/// What one kind of constraint moved in one pass of the solver, at a muscle's arrow roots.
struct ShownPass {
  std::size_t muscle = 0;
  std::string_view kind;  ///< of constraint
  int iteration = 0;
  ShownPoints moved;  ///< 3 × roots, m
};

/// One instant. Entries are per muscle, unless they say otherwise.
struct ShownFrame {
  std::string caption;
  std::vector<ShownPoints> muscles;
  std::vector<std::vector<float>> stretch;        ///< per vertex, × rest
  std::vector<std::vector<float>> stress;         ///< per vertex, of fibers, Pa; an empty entry: nobody knows
  std::vector<std::vector<float>> contact_depth;  ///< per vertex, m, see contact_depth.hpp; empty: not asked for
  std::vector<RigidTransform> bones;              ///< per bone, from rest
  std::vector<Polylines> fibers;                  ///< some of them, m
  std::vector<std::vector<Real>> strain;          ///< per fiber, length × rest
  std::vector<std::vector<Real>> tension;         ///< per fiber, N; an empty entry: nobody knows
  std::vector<Real> activation, volume;           ///< volume × rest
  std::vector<ShownPass> passes;                  ///< in their order; empty: not asked for
  Real milliseconds = 0;                          ///< that the solver took for all muscles
};

/// What costs time and is made only while somebody looks at it.
struct ViewRequests {
  std::atomic<bool> contact_depth = false, passes = false, tension = false;
  std::atomic<int> frame = 0;  ///< the one that is looked at
};

/// Frames as they come, from a disk or from a simulation, for a window that must not wait for them. All functions may
/// be called from any thread.
class ShapeHistory {
 public:
  /// Keeps the last `capacity` frames.
  explicit ShapeHistory(int capacity = 1 << 30) : capacity_(capacity) {}

  /// The next frame; beyond the capacity the first one goes.
  void append(ShownFrame frame);
  /// In place of a frame that is kept; nothing happens when it no longer is.
  void replace(int number, ShownFrame frame);
  /// Of a frame that is kept.
  void forget_passes(int number);
  /// The frames begin() ... end() - 1 are kept.
  int begin() const;
  /// See begin.
  int end() const;
  /// That frame, or the nearest that is kept. Precondition: there is one.
  std::shared_ptr<const ShownFrame> at(int number) const;

  ViewRequests requests;

 private:
  const int capacity_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const ShownFrame>> frames_;
  int begin_ = 0;
};

}  // namespace gracilis
