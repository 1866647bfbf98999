#include <gracilis/opensim/import/scene_folder.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/opensim/import/made_muscles.hpp>
#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/import/scene_muscles.hpp>
#include <gracilis/opensim/import/toml_text.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <limits>
#include <set>

namespace gracilis::opensim {

namespace fs = std::filesystem;

static std::string axis_text(const SceneAxis& axis, const Eigen::VectorXd& coordinates) {
  const Real unit = axis.translation ? 1000 : degrees(1);
  const char* suffix = axis.translation ? "mm" : "deg";
  return fmt::format("\n[[joints.axes]]\ncoordinate = {}\naxis = {}\n{}capture_{} = {}\nrange_{} = [{}, {}]\n",
                     toml_text(axis.coordinate), toml_vector(axis.axis->axis),
                     axis.translation ? "translation = true\n" : "", suffix, value_of(axis, coordinates) * unit, suffix,
                     scene_bound(axis.range_min) * unit, scene_bound(axis.range_max) * unit);
}

static std::string joint_text(const Model& model, const Joint& joint, const Skeleton& skeleton,
                              const Eigen::VectorXd& coordinates) {
  const auto name = [&](Index body) { return toml_text(model.bodies[static_cast<std::size_t>(body)].name); };
  const RigidTransform frame = skeleton.poses()[static_cast<std::size_t>(joint.parent_body)] * joint.parent_frame;
  std::string text =
      fmt::format("\n[[joints]]\nname = {}\nparent = {}\nchild = {}\ncenter = {}\norientation_xyz_rad = {}\n",
                  toml_text(joint.name), name(joint.parent_body), name(joint.child_body),
                  toml_vector(frame.translation()), toml_vector(frame.linear().eulerAngles(0, 1, 2)));
  for (const SceneAxis& axis : scene_axes(model, joint)) text += axis_text(axis, coordinates);
  return text;
}

/// Where muscles that keep out of each other have less of their volume than this it is told.
static constexpr Real told_share = 0.75;

/// Contact passes from muscle to muscle: with the 30 that one alone needs tendons come 1.2 mm into their neighbors.
static constexpr int iterations_apart = 60;

static std::string head(const Model& model, bool apart) {
  std::string text = fmt::format(
      "# Made of the OpenSim model {} by 'gracilis import'. Bones and muscles in the pose of its default\n"
      "# coordinates. Muscles are {} about the model's lines, with the volumes that its forces and fiber\n"
      "# lengths ask for{}.\n"
      "schema = 1\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n\n[contact]\nmuscle = {}\n",
      toml_text(model.name), apart ? "side by side" : "round",
      apart ? " where there is room, and their bellies keep out of each other"
            : "; lines run through each other, so contact between muscles is off",
      apart ? "\"surface\"" : "\"none\"");
  if (!apart) return text;
  return text + fmt::format("\n[settings]\niterations = {}   # twice the default: contact passes through many\n",
                            iterations_apart);
}

std::string motion_file_name(const NamedMotion& motion) {
  std::set<std::string> taken = {"model"};
  return file_name_of(motion.name, taken);
}

fs::path scene_file(const fs::path& folder, const NamedMotion& motion) {
  return folder / (motion_file_name(motion) + ".toml");
}

int kept_rows(const NamedMotion& motion) {
  gracilis::Motion rows;
  rows.times = motion.motion.times;
  rows.values = motion.motion.values;
  const Real never = std::numeric_limits<Real>::infinity();
  thin_out(rows, -never, never, imported_time_step);
  return static_cast<int>(rows.times.size());
}

static void write_motion(const Model& model, const NamedMotion& motion, const fs::path& folder) {
  const std::string name = motion_file_name(motion);
  write_sto(folder / (name + ".sto"), scene_motion(model, motion.motion, name));
  write_text_atomically(
      scene_file(folder, motion),
      fmt::format("schema = 1\nname = {}\ninclude = \"model.toml\"\n\n[motion]\nfile = {}\n"
                  "time_step = {}   # s; rows of the file that follow sooner are left out ({} of {} stay)\n",
                  toml_text(name), toml_text(name + ".sto"), imported_time_step, kept_rows(motion),
                  motion.motion.times.size()));
}

/// Rows of matches.csv.
static std::string matches_text(const std::string& muscle, const std::vector<MatchedPoints>& matches) {
  std::string text;
  for (const MatchedPoints& match : matches) {
    const Vec3 from = 1000 * match.positive, to = 1000 * match.negative;
    text += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", muscle, match.section, from.x(), from.y(),
                        from.z(), to.x(), to.y(), to.z());
  }
  return text;
}

