#pragma once

#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/run/folder_lock.hpp>
#include <gracilis/io/run/run_layout.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/run/whole_frames.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/run.hpp>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// What to do with a run that is in the folder already.
enum class ExistingRun { refuse, replace, resume };

/// The folder that a run leaves behind:
/// ```
///   run.json                       see run_manifest.hpp
///   run.pvd                        opens the animation in ParaView; always names frames that are there only
///   frames/<name>_0000.vtp         one per muscle, bone and frame, m; frame 0 has the input's bits
///                                  and tells which of a muscle's vertices are of an origin, an
///                                  insertion, and how much of a belly; where corrections were asked for, the others
///                                  tell what each kind of constraint moved a vertex by, m (correction_name)
///   shapes/0000.vtp                instead, where the run is compact: all muscles of a frame, and the bones' motions;
///   bones/<name>.vtp, paraview.py  then each bone in the capture pose, and a script that shows all in ParaView
///   measures.csv                   one row per frame and muscle; the units stand in the names of the columns
///   fiber_lengths.sto              one row per frame, see fiber_table.hpp
///   moment_arms_<coordinate>.sto, lines_of_action.sto   where they were asked for, see action_tables.hpp
///   forces.sto                     where the method knows forces, see force_table.hpp
///   fibers/<muscle>_0000.vtp       one per frame and muscle with fibers, m
///   fibers/0000.vtp                where the run is compact: all of frame 0; of others what the surfaces do not tell
///   outputs.sha256                 hashes of all files but run.json, which has that of this one, once the run
///                                  has ended
/// ```
/// and run.lock while a process writes there.
/// An interrupted run is readable: files appear whole, rows are flushed frame by frame, run.pvd follows every second.
class RunFolder {
 public:
  /// Creates the folder and locks it while this lives, and removes what killed runs left half-written. `poses` are
  /// those of all frames to come (their times and coordinates). With `resume`, what comes after the last whole frame
  /// (count_frames) is dropped, and what comes after the last that a run can go on from (resume_period), unless the run
  /// is complete. Throws ConfigurationError when there is a run already and `existing` says refuse, when there is none
  /// but a file that this one would replace and `existing` does not say so, and when another process writes there;
  /// InputError when the folder cannot be written. Scene and poses must outlive this. A run that goes on keeps its
  /// layout.
  RunFolder(std::filesystem::path folder, const Scene& scene, const std::vector<Pose>& poses, ExistingRun existing,
            RunLayout layout = RunLayout::surfaces);
  /// Writes run.pvd if it is behind; failures are lost here, call finish() to see them.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Where to go on; empty unless this was opened to resume and has two frames at least.
  const std::optional<ResumePoint>& resume_point() const { return resume_point_; }

  /// Writes all surfaces of a frame and its measures. Frames come in order, from 0 or from the one after the resume
  /// point.
  void write_frame(const FrameRecord& record);
  /// Writes run.json with the number of frames on disk and the seconds since this was opened; once the run has ended
  /// (complete or failed) also outputs.sha256 with the hashes of all its files.
  void write_manifest(RunManifest manifest) const;
  /// Writes run.pvd.
  void finish();

  const std::filesystem::path& path() const { return folder_; }  ///< of the folder
  int frame_count() const { return frame_count_; }               ///< written so far

 private:
  void write_index();
  void write_compact(const FrameRecord& record) const;
  std::vector<VertexArray> arrays_of(std::size_t muscle, const FrameRecord& record) const;
  void remove_frames() const;
  void write_fibers(const FrameRecord& record);
  void write_surfaces(const FrameRecord& record) const;
  void truncate_tables(int announced) const;

  std::filesystem::path folder_;
  RunLayout layout_;
  std::optional<FolderLock> lock_;
  const Scene& scene_;
  const std::vector<Pose>& poses_;
  int frame_count_ = 0;  ///< frames 0 ... frame_count_ - 1 are on disk
  int indexed_frames_ = 0;
  std::optional<ResumePoint> resume_point_;
  std::chrono::steady_clock::time_point opened_, indexed_;
};

/// Point data of muscles in frame 0: of an origin (0 or 1), of an insertion (0 or 1), share of belly against tendon.
inline constexpr const char* tissue_name = "origin_insertion_belly";

/// Point data of muscles whose method knows stresses: of the fibers at each vertex, Pa.
inline constexpr const char* fiber_stress_name = "fiber_stress_pa";

/// Point data of muscles in a run with corrections: what this kind of constraint moved each vertex by since the frame
/// before, m; 3 per vertex. "moved_by_bone_contact_m" of "bone contact".
std::string correction_name(const std::string& kind);

/// The muscles' shapes as recorded. Throws InputError when a file is missing, damaged or of another surface.
Frame read_frame(const std::filesystem::path& folder, const Scene& scene, int number, const Pose& pose);

}  // namespace gracilis
