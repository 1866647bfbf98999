#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/run/compact_frames.hpp>
#include <gracilis/io/run/run_layout.hpp>
#include <gracilis/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// A run folder as it was written, without the scene behind it: what reports, pictures and exports are made from.
struct RecordedRun {
  std::filesystem::path folder;
  RunLayout layout = RunLayout::surfaces;
  std::shared_ptr<const CompactShapes> compact_shapes;             ///< null: a file per surface has them
  std::shared_ptr<const CompactFibers> compact_fibers;             ///< null: files have them
  nlohmann::ordered_json manifest;                                 ///< run.json
  AnatomicalAxes axes;                                             ///< how the subject stands in the frames
  Vec3 preview_looking = Vec3::Zero(), preview_up = Vec3::Zero();  ///< of the preview's camera; zero: not known
  std::vector<std::string> muscles;                                ///< in the scene's order
  std::vector<std::string> bones;                                  ///< all other surfaces, sorted
  std::map<std::string, Index> vertex_counts;                      ///< of muscles and bones, in every frame
  Vec3 place = Vec3::Zero();                                       ///< about where it lies (scene/scene_place.hpp)
  int frame_count = 0;                   ///< frames 0 ... frame_count - 1 are there for every surface and measured
  int first_motion_frame = 0;            ///< those before it lead from the capture pose to the motion (the ramp)
  std::vector<Real> times;               ///< s, per frame
  std::vector<std::string> coordinates;  ///< with their units, as in hip_flexion_r_deg
  Eigen::MatrixXd coordinate_values;     ///< frames × coordinates
  std::vector<std::string> measures;     ///< columns of measures.csv that come after the muscle
  std::vector<Eigen::MatrixXd> values;   ///< per measure: frames × muscles; nan where a cell is empty
};

/// Throws InputError when the folder holds no run, or its measures or frames are damaged.
RecordedRun open_recorded_run(const std::filesystem::path& folder);

/// One measure, frames × muscles; empty when the run does not have it.
Eigen::MatrixXd measure_of(const RecordedRun& run, const std::string& measure);

/// A surface in one frame, m. Throws InputError.
TriangleMesh recorded_surface(const RecordedRun& run, const std::string& name, int frame);

/// A muscle's fibers in one frame, m; none when the run has none of it.
Polylines recorded_fibers(const RecordedRun& run, const std::string& muscle, int frame);

/// The same about the run's place, for what is drawn or written in single precision.
TriangleMesh placed_surface(const RecordedRun& run, const std::string& name, int frame);
/// As placed_surface, of a muscle's fibers.
Polylines placed_fibers(const RecordedRun& run, const std::string& muscle, int frame);

/// Throws InputError unless a surface of the run has so many vertices, as it has in frame 0.
void require_count(const RecordedRun& run, const std::string& name, int frame, Eigen::Index count);

/// The file that holds a muscle in a frame. Throws InputError.
std::shared_ptr<const VtpFile> file_of_muscle(const RecordedRun& run, const std::string& muscle, int frame);

/// Per vertex of a muscle: 1 where it is of an origin, 1 where of an insertion, share of belly against tendon (0 to 1).
/// 3 × 0 when the run was made before runs told it.
Points recorded_tissue(const RecordedRun& run, const std::string& muscle);

/// Per vertex of a muscle in a frame: the stress of its fibers, Pa; none when the run knows none.
Eigen::VectorXd recorded_fiber_stresses(const RecordedRun& run, const std::string& muscle, int frame);

/// Per muscle, frame and fiber: its tension, N; 0 × 0 where the run knows none.
std::vector<Eigen::MatrixXd> recorded_tensions(const RecordedRun& run);

/// The coordinate that changes most over the run, as an index; -1 when there is none.
int main_coordinate(const RecordedRun& run);

/// The frame of `other` whose coordinates are nearest to those of a frame of `run`; of several, the one as far through.
int nearest_pose(const RecordedRun& run, int frame, const RecordedRun& other);

/// 0 ... count - 1, thinned to at most `most` at equal distances; the first and the last stay. Precondition: most >= 2.
std::vector<int> spread_frames(int count, int most);

/// "hip_flexion_r_deg" becomes name "hip_flexion_r" and unit "°".
struct CoordinateLabel {
  std::string name, unit;
};
/// Of a column of coordinates; a column without a known unit keeps its name.
CoordinateLabel coordinate_label(const std::string& column);

}  // namespace gracilis
