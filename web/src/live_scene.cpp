#include "live_scene.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/core/quoted_text.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/setting_table.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/report/page_method.hpp>
#include <gracilis/view/window/bone_pull.hpp>
#include <gracilis/view/window/slider_range.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

namespace gracilis {

namespace {

std::vector<float> in_single_precision(const Points& points) {
  std::vector<float> values(static_cast<std::size_t>(points.size()));
  Eigen::Map<Eigen::Matrix3Xf>(values.data(), 3, points.cols()) = points.cast<float>();
  return values;
}

/// Of shares 0 ... 1.
std::vector<std::uint8_t> in_bytes(const std::vector<Real>& shares) {
  std::vector<std::uint8_t> bytes;
  for (const Real share : shares) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
  return bytes;
}

std::string address(const void* at) { return std::to_string(reinterpret_cast<std::uintptr_t>(at)); }

std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ",") + item;
  return "[" + text + "]";
}

template <class Vector>
std::string vector_text(const Vector& v) {
  return "[" + to_text(Real(v[0])) + "," + to_text(Real(v[1])) + "," + to_text(Real(v[2])) + "]";
}

std::string axes_text(const AnatomicalAxes& axes) {
  return "{\"anterior\":" + vector_text(axes.anterior) + ",\"superior\":" + vector_text(axes.superior) +
         ",\"right\":" + vector_text(axes.right()) + "}";
}

std::string surface_text(const std::string& name, const TriangleMesh& surface, const float* points) {
  return "\"name\":" + quoted_text(name) + ",\"vertices\":" + std::to_string(surface.vertex_count()) +
         ",\"points\":" + address(points) + ",\"faces\":" + address(surface.faces.data()) +
         ",\"faceCount\":" + std::to_string(surface.face_count());
}

bool has_settings(const Scene& scene) {
  return !scene.method.settings.empty() || !scene.method.contact.empty() ||
         std::any_of(scene.muscles.begin(), scene.muscles.end(),
                     [](const Muscle& muscle) { return !muscle.settings.empty(); });
}

/// First what follows sliders as they are pulled, then the scene's own method where that is none of the others.
std::vector<PageChoice> page_choices(const Scene& scene) {
  std::vector<PageChoice> choices;
  const MethodChoice following = page_method(scene);
  choices.push_back({following.name + ", fast",
                     "Nearly the shapes of `" + following.name +
                         "` in less time: fewer iterations, on coarser copies where muscles are large.",
                     following});
  if (has_settings(scene) && find_method(scene.method.name))
    choices.push_back(
        {scene.method.name + ", as the scene says", "The method and the settings of this scene.", scene.method, true});
  for (const MethodEntry& method : methods())
    choices.push_back({std::string(method.name), std::string(method.meaning), {std::string(method.name)}});
  return choices;
}

}  // namespace

LiveScene::LiveScene(Scene scene)
    : scene_(std::move(scene)),
      choices_(page_choices(scene_)),
      coordinate_count_(coordinate_names(scene_).size()),
      bodies_(12 * scene_.bodies.size()),
      shown_(scene_.muscles.size()),
      brightness_(in_bytes(stripe_brightness(512))),
      rest_lengths_(scene_.muscles.size()) {
  drive_all(scene_);
  for (std::size_t m = 0; m < shown_.size(); ++m) {
    shown_[m].points = in_single_precision(scene_.muscles[m].surface.vertices);
    shown_[m].facts.resize(2 + coordinate_count_);
    const MuscleLook look = muscle_look(scene_.muscles[m]);
    shown_[m].tendon = in_bytes(look.tendon);
    for (const Real place : look.stripes) shown_[m].stripes.push_back(static_cast<float>(place / stripe_width));
    own_settings_.push_back(scene_.muscles[m].settings);
  }
  for (const Bone& bone : scene_.bones) bones_.push_back(in_single_precision(bone.surface.vertices));
}

