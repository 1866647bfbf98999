#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/scene/presets.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace gracilis {

/// What a scene gives a muscle of a method's settings: a key of the muscle wins over that of the scene.
template <class Settings>
Settings muscle_settings(const Scene& scene, const Muscle& muscle) {
  return with_values(with_values(Settings{}, scene.method.settings), muscle.settings);
}

/// Gives the distance fields of all bones of a scene, one each, with the settings asked for.
using BoneFieldSource = std::function<std::vector<DistanceField>(const DistanceFieldSettings&)>;

/// A column of measures.csv.
struct MetricInfo {
  std::string_view name;
  int digits = 0;                 ///< after the point
  std::string_view trouble = {};  ///< what is said of a sum over all frames above 0, as in "projections skipped"
};

/// One phase of an iteration, or all of it.
struct PhaseTime {
  double milliseconds = 0;  ///< median
  std::uint64_t hash = 0;   ///< of the positions after it
};

/// A muscle in the middle of a solve, to time what one iteration takes.
class PhaseTimer {
 public:
  virtual ~PhaseTimer() = default;
  virtual Index triangles() const = 0;  ///< of the muscle's surface
  /// The iteration first, then its phases.
  virtual std::vector<std::string_view> phases() const = 0;
  /// Runs a phase, by its number in `phases`, so many times from the same state.
  virtual PhaseTime time(std::size_t phase, int repeats) const = 0;
};

/// Fibers that a method makes of a muscle and moves by itself.
struct OwnFibers {
  int count = 0, points_of_each = 0;
};

/// A method as scenes, readers and programs see it: all that they need to know of it.
struct MethodEntry {
  std::string_view name;
  std::string_view meaning;                     ///< how it deforms muscles, in a few words
  std::vector<DescribedSetting> settings = {};  ///< of [settings] and [muscles.settings]
  std::vector<DescribedSetting> contact = {};   ///< of [contact]
  std::vector<Preset> presets = {};
  std::vector<MetricInfo> metrics = {};  ///< what its reports are called
  /// What is wrong with a scene for this method, beyond single values out of their range; none: it takes any.
  std::vector<Problem> (*validate)(const Scene&) = nullptr;
  /// `fields` are asked for only where it looks at bones. Precondition: the scene is valid, for this method, too.
  std::unique_ptr<DeformationMethod> (*make)(const Scene&, const BoneFieldSource& fields) = nullptr;
  bool takes_transversals = false;  ///< lets sections give way (Scene::transversals); others refuse such a scene
  /// After how many frames it remembers nothing but them; none: after each.
  int (*resume_period)(const Scene&) = nullptr;
  /// Whether surfaces keep out of each other in this scene; none: never.
  bool (*has_surface_contact)(const Scene&) = nullptr;
  /// Whether it asks for distance fields that reach far (strings::far_field_settings) in this scene; none: never.
  bool (*has_far_fields)(const Scene&) = nullptr;
  /// Of methods that make fibers of their own, which runs record in every frame; none: fibers follow the surface.
  OwnFibers (*own_fibers)(const Scene&, const Muscle&) = nullptr;
  /// Of methods that iterate; none: it does not. Takes the muscle alone through the poses, to the middle of the last.
  /// The fields of all bones, by the scene's settings and, where it `has_far_fields`, those that reach far, must
  /// outlive the timer.
  std::unique_ptr<PhaseTimer> (*phase_timer)(const Scene&, const Muscle&, const std::vector<DistanceField>& fields,
                                             const std::vector<DistanceField>& far_fields,
                                             const std::vector<Pose>&) = nullptr;
};

}  // namespace gracilis
