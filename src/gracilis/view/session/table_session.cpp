#include <gracilis/view/session/table_session.hpp>

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/folder_lock.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/tables/action_tables.hpp>
#include <gracilis/io/tables/fiber_table.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>

#include <fmt/format.h>

#include <map>

namespace gracilis {

namespace {

constexpr const char* lengths_file = "fiber_lengths.sto";

/// Tables that grow by a row with every frame.
class GrowingTables {
 public:
  GrowingTables(const Scene& scene, int rows) : scene_(scene), rows_(rows) {}

  void add(const FrameRecord& record) {
    if (texts_.empty()) texts_[lengths_file] = fiber_lengths_head(scene_, record.fibers, rows_);
    texts_[lengths_file] += fiber_lengths_row(scene_, record.frame.pose, record.fibers);
    for (const RunTable& table : moment_arm_tables(scene_, record, rows_)) {
      std::string& text = texts_[table.name];
      if (text.empty()) text = table.head;
      text += table.row;
    }
  }

  void write(const std::filesystem::path& folder) const {
    for (const auto& [name, text] : texts_) write_text_atomically(folder / name, text);
  }

 private:
  const Scene& scene_;
  int rows_;
  std::map<std::string, std::string> texts_;
};

void require_free(const std::filesystem::path& folder, bool force) {
  if (is_there(folder / "run.json"))
    throw ConfigurationError({folder.string(), "", "holds a run", "--out names another folder for the tables"});
  if (is_there(folder / lengths_file) && !force)
    throw ConfigurationError(
        {folder.string(), "", "holds tables already", "--force replaces them, --out names another folder"});
}

}  // namespace

SessionResult record_tables(const LoadedScene& loaded, const SessionOptions& options, const SessionListener& listener) {
  const std::atomic<bool>& stop = listener.stop_or_never();
  const Scene& scene = loaded.scene;
  SessionResult interrupted = {ExitCode::interrupted, options.out};
  const ThreadLimit threads(options.threads);
  create_folder(options.out);
  const FolderLock lock(options.out);
  require_free(options.out, options.force);
  for (const std::string& warning : loaded.warnings) listener.tell(MessageKind::warning, warning);
  const std::vector<Pose> poses = pose_sequence(scene, loaded.max_frames);
  listener.tell(MessageKind::note, fmt::format("scene {}: {} muscles, {} poses; tables alone", scene.name,
                                               scene.muscles.size(), poses.size()));
  RunChoices choices;
  choices.fiber_actions = true;
  choices.measures = MeasureLevel::none;
  GrowingTables tables(scene, static_cast<int>(poses.size()));
  const int last = static_cast<int>(poses.size()) - 1;
  try {
    const StopScope scope(&stop);
    const auto method = make_method(scene, [&](const DistanceFieldSettings& settings) {
      return cached_bone_fields(scene, settings,
                                [&](const std::string& text) { listener.tell(MessageKind::warning, text); });
    });
    listener.tell(MessageKind::note, "fibers");
    const Frame capture = capture_frame(scene, capture_pose(scene.bodies.size()), *method);
    method->give_lengths_and_arms();
    const FiberTracker tracker(scene, &capture);
    if (listener.begin) listener.begin(0, last);
    const auto record = [&](const FrameRecord& now) {
      tables.add(now);
      if (listener.progress) listener.progress(now.frame.number, last);
    };
    if (run_scene(scene, poses, *method, nullptr, stop, record, &tracker, choices) == RunEnd::interrupted)
      return interrupted;
  } catch (const Interrupted&) {
    return interrupted;
  }
  tables.write(options.out);
  return {ExitCode::done, options.out};
}

}  // namespace gracilis
