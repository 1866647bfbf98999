#include <gracilis/methods/strings/strings_method.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/strings/settings.hpp>
#include <gracilis/strings/bone_distances.hpp>
#include <gracilis/strings/string_arms.hpp>
#include <gracilis/strings/string_skin.hpp>

#include <chrono>
#include <optional>
#include <utility>

namespace gracilis {

namespace {

/// What stays the same of one muscle.
struct StrungMuscle {
  std::string name;
  TriangleMesh rest;  ///< world, in the capture pose, m
  BodyCarriers carriers;
  std::optional<strings::MuscleStrings> strings;  ///< none: its bodies carry it
  bool wants_fibers = true;
  strings::StringSkin skin;
};

StrungMuscle prepare(const Scene& scene, const Muscle& muscle, const strings::BoneDistances& bones) {
  constexpr Real no_tendon = 0;
  StrungMuscle strung;
  strung.name = muscle.name;
  strung.rest = muscle.surface;
  strung.wants_fibers = muscle.fibers.count > 0;
  strung.carriers =
      body_carriers(muscle, build_topology(muscle.surface.faces, muscle.surface.vertex_count()), no_tendon);
  if (strings::runs_between_bodies(muscle))
    strung.strings = muscle_strings(scene, muscle, bones, muscle_settings<strings::StringSettings>(scene, muscle));
  if (strung.strings) strung.skin = bind_skin(*strung.strings, muscle.surface, strung.carriers.fixed_body);
  return strung;
}

/// Where one muscle is.
struct StrungState {
  strings::StringState strings;
  Points shape;  ///< world, m
};

Polylines as_lines(const strings::MuscleStrings& strings, const Points& places) {
  Polylines lines{places, {}};
  for (Index s = 0; s <= strings.strings; ++s) lines.offsets.push_back(strings.node(s, 0));
  return lines;
}

class StringsMethod final : public DeformationMethod {
 public:
  StringsMethod(const Scene& scene, std::vector<DistanceField> far_fields)
      : far_fields_(std::move(far_fields)),
        bones_(strings::bone_distances(scene, far_fields_)),
        body_count_(scene.bodies.size()),
        groups_(hosts_first(scene)),
        carried_(carried_bodies(scene)),
        muscles_(scene.muscles.size()) {
    parallel_for_each(muscles_.size(), [&](std::size_t m) { muscles_[m] = prepare(scene, scene.muscles[m], bones_); });
    reset();
  }

  void reset() override {
    states_.clear();
    for (const StrungMuscle& muscle : muscles_) states_.push_back(at_capture(muscle));
  }

  StepReport advance(const Pose& pose, Real) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<StrungState> next(states_.size());  // shapes follow from strings
    for (std::size_t m = 0; m < next.size(); ++m) next[m].strings = states_[m].strings;
    follow_all(pose, next, &report);
    for (std::size_t m = 0; m < muscles_.size(); ++m)
      if (!next[m].shape.allFinite() || !next[m].strings.places.allFinite())
        throw QualityError("muscle " + muscles_[m].name + ": a vertex position is not finite; check the pose");
    states_ = std::move(next);
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (std::size_t m = 0; m < states_.size(); ++m) {
      MuscleShape& shape = frame.muscles.emplace_back();
      shape.points = states_[m].shape;
      if (muscles_[m].strings && muscles_[m].wants_fibers)
        shape.fibers = as_lines(*muscles_[m].strings, states_[m].strings.places);
    }
  }

  /// Bodies that lie on a muscle go with its surface.
  void give_lengths_and_arms() override { with_surfaces_ = !carried_.empty(), with_wrenches_ = false; }

  std::vector<FiberActions> fiber_actions(const std::vector<std::vector<Twist>>& coordinates) const override {
    std::vector<FiberActions> actions(muscles_.size());
    parallel_for_each(muscles_.size(), [&](std::size_t m) {
      throw_if_stopped();
      if (muscles_[m].strings && muscles_[m].wants_fibers)
        actions[m] = string_actions(*muscles_[m].strings, bones_, states_[m].strings, coordinates, with_wrenches_);
    });
    return actions;
  }

