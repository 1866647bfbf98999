#include "session.hpp"

#include "console.hpp"
#include "exit_handling.hpp"

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/anatomy/overlap/overlap_report.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/simulate/run.hpp>
#include <gracilis/view/charts/run_charts.hpp>
#include <gracilis/view/pictures/preview.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace gracilis {
namespace {

/// What became of the quality gates and of constraints that could not do their work, summed over frames.
struct Summary {
  struct PerMuscle {
    int frames_missed = 0;
    int first_missed = 0;
    std::string first_reason;
    std::vector<Real> sums;  ///< of the method's metrics, in their order
  };
  std::vector<MetricInfo> metrics;
  std::vector<PerMuscle> muscles = {};

  void add(const FrameRecord& record) {
    muscles.resize(record.measures.size());
    for (std::size_t i = 0; i < muscles.size(); ++i) {
      const std::vector<std::string> missed = missed_gates(record.measures[i], QualityGates{});
      if (!missed.empty() && muscles[i].frames_missed++ == 0) {
        muscles[i].first_missed = record.frame.number;
        muscles[i].first_reason = fmt::format("{}", fmt::join(missed, "; "));
      }
      if (i < record.report.muscles.size()) {
        muscles[i].sums.resize(metrics.size());
        for (std::size_t k = 0; k < metrics.size(); ++k)
          muscles[i].sums[k] += metric(record.report.muscles[i].metrics, metrics[k].name);
      }
    }
  }

  /// What constraints could not do for a muscle, as in "3 projections skipped"; empty: nothing.
  std::string trouble_of(std::size_t muscle) const {
    std::string text;
    bool any = false;
    for (std::size_t k = 0; k < muscles[muscle].sums.size(); ++k) {
      if (metrics[k].trouble.empty()) continue;
      text += fmt::format("{}{:.0f} {}", text.empty() ? "" : ", ", muscles[muscle].sums[k], metrics[k].trouble);
      any |= muscles[muscle].sums[k] > 0;
    }
    return any ? text : "";
  }

  bool all_gates_met() const {
    return std::all_of(muscles.begin(), muscles.end(), [](const PerMuscle& m) { return m.frames_missed == 0; });
  }
};

class Session {
 public:
  Session(const LoadedScene& loaded, const SessionOptions& options)
      : loaded_(loaded),
        options_(options),
        poses_(pose_sequence(loaded.scene, loaded.max_frames)),
        threads_(options.threads),
        folder_(out_folder(), loaded.scene, poses_, existing()),
        summary_{method_of(loaded.scene).metrics} {}

  int run() {
    stop_requested();  // from here on a signal ends the run, but not while a frame is written
    describe_scene();
    try {
      prepare();
    } catch (const Interrupted&) {
      write_manifest("interrupted");
      return close(RunEnd::interrupted);
    }
    write_manifest("running");
    const ResumePoint* resume = folder_.resume_point() ? &*folder_.resume_point() : nullptr;
    if (resume) spdlog::info("going on after frame {}", resume->last.number);
    RunEnd end = RunEnd::complete;
    const int last = static_cast<int>(poses_.size()) - 1;
    Progress progress(resume ? resume->last.number : 0, last);
    try {
      end = run_scene(
          loaded_.scene, poses_, *method_, resume, stop_requested(),
          [&](const FrameRecord& record) {
            folder_.write_frame(record);
            summary_.add(record);
            progress.show(record.frame.number);
          },
          &*tracker_, options_.fiber_actions);
    } catch (const QualityError& error) {
      progress.clear();
      finish(std::string("failed: ") + error.what());
      throw;
    }
    progress.clear();
    end == RunEnd::complete ? finish("complete") : drop();
    return close(end);
  }

 private:
  void prepare() {
    const StopScope scope(&stop_requested());
    overlaps_ = report_overlaps(loaded_.scene);
    for (const std::string& warning : overlap_warnings(overlaps_, keeps_surfaces_apart(loaded_.scene))) warn(warning);
    method_ =
        make_method(loaded_.scene, [this](const DistanceFieldSettings& settings) { return bone_fields(settings); });
    spdlog::info("fibers");
    const Frame capture = capture_frame(loaded_.scene, capture_pose(loaded_.scene.bodies.size()), *method_);
    tracker_.emplace(loaded_.scene, &capture);
  }

  std::filesystem::path out_folder() const {
    return options_.out.empty() ? std::filesystem::path("runs") / file_name_of(loaded_.scene.name) : options_.out;
  }

  ExistingRun existing() const {
    return options_.resume ? ExistingRun::resume : options_.force ? ExistingRun::replace : ExistingRun::refuse;
  }

  void warn(std::string text) {
    spdlog::warn("{}", text);
    warnings_.push_back(std::move(text));
  }

