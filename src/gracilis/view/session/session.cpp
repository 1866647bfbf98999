#include <gracilis/view/session/session.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/anatomy/overlap/overlap_report.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/measures_table.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/scene/section_line.hpp>
#include <gracilis/simulate/run.hpp>
#include <gracilis/view/charts/run_charts.hpp>
#include <gracilis/view/pictures/preview.hpp>
#include <gracilis/view/session/session_summary.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace gracilis {
namespace {

std::filesystem::path session_folder(const LoadedScene& loaded, const SessionOptions& options) {
  return options.out.empty() ? std::filesystem::path("runs") / file_name_of(loaded.scene.name) : options.out;
}

std::vector<Pose> recorded_of(const std::vector<Pose>& poses, const std::vector<int>& numbers) {
  std::vector<Pose> some;
  for (const int number : numbers) some.push_back(poses[static_cast<std::size_t>(number)]);
  return some;
}

class Session {
 public:
  Session(const LoadedScene& loaded, const SessionOptions& options, RunPlan plan, const SessionListener& listener)
      : loaded_(loaded),
        options_(options),
        listener_(listener),
        stop_(listener.stop_or_never()),
        plan_(std::move(plan)),
        poses_(pose_sequence(loaded.scene, loaded.max_frames)),
        recorded_poses_(plan_.recorded.empty() ? poses_ : recorded_of(poses_, plan_.recorded)),
        threads_(options.threads),
        folder_(session_folder(loaded, options), loaded.scene, recorded_poses_, existing(), plan_.layout),
        summary_(loaded.scene, options.measures) {}

  SessionResult run() {
    describe_scene();
    try {
      prepare();
    } catch (const Interrupted&) {
      write_manifest("interrupted");
      return close(RunEnd::interrupted);
    }
    write_manifest("running");
    const ResumePoint* resume = folder_.resume_point() ? &*folder_.resume_point() : nullptr;
    if (resume) go_on_after(resume->last.number);
    RunEnd end = RunEnd::complete;
    const int last = plan_.frames - 1, first = first_ = resume ? resume->last.number : 0;
    began_ = timed_from_ = std::chrono::steady_clock::now();
    if (listener_.begin) listener_.begin(first, last);
    try {
      end = run_scene(loaded_.scene, poses_, *method_, resume, stop_,
                      [&](const FrameRecord& record) {
                        folder_.write_frame(record);
                        summary_.add(record);
                        if (listener_.progress) listener_.progress(record.frame.number, last);
                        say_how_long(record.frame.number - first, last - record.frame.number);
                      },
                      tracker_ ? &*tracker_ : nullptr,
                      {options_.fiber_actions, options_.measures, plan_.recorded, options_.corrections});
    } catch (const Interrupted&) {
      end = RunEnd::interrupted;
    } catch (const QualityError& error) {
      finish(std::string("failed: ") + error.what());
      throw;
    }
    if (end == RunEnd::complete) {
      keep_frame_time();
      finish("complete");
    } else {
      drop();
    }
    return close(end);
  }

 private:
  void detail(const std::string& text) const { listener_.tell(MessageKind::detail, text); }
  void note(const std::string& text) const { listener_.tell(MessageKind::note, text); }
  void caution(const std::string& text) const { listener_.tell(MessageKind::warning, text); }

  void prepare() {
    const StopScope scope(&stop_);
    overlaps_ = report_overlaps(loaded_.scene);
    for (const std::string& warning : overlap_warnings(overlaps_)) warn(warning);
    method_ =
        make_method(loaded_.scene, [this](const DistanceFieldSettings& settings) { return bone_fields(settings); });
    if (options_.corrections) require_passes(*method_);
    if (options_.without_fibers) return;
    note("fibers");
    const Frame capture = capture_frame(loaded_.scene, capture_pose(loaded_.scene.bodies.size()), *method_);
    tracker_.emplace(loaded_.scene, &capture);
  }

  /// What is said of a run in the end is of all its frames.
  void go_on_after(int frame) {
    note(fmt::format("going on after frame {}", frame));
    read_measures(folder_.path() / "measures.csv", loaded_.scene, frame + 1,
                  [this](const FrameRecord& record) { summary_.add(record); });
  }

