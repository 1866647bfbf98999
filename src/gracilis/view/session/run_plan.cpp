#include <gracilis/view/session/run_plan.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/scene/field_cache.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis {

namespace {

/// 117000 as "117,000".
std::string with_commas(std::int64_t number) {
  std::string text = std::to_string(number);
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) text.insert(static_cast<std::size_t>(at), ",");
  return text;
}

}  // namespace

std::string cost_text(const RunPlan& plan) {
  return fmt::format("{} in {} {}{}", size_text(plan.size.bytes), with_commas(plan.size.files),
                     plan.layout == RunLayout::compact ? "compact files" : "files",
                     plan.seconds && *plan.seconds >= 1 ? ", in about " + duration_text(*plan.seconds) : "");
}

FrameCost frame_cost(const LoadedScene& loaded, const SessionOptions& options) {
  return {loaded.scene.method.name, loaded.preset, options.threads > 0 ? options.threads : thread_count()};
}

RunPlan plan_run(const LoadedScene& loaded, const SessionOptions& options) {
  RunPlan plan;
  plan.parts = sequence_parts(loaded.scene, loaded.max_frames);
  plan.frames = plan.parts.count();
  plan.first_motion_frame = plan.parts.first_of_motion();
  if (options.every > 1 || options.without_ramps) {
    plan.recorded = recorded_frames(plan.parts, options.every, !options.without_ramps);
    plan.frames = static_cast<int>(plan.recorded.size());
    plan.first_motion_frame = static_cast<int>(
        std::lower_bound(plan.recorded.begin(), plan.recorded.end(), plan.first_motion_frame) - plan.recorded.begin());
  }
  const auto size_as = [&](RunLayout layout) {
    RunSize size = estimated_size(loaded.scene, plan.frames, !options.without_fibers, layout);
    if (options.corrections) size.bytes += correction_bytes(loaded.scene) * plan.frames;
    return size;
  };
  const RunSize as_surfaces = size_as(RunLayout::surfaces);
  const bool is_large = as_surfaces.bytes > asking_bytes || as_surfaces.files > most_surface_files;
  plan.layout = options.layout.value_or(is_large ? RunLayout::compact : RunLayout::surfaces);
  plan.size = size_as(plan.layout);
  plan.seconds = remembered_frame_time(default_cache_folder(), frame_cost(loaded, options), loaded.scene);
  if (plan.seconds) *plan.seconds *= plan.parts.count() - 1;  // the capture pose has nothing to solve
  return plan;
}

std::string describe_plan(const RunPlan& plan) {
  const SequenceParts& parts = plan.parts;
  if (!plan.recorded.empty())
    return fmt::format("{} frames of {} that are computed; about {}", plan.frames, parts.count(), cost_text(plan));
  std::string what;
  const auto add = [&](int frames, const char* are) {
    if (frames > 0) what += fmt::format("{}{} {}", what.empty() ? ": " : ", ", frames, are);
  };
  add(parts.ramp, "from the capture pose to the motion (the ramp)");
  add(parts.settle, "that hold its first pose");
  if (parts.count() > parts.motion) add(parts.motion, "of the motion");
  add(parts.hold, "that hold its last pose");
  add(parts.back, "back to the capture pose");
  return fmt::format("{}{}; about {}", counted(static_cast<std::size_t>(plan.frames), "frame"), what, cost_text(plan));
}

}  // namespace gracilis