  void describe_scene() {
    const Scene& scene = loaded_.scene;
    spdlog::info("scene {}: {} bones, {} muscles, {} frames, preset {}", scene.name, scene.bones.size(),
                 scene.muscles.size(), poses_.size(), loaded_.preset);
    for (const Muscle& muscle : scene.muscles) {
      spdlog::info("{}: {} triangles", muscle.name, muscle.surface.face_count());
      for (const Attachment& attachment : muscle.attachments) {
        const AttachmentArea area = attachment_area(muscle.surface, attachment.vertices);
        spdlog::info("  {} '{}' on {}: {} vertices, {:.1f} cm²{}",
                     attachment.end == AttachmentEnd::origin ? "origin" : "insertion", attachment.name,
                     scene.bodies[static_cast<std::size_t>(attachment.body)], attachment.vertices.size(),
                     area.area * 1e4, attachment.guessed ? ", guessed" : "");
        if (attachment.guessed) guessed_.push_back(muscle.name + " " + attachment.name);
      }
    }
    guessed_.insert(guessed_.end(), loaded_.guessed.begin(), loaded_.guessed.end());
    for (const std::string& warning : loaded_.warnings) warn(warning);
  }

  std::vector<DistanceField> bone_fields(const DistanceFieldSettings& settings) {
    for (const Bone& bone : loaded_.scene.bones) spdlog::info("distance field of {}", bone.name);
    return cached_bone_fields(loaded_.scene, settings, [this](const std::string& warning) { warn(warning); });
  }

  /// Says per muscle what was missed, limited or skipped over the whole run.
  void summarize() {
    for (std::size_t i = 0; i < summary_.muscles.size(); ++i) {
      const Summary::PerMuscle& muscle = summary_.muscles[i];
      const std::string& name = loaded_.scene.muscles[i].name;
      if (const std::string trouble = summary_.trouble_of(i); !trouble.empty()) spdlog::info("{}: {}", name, trouble);
      if (muscle.frames_missed == 0) continue;
      warn(fmt::format("{} misses quality gates in {} frames, first in frame {}: {}", name, muscle.frames_missed,
                       muscle.first_missed, muscle.first_reason));
    }
  }

  void write_manifest(const std::string& status) const {
    RunManifest manifest;
    manifest.version = GRACILIS_VERSION;
    manifest.scene = loaded_.scene.name;
    manifest.preset = loaded_.preset;
    manifest.command = options_.command;
    manifest.settings = settings_text(loaded_.scene);
    manifest.inputs = loaded_.inputs;
    manifest.guessed = guessed_;
    manifest.warnings = warnings_;
    for (const Muscle& muscle : loaded_.scene.muscles)
      if (muscle.action_line.rays > 0) manifest.lines.emplace_back(muscle.name, muscle.action_line);
    manifest.joints = loaded_.scene.joints;
    manifest.overlaps = overlaps_;
    manifest.axes = loaded_.scene.axes;
    manifest.status = status;
    manifest.threads = thread_count();
    folder_.write_manifest(manifest);
  }

  /// Leaves what can be resumed, at once: no charts and no preview.
  void drop() {
    summarize();
    folder_.finish();
    write_manifest("interrupted");
  }

  void finish(const std::string& status) {
    summarize();
    if (const std::string remark = method_->remark(); !remark.empty()) warn(remark);
    folder_.finish();
    write_run_charts(folder_.path(), loaded_.scene);
    try {
      write_preview(folder_.path(), loaded_.scene, poses_);
    } catch (const Error& error) {
      // A run is complete without its picture, as on a machine that offers no OpenGL.
      warn(std::string("no preview: ") + error.what());
    }
    write_manifest(status);
  }

  int close(RunEnd end) const {
    if (end == RunEnd::interrupted) {
      if (folder_.frame_count() > 0)
        spdlog::warn("stopped after frame {}; --resume goes on from there", folder_.frame_count() - 1);
      else
        spdlog::warn("stopped before the first frame; --resume begins it");
      return static_cast<int>(ExitCode::interrupted);
    }
    if (options_.print_folder) fmt::print("{}\n", folder_.path().string());
    return static_cast<int>(options_.strict && !summary_.all_gates_met() ? ExitCode::quality : ExitCode::done);
  }

  const LoadedScene& loaded_;
  const SessionOptions& options_;
  std::vector<Pose> poses_;
  ThreadLimit threads_;
  RunFolder folder_;
  Summary summary_;
  OverlapReport overlaps_;
  std::optional<FiberTracker> tracker_;
  std::unique_ptr<DeformationMethod> method_;
  std::vector<std::string> warnings_, guessed_;
};

}  // namespace

void add_session_options(CLI::App& command, SessionOptions& options) {
  command.add_option("--out", options.out, "Run folder to write (default: runs/NAME of the scene)");
  command.add_option("--threads", options.threads, "Threads to use; 0 takes all. Results do not depend on it")
      ->check(CLI::Range(0, 1024));
  CLI::Option* resume =
      command.add_flag("--resume", options.resume, "Go on where the run in the folder was interrupted");
  command.add_flag("--force", options.force, "Replace the run that is in the folder")->excludes(resume);
  command.add_flag("--strict", options.strict, "Exit with code 5 when a frame misses a quality gate");
}

int run_session(const LoadedScene& loaded, const SessionOptions& options) { return Session(loaded, options).run(); }

}  // namespace gracilis