  /// How long a run takes is known once a frame is done, and better once ten are; told where it is worth waiting
  /// otherwise, and again where the first frame was no good guide.
  void say_how_long(int done, int left) {
    const auto now = std::chrono::steady_clock::now();
    if (done == 0) timed_from_ = now;  // the capture pose has nothing to solve
    if (done != 1 && done != frames_timed) return;
    const double each = std::chrono::duration<double>(now - timed_from_).count() / done;
    const bool said_about_so = said_each_ > 0 && std::abs(each - said_each_) < 0.3 * said_each_;
    if (said_about_so || (said_each_ == 0 && each * left < 20)) return;
    note(fmt::format("{:.2f} s a frame, by the first {}: about {} for the {} frames to come", each,
                     done == 1 ? "one" : std::to_string(done), duration_text(each * left), left));
    said_each_ = each;
  }

  ExistingRun existing() const {
    return options_.resume ? ExistingRun::resume : options_.force ? ExistingRun::replace : ExistingRun::refuse;
  }

  void warn(std::string text) {
    caution(text);
    warnings_.push_back(std::move(text));
  }

  /// Whether the scene's own list of guesses tells of this end, as those of drafted scenes do.
  bool is_listed(const Muscle& muscle, const Attachment& attachment) const {
    const std::string end = attachment.end == AttachmentEnd::origin ? " origin:" : " insertion:";
    return std::ranges::any_of(loaded_.guessed,
                               [&](const std::string& line) { return line.starts_with(muscle.name + end); });
  }

  void describe_scene() {
    const Scene& scene = loaded_.scene;
    note(fmt::format("scene {}: {}, {}, preset {}", scene.name, counted(scene.bones.size(), "bone"),
                     counted(scene.muscles.size(), "muscle"), loaded_.preset));
    note(describe_plan(plan_));
    for (const Muscle& muscle : scene.muscles) {
      detail(fmt::format("{}: {} triangles", muscle.name, muscle.surface.face_count()));
      for (const Attachment& attachment : muscle.attachments) {
        const AttachmentArea area = attachment_area(muscle.surface, attachment.vertices);
        detail(fmt::format("  {} '{}' on {}: {} vertices, {:.1f} cm²{}",
                           attachment.end == AttachmentEnd::origin ? "origin" : "insertion", attachment.name,
                           scene.bodies[static_cast<std::size_t>(attachment.body)], attachment.vertices.size(),
                           area.area * 1e4, attachment.guessed ? ", guessed" : ""));
        if (attachment.guessed && !is_listed(muscle, attachment))
          guessed_.push_back(muscle.name + " " + attachment.name);
      }
    }
    guessed_.insert(guessed_.end(), loaded_.guessed.begin(), loaded_.guessed.end());
    if (!guessed_.empty())
      note(fmt::format("{} things were guessed rather than measured; run.json names them", guessed_.size()));
    for (const std::string& warning : loaded_.warnings) warn(warning);
  }

  std::vector<DistanceField> bone_fields(const DistanceFieldSettings& settings) {
    for (const Bone& bone : loaded_.scene.bones) detail(fmt::format("distance field of {}", bone.name));
    return cached_bone_fields(loaded_.scene, settings, [this](const std::string& warning) { warn(warning); });
  }

  double seconds_passed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  /// For later runs, which say beforehand how long they take.
  void keep_frame_time() const {
    const std::size_t solved = poses_.size() - 1;
    if (first_ == 0 && solved >= frames_worth_keeping)
      remember_frame_time(default_cache_folder(), frame_cost(loaded_, options_), loaded_.scene,
                          seconds_passed() / static_cast<double>(solved));
  }

  /// Says what was missed in a line or two; the rest is for the manifest.
  void summarize() {
    for (const auto& [muscle, text] : summary_.counters()) detail(fmt::format("{}: {}", muscle, text));
    for (std::string& line : summary_.missed_lines()) {
      detail(line);
      warnings_.push_back(std::move(line));
    }
    if (const int frames = folder_.frame_count() - 1 - first_; frames > 0)
      note(fmt::format("time: {} for {}, {:.2f} s each", duration_text(seconds_passed()),
                       counted(static_cast<std::size_t>(frames), "frame"), seconds_passed() / frames));
    summary_.all_gates_met() ? note(summary_.gates_line()) : caution(summary_.gates_line());
    if (const std::string worst = summary_.worst_line(); !worst.empty()) caution(worst);
  }

  /// Empty where there is none.
  std::string picture() const {
    const std::filesystem::path drawn = folder_.path() / "preview.png";
    return is_there(drawn) ? drawn.string() : "";
  }

  /// Where to look, and what to do next.
  void say_next() const {
    const std::string run = shell_word(folder_.path().string());
    if (const std::string drawn = picture(); !drawn.empty()) note(fmt::format("picture: {}", drawn));
    note(fmt::format("next: gracilis report {0}   (a page for the browser), or gracilis view {0}", run));
  }

