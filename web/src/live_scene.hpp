#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/simulation.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// What the page draws and plots of one muscle. JavaScript reads it where it lies, in single precision.
struct ShownMuscle {
  std::vector<float> points;         ///< 3 per vertex, m
  std::vector<float> fibers;         ///< 3 per point of all fibers, m
  std::vector<Index> fiber_offsets;  ///< where each fiber begins, and the last ends
  std::vector<float> strains;        ///< per fiber: length over that in the capture pose
  std::vector<std::uint8_t> tendon;  ///< per vertex, 255 × how much of it is tendon
  std::vector<float> stripes;        ///< per vertex: where it lies across the fibers, in widths of the stripes
  std::vector<double> facts;         ///< mean fiber length, m; volume, m³; then an arm per coordinate, m, or NaN
};

/// What a person may choose: a method as it is, or by a preset.
struct PageChoice {
  std::string name, meaning;
  MethodChoice method;
  bool is_own = false;  ///< with the settings that the scene has for single muscles
};

/// A scene that the page moves, by any of the methods.
class LiveScene {
 public:
  explicit LiveScene(Scene scene);

  /// Everything about it that does not change, as JSON; arrays as addresses and sizes.
  std::string description() const;
  /// Prepares a choice, by its number in the description, and goes to the capture pose.
  void choose(std::size_t choice);
  /// One step, to these coordinates (rad) and activations. Throws as DeformationMethod::advance.
  void advance(const std::vector<Real>& coordinates, const std::vector<Real>& activations);
  /// Makes what the page shows of where it stands; moment arms, which take the longest, where they are asked for.
  void show(bool arms);
  /// As pull_bone (view/window/bone_pull.hpp).
  bool pull(std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking,
            std::vector<Real>& coordinates) const;

  std::size_t coordinate_count() const { return coordinate_count_; }
  std::size_t muscle_count() const { return scene_.muscles.size(); }

 private:
  std::vector<DistanceField> fields(const DistanceFieldSettings& settings);

  Scene scene_;
  std::vector<SettingValues> own_settings_;  ///< of each muscle, by the scene
  std::vector<PageChoice> choices_;
  std::size_t coordinate_count_ = 0;
  std::vector<DistanceField> fields_;  ///< by the scene's settings; made when a method first asks for them
  std::unique_ptr<Simulation> simulation_;
  int steps_ = 0;
  std::vector<float> bodies_;  ///< 12 per body: a 3 × 4 matrix by columns
  std::vector<ShownMuscle> shown_;
  std::vector<std::vector<float>> bones_;        ///< points, 3 per vertex, m
  std::vector<std::uint8_t> brightness_;         ///< of the stripes, from one end of their width to the other
  std::vector<std::vector<Real>> rest_lengths_;  ///< of every muscle's fibers, m
};

}  // namespace gracilis