std::string LiveScene::description() const {
  std::vector<std::string> choices, coordinates, bones, muscles;
  for (const PageChoice& choice : choices_)
    choices.push_back("{\"name\":" + quoted_text(choice.name) + ",\"meaning\":" + quoted_text(choice.meaning) + "}");
  for (const Joint& joint : scene_.joints)
    for (const JointAxis& axis : joint.axes) {
      const auto [low, high] = slider_range(axis);
      coordinates.push_back("{\"name\":" + quoted_text(axis.coordinate) + ",\"low\":" + to_text(low) +
                            ",\"high\":" + to_text(high) + ",\"capture\":" + to_text(axis.capture_value) +
                            ",\"translation\":" + (axis.translation ? "true" : "false") + "}");
    }
  for (std::size_t b = 0; b < scene_.bones.size(); ++b)
    bones.push_back("{" + surface_text(scene_.bones[b].name, scene_.bones[b].surface, bones_[b].data()) +
                    ",\"body\":" + std::to_string(scene_.bones[b].body) + "}");
  for (std::size_t m = 0; m < scene_.muscles.size(); ++m) {
    const ShownMuscle& shown = shown_[m];
    muscles.push_back(
        "{" + surface_text(scene_.muscles[m].name, scene_.muscles[m].surface, shown.points.data()) +
        ",\"fibers\":" + address(shown.fibers.data()) + ",\"fiberOffsets\":" + address(shown.fiber_offsets.data()) +
        ",\"fiberCount\":" + std::to_string(shown.strains.size()) + ",\"strains\":" + address(shown.strains.data()) +
        ",\"facts\":" + address(shown.facts.data()) + ",\"tendonShares\":" + address(shown.tendon.data()) +
        ",\"stripes\":" + address(shown.stripes.data()) + ",\"belly\":" +
        vector_text(fiber_paint(scene_.muscles[m].name)) + ",\"tendon\":" + vector_text(tendon_paint()) +
        ",\"color\":" + vector_text(muscle_color(scene_.muscles[m].name)) + "}");
  }
  return "{\"name\":" + quoted_text(scene_.name) + ",\"axes\":" + axes_text(scene_.axes) +
         ",\"methods\":" + joined(choices) + ",\"coordinates\":" + joined(coordinates) +
         ",\"bodies\":" + address(bodies_.data()) + ",\"bodyCount\":" + std::to_string(scene_.bodies.size()) +
         ",\"brightness\":" + address(brightness_.data()) + ",\"bones\":" + joined(bones) +
         ",\"muscles\":" + joined(muscles) + "}";
}

std::vector<DistanceField> LiveScene::fields(const DistanceFieldSettings& settings) {
  const DistanceFieldSettings& scenes = scene_.distance_fields;
  const bool usual = settings.cell_size == scenes.cell_size && settings.resolution == scenes.resolution &&
                     settings.domain_margin == scenes.domain_margin && settings.domain_factor == scenes.domain_factor;
  if (usual && !fields_.empty()) return fields_;
  std::vector<DistanceField> made;
  for (const Bone& bone : scene_.bones) made.push_back(build_bone_field(bone, settings));
  if (usual) fields_ = made;
  return made;
}

void LiveScene::choose(std::size_t choice) {
  simulation_.reset();
  scene_.method = choices_.at(choice).method;
  for (std::size_t m = 0; m < own_settings_.size(); ++m)
    scene_.muscles[m].settings = choices_[choice].is_own ? own_settings_[m] : SettingValues();
  simulation_ = std::make_unique<Simulation>(
      scene_, make_method(scene_, [this](const DistanceFieldSettings& settings) { return fields(settings); }),
      Simulation::Keeps::last_frame);
  steps_ = 0;
  for (std::size_t m = 0; m < shown_.size(); ++m) rest_lengths_[m] = polyline_lengths(simulation_->tracker().rest(m));
  show(true);
}

void LiveScene::advance(const std::vector<Real>& coordinates, const std::vector<Real>& activations) {
  Pose pose = pose_at(scene_, coordinates);
  pose.activations = activations;
  pose.time = ++steps_ * usual_time_step;
  simulation_->advance(pose, usual_time_step);
}

bool LiveScene::pull(std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking,
                     std::vector<Real>& coordinates) const {
  return pull_bone(scene_, bone, point, target, looking, coordinates);
}

void LiveScene::show(bool arms) {
  const Frame& frame = *simulation_->frame();
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    Eigen::Map<Eigen::Matrix<float, 3, 4>>{bodies_.data() + 12 * b} =
        frame.pose.bodies[b].matrix().topRows<3>().cast<float>();
  const std::vector<MuscleFibers> fibers = simulation_->tracker().follow(frame);
  std::vector<FiberActions> actions;
  if (arms) actions = simulation_->method().fiber_actions(joint_twists(scene_, frame.pose.coordinates));
  for (std::size_t m = 0; m < shown_.size(); ++m) {
    ShownMuscle& shown = shown_[m];
    shown.points = in_single_precision(frame.muscles[m].points);
    shown.fibers = in_single_precision(fibers[m].lines.points);
    shown.fiber_offsets = fibers[m].lines.offsets;
    shown.strains.clear();
    for (std::size_t i = 0; i < fibers[m].lengths.size(); ++i)
      shown.strains.push_back(static_cast<float>(fibers[m].lengths[i] / rest_lengths_[m][i]));
    shown.facts[0] = fibers[m].mean_length;
    shown.facts[1] = enclosed_volume(frame.muscles[m].points, scene_.muscles[m].surface.faces);
    for (std::size_t c = 0; c < coordinate_count_; ++c)
      shown.facts[2 + c] = m < actions.size() && actions[m].mean_arms.size() > static_cast<Index>(c)
                               ? actions[m].mean_arms[static_cast<Index>(c)]
                               : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace gracilis