  /// What people are told in lines.
  std::string told(const char* status) const {
    nlohmann::ordered_json drawn;
    if (const std::string file = picture(); !file.empty()) drawn = file;
    return json_text({{"folder", folder_.path().string()},
                      {"status", status},
                      {"frames", folder_.frame_count()},
                      {"seconds", seconds_passed()},
                      {"gates", summary_.as_json()},
                      {"warnings", warnings_},
                      {"picture", drawn},
                      {"next", "gracilis report " + shell_word(folder_.path().string())}});
  }

  void write_manifest(const std::string& status) const {
    RunManifest manifest;
    manifest.version = listener_.version;
    manifest.scene = loaded_.scene.name;
    manifest.preset = loaded_.preset;
    manifest.command = options_.command;
    manifest.settings = settings_text(loaded_.scene);
    manifest.inputs = loaded_.inputs;
    manifest.guessed = guessed_;
    manifest.warnings = warnings_;
    manifest.counters = summary_.counters();
    manifest.every = options_.every;
    manifest.ramps = !options_.without_ramps;
    manifest.fibers = !options_.without_fibers;
    manifest.corrections = options_.corrections;
    const CameraDirection camera = preview_camera(loaded_.scene, recorded_poses_);
    manifest.preview_looking = camera.looking;
    manifest.preview_up = camera.up;
    manifest.first_motion_frame = plan_.first_motion_frame;
    manifest.metrics = name_of(options_.measures);
    for (const Muscle& muscle : loaded_.scene.muscles)
      if (muscle.action_line.rays > 0) manifest.lines.emplace_back(muscle.name, middle_line(muscle));
    manifest.transversals = named_transversals(loaded_.scene);
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
    if (options_.pictures) draw();
    write_manifest(status);
  }

  void draw() {
    write_run_charts(folder_.path(), loaded_.scene);
    try {
      write_preview(folder_.path(), loaded_.scene, recorded_poses_);
    } catch (const Error& error) {
      // A run is complete without a picture that cannot be drawn, as on a machine that offers no OpenGL; what could not
      // be read or written may be tried again.
      if (error.code() == ExitCode::unreadable_input) throw;
      warn(std::string("no preview: ") + error.what());
    }
  }

  SessionResult close(RunEnd end) const {
    if (end == RunEnd::interrupted) {
      if (folder_.frame_count() > 0)
        caution(fmt::format("stopped after frame {}; --resume goes on from there", folder_.frame_count() - 1));
      else
        caution("stopped before the first frame; --resume begins it");
      return {ExitCode::interrupted, folder_.path(), told("interrupted")};
    }
    if (options_.print_folder) say_next();
    return {options_.strict && !summary_.all_gates_met() ? ExitCode::quality : ExitCode::done, folder_.path(),
            told("complete")};
  }

  const LoadedScene& loaded_;
  const SessionOptions& options_;
  const SessionListener& listener_;
  const std::atomic<bool>& stop_;
  RunPlan plan_;
  std::vector<Pose> poses_, recorded_poses_;
  ThreadLimit threads_;
  RunFolder folder_;
  SessionSummary summary_;
  OverlapReport overlaps_;
  std::optional<FiberTracker> tracker_;
  std::unique_ptr<DeformationMethod> method_;
  std::vector<std::string> warnings_, guessed_;
  static constexpr int frames_timed = 10;
  static constexpr std::size_t frames_worth_keeping = 5;  ///< the first ones are slower
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), timed_from_;
  double said_each_ = 0;  ///< s a frame, as it was told; 0: nothing was
  int first_ = 0;
};

}  // namespace

/// What a run records is asked for once: a run that goes on does as its folder says.
SessionOptions as_begun(const LoadedScene& loaded, const SessionOptions& given) {
  SessionOptions options = given;
  const std::filesystem::path folder = session_folder(loaded, given);
  if (!options.resume || !is_there(folder / "run.json")) return options;
  const nlohmann::ordered_json manifest = read_manifest(folder);
  options.every = std::max(1, manifest.value("every", 1));
  options.without_ramps = !manifest.value("ramps", true);
  options.without_fibers = !manifest.value("fibers", true);
  options.corrections = manifest.value("corrections", false);
  options.measures =
      measure_level_called(manifest.value("metrics", name_of(MeasureLevel::full))).value_or(options.measures);
  return options;
}

SessionResult record_session(const LoadedScene& loaded, const SessionOptions& options, RunPlan plan,
                             const SessionListener& listener) {
  return Session(loaded, options, std::move(plan), listener).run();
}

}  // namespace gracilis