  /// Surfaces do not tell where strings are: they go through all poses again.
  void restore(const std::vector<Pose>& poses, const Frame&, const Frame& last) override {
    reset();
    if (carried_.empty()) {
      parallel_for_each(muscles_.size(), [&](std::size_t m) {
        for (std::size_t frame = 1; frame < poses.size(); ++frame)
          follow(muscles_[m], poses[frame], states_[m].strings);
      });
    } else {
      for (std::size_t frame = 1; frame < poses.size(); ++frame) follow_all(poses[frame], states_, nullptr);
    }
    for (std::size_t m = 0; m < muscles_.size(); ++m) states_[m].shape = last.muscles[m].points;
  }

 private:
  StrungState at_capture(const StrungMuscle& muscle) const {
    StrungState state;
    if (muscle.strings) state.strings = capture_state(*muscle.strings, body_count_);
    state.shape = muscle.rest.vertices;
    return state;
  }

  /// Takes all muscles to a pose, those that lie on others after these.
  void follow_all(Pose pose, std::vector<StrungState>& states, StepReport* report) const {
    for (const std::vector<std::size_t>& group : groups_) {
      parallel_for_each(group.size(), [&](std::size_t i) {
        const auto started = std::chrono::steady_clock::now();
        StrungState& state = states[group[i]];
        follow(muscles_[group[i]], pose, state.strings);
        if (with_surfaces_ || !muscles_[group[i]].strings)
          state.shape = shape_of(muscles_[group[i]], pose, state.strings);
        const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
        if (report) report->muscles[group[i]].milliseconds = taken.count();
      });
      place_carried_bodies(
          carried_, group, [&](std::size_t m) { return &states[m].shape; }, pose);
    }
  }

  void follow(const StrungMuscle& muscle, const Pose& pose, strings::StringState& state) const {
    throw_if_stopped();
    if (muscle.strings) strings::follow(*muscle.strings, bones_, pose, state);
  }

  static Points shape_of(const StrungMuscle& muscle, const Pose& pose, const strings::StringState& state) {
    if (!muscle.strings) return moved_by(carried_motions(muscle.carriers, pose), muscle.rest.vertices);
    return skinned_by_strings(*muscle.strings, muscle.skin, muscle.rest.vertices, muscle.rest.faces, state).vertices;
  }

  std::vector<DistanceField> far_fields_;
  strings::BoneDistances bones_;
  std::size_t body_count_;
  std::vector<std::vector<std::size_t>> groups_;  ///< of muscles, hosts first
  std::vector<CarriedBody> carried_;
  std::vector<StrungMuscle> muscles_;
  std::vector<StrungState> states_;
  bool with_surfaces_ = true, with_wrenches_ = true;
};

}  // namespace

std::unique_ptr<DeformationMethod> make_strings_method(const Scene& scene, std::vector<DistanceField> far_fields) {
  return made_near_origin(scene, std::move(far_fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    return std::make_unique<StringsMethod>(near, std::move(near_fields));
  });
}

MethodEntry strings_entry() {
  return {.name = "strings",
          .meaning = "their fibers, pulled tight among the bones, and the surface that follows them",
          .settings = describe_settings<strings::StringSettings>(),
          .make =
              [](const Scene& scene, const BoneFieldSource& fields) {
                return make_strings_method(scene, fields(strings::far_field_settings()));
              },
          .has_far_fields = [](const Scene&) { return true; },
          .own_fibers = [](const Scene& scene, const Muscle& muscle) -> OwnFibers {
            const auto settings = muscle_settings<strings::StringSettings>(scene, muscle);
            return {settings.count, settings.segments + 1};
          }};
}

}  // namespace gracilis