/// What is to be told of a muscle's shape.
static void tell_shape(const MadeMuscle& muscle, const SceneFolderSettings& settings,
                       std::vector<std::string>& left_out) {
  const MuscleVolume& volume = muscle.volume;
  if (settings.volumes.surfaces.count(muscle.name) > 0 && volume.sections_on_surface == 0)
    left_out.push_back(fmt::format("muscle '{}': its surface is nowhere near its line", muscle.name));
  if (settings.apart && volume.volume_share < told_share)
    left_out.push_back(fmt::format("muscle '{}': between the others there is room for {:.0f} % of its volume",
                                   muscle.name, 100 * volume.volume_share));
  if (volume.tendon_share < 1)
    left_out.push_back(fmt::format("muscle '{}': its line has room for {:.0f} % of the tendon", muscle.name,
                                   100 * volume.tendon_share));
}

SceneFolderNotes write_scene_folder(const Model& model, const GeometryPlaces& places,
                                    const std::vector<NamedMotion>& motions, const SceneFolderSettings& settings,
                                    const fs::path& folder) {
  for (const NamedMotion& motion : motions)
    if (const fs::path scene = scene_file(folder, motion); is_there(scene))
      throw ConfigurationError({scene.string(), "", "is there already, and the import would replace it",
                                "name another folder, or remove the file"});
  Skeleton skeleton(model);
  const Eigen::VectorXd coordinates = default_coordinates(model);
  skeleton.place(coordinates);
  const ModelBones bones = load_bones(model, skeleton.poses(), places);
  SceneFolderNotes notes{bones.missing, {}};
  fs::create_directories(folder / "bones");
  fs::create_directories(folder / "muscles");
  std::string text = head(model, settings.apart);
  for (const ModelBone& bone : bones.bones) {
    write_surface(folder / "bones" / (bone.name + ".vtp"), bone.surface.vertices, bone.surface.faces);
    text += fmt::format("\n[[bones]]\nname = {}\nbody = {}\nfile = {}\n", toml_text(bone.name),
                        toml_text(model.bodies[static_cast<std::size_t>(bone.body)].name),
                        toml_text("bones/" + bone.name + ".vtp"));
  }
  for (const Joint& joint : model.joints) text += joint_text(model, joint, skeleton, coordinates);
  VolumeSettings volumes = settings.volumes;
  std::vector<SolidBone> solid;
  for (const ModelBone& bone : bones.bones) solid.emplace_back(bone.surface);
  volumes.bones = std::make_shared<const std::vector<SolidBone>>(std::move(solid));
  // Muscles are files beside bones, and columns beside coordinates.
  std::set<std::string> names;
  for (const ModelBone& bone : bones.bones) names.insert(bone.name);
  for (const Joint& joint : model.joints)
    for (const SceneAxis& axis : scene_axes(model, joint)) names.insert(axis.coordinate);
  std::string on_surfaces = "muscle,sections,that_cut_the_surface,of_these_centers_outside\n", matches;
  for (const MadeMuscle& muscle : made_muscles(model, skeleton.poses(), coordinates, settings, volumes, notes)) {
    const MuscleVolume& volume = muscle.volume;
    const std::string name = file_name_of(muscle.name, names);
    tell_shape(muscle, settings, notes.left_out);
    if (settings.volumes.surfaces.count(muscle.name) > 0)
      on_surfaces += fmt::format("{},{},{},{}\n", muscle.name, (volume.surface.vertex_count() - 2) / volume.line.rays,
                                 volume.sections_on_surface, volume.centers_outside);
    matches += matches_text(muscle.name, volume.matches);
    // Attachments are vertices of this surface, which a run would renumber.
    if (const std::vector<std::string> repairs = repair_mesh(volume.surface).repairs; !repairs.empty()) {
      notes.left_out.push_back(fmt::format("muscle '{}': its surface would have to be repaired ({}); left out",
                                           muscle.name, fmt::join(repairs, ", ")));
      continue;
    }
    write_surface(folder / "muscles" / (name + ".vtp"), volume.surface.vertices, volume.surface.faces);
    text += muscle_text(model, name, volume, skeleton.poses(), coordinates, volumes, notes.left_out);
  }
  write_text_atomically(folder / "model.toml", text);
  if (!settings.volumes.surfaces.empty()) {
    write_text_atomically(folder / "surfaces.csv", on_surfaces);
    write_text_atomically(folder / "matches.csv", "muscle,section,x_mm,y_mm,z_mm,to_x_mm,to_y_mm,to_z_mm\n" + matches);
  }
  for (const NamedMotion& motion : motions) write_motion(model, motion, folder);
  return notes;
}

}  // namespace gracilis::opensim
