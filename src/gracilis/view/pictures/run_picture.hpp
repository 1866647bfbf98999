#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/view/pictures/color_scale.hpp>
#include <gracilis/view/pictures/correction_arrows.hpp>
#include <gracilis/view/pictures/evened_surface.hpp>
#include <gracilis/view/pictures/force_arrows.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/pictures/picture.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>
#include <gracilis/view/pictures/vertex_stretch.hpp>

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

struct RunPictureOptions {
  std::string view;  ///< empty: as the run's preview looks, or lateral where that is not known
  Real turn = 0;     ///< rad, by which the camera goes around the subject from there, counterclockwise seen from above
  Real tilt = 0;     ///< rad, by which it then rises; within a quarter turn
  ColorBy color_by = ColorBy::natural;
  bool fibers = false;               ///< with muscles that one sees through; fiber_strain and tension show them anyway
  Real opacity = 1;                  ///< of muscles
  std::vector<std::string> muscles;  ///< to show; empty: all
  std::vector<std::string> bones;    ///< to show; empty: all
  std::vector<std::string> hidden;   ///< muscles and bones that are not shown
  bool without_bones = false;
  std::string focus;  ///< what fills the picture: a muscle, a bone, or MUSCLE:origin, :insertion; empty: everything
  Real zoom = 1;
  Real arrow_scale = 0;  ///< m per N, of forces at muscles' ends, which one sees through then; 0: no arrows
  CorrectionArrowSize corrections = {};  ///< of arrows for what constraints moved
};

/// anterior, posterior, lateral, medial, superior, inferior, and anteromedial ... posterolateral.
const std::vector<std::string>& view_names();

/// Where the camera stands, seen from the body; unit. Lateral is the side that most of the run's muscles are named for
/// (_r or _l). Precondition: `view` is one of view_names().
Vec3 view_direction(const RecordedRun& run, const std::string& view);

/// The first of the frames from `first` on, half way, and the farthest pose, as in a run's preview.
std::vector<int> telling_frames(const RecordedRun& run, int first = 0);

/// Draws any frame of a run. Throws InputError when a frame is damaged.
class RunPainter {
 public:
  /// Throws ConfigurationError when the options name what the run does not have, or color by what it does not know. The
  /// run must outlive this.
  RunPainter(const RecordedRun& run, RunPictureOptions options);

  /// Of one frame. Throws as recorded_surface where the run lacks something.
  Panel panel(int frame) const;
  /// Two corners of the room that the run takes from a frame on, as the camera sees it: of some frames.
  Points room(int first = 0) const;
  /// m: the diagonal of what is framed, in the capture pose, as large as it is drawn.
  Real extent() const;

  /// The least and largest value that panels have shown by color so far.
  std::pair<Real, Real> values_seen() const { return seen_; }

 private:
  Color color_of(Real value) const;
  bool shows_values() const { return options_.color_by != ColorBy::muscle && options_.color_by != ColorBy::natural; }
  /// Colors and arrows that tell values stand where these were measured.
  bool evens() const { return !shows_values() && !draws_arrows(); }
  bool draws_arrows() const { return options_.arrow_scale > 0 || options_.corrections.times > 0; }
  bool framed(const std::string& name) const { return focus_.empty() || focus_ == name; }
  /// Of what is framed: all of a surface, or the end of a muscle that is in focus.
  Points framed_points(const std::string& name, int frame) const;
  std::vector<std::string> framed_names() const;
  void find_focus();
  Points vertex_colors(std::size_t muscle, const TriangleMesh& mesh, int frame) const;
  PaintedLines fibers(std::size_t muscle, int frame) const;
  bool shown(const std::string& name) const;
  void require_names() const;

  const RecordedRun& run_;
  RunPictureOptions options_;
  CaptionedFrames captions_;
  std::string focus_;             ///< a muscle or bone; empty: everything
  std::vector<Index> focus_end_;  ///< its vertices that are in focus; empty: all
  mutable std::pair<Real, Real> seen_{std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()};
  std::vector<TriangleMesh> bones_;         ///< at rest
  std::set<std::string> solids_;            ///< bones and muscles that are closed
  std::vector<SignedDistance> distances_;   ///< per bone, where colors need them
  std::vector<MuscleLook> looks_;           ///< per muscle, where colors need them
  std::vector<EvenedSurface> evened_;       ///< per muscle, where surfaces are evened
  std::vector<VertexStretch> stretches_;    ///< per muscle, where colors need them
  std::vector<std::vector<Real>> lengths_;  ///< per muscle and fiber at rest, m
  std::optional<ForceArrows> arrows_;
  std::vector<Eigen::MatrixXd> tensions_;  ///< per muscle: frames × fibers, N, where colors need them
};

/// Frames of one or several runs: a row per run, a column per frame of the first one; other runs show the frame in the
/// most similar pose. With a legend or a color bar, and a scale bar.
Picture run_picture(const std::vector<RecordedRun>& runs, const std::vector<RunPainter>& painters,
                    const std::vector<int>& frames, const RunPictureOptions& options);

}  // namespace gracilis
