#include <gracilis/opensim/import/scene_folder.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/opensim/import/belly_length.hpp>
#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/import/scene_lines.hpp>
#include <gracilis/opensim/import/toml_text.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

namespace gracilis::opensim {

namespace fs = std::filesystem;

static std::string axis_text(const SceneAxis& axis, const Eigen::VectorXd& coordinates) {
  const Real unit = axis.translation ? 1000 : degrees(1);
  const char* suffix = axis.translation ? "mm" : "deg";
  return fmt::format("\n[[joints.axes]]\ncoordinate = {}\naxis = {}\n{}capture_{} = {}\nrange_{} = [{}, {}]\n",
                     toml_text(axis.coordinate), toml_vector(axis.axis->axis),
                     axis.translation ? "translation = true\n" : "", suffix, value_of(axis, coordinates) * unit, suffix,
                     axis.range_min * unit, axis.range_max * unit);
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

/// Where the length of a muscle's belly is from, as a comment.
static const char* belly_text(const Muscle& muscle, const VolumeSettings& settings) {
  if (settings.tendon != TendonPlace::beyond_belly) return "";
  return has_published_belly(muscle) ? "   # a belly as published (Ward et al. 2009), as far as the line allows"
                                     : "   # a belly as pennation and cross-section have it, as far as the line allows";
}

static std::string muscle_text(const Model& model, const std::string& name, const MuscleVolume& volume,
                               const char* belly, const std::string& path) {
  std::string text =
      fmt::format("\n[[muscles]]\nname = {}\nfile = {}\n", toml_text(name), toml_text("muscles/" + name + ".vtp"));
  std::vector<std::string> bodies, points;
  for (const Index body : volume.line.bodies)
    bodies.push_back(toml_text(model.bodies[static_cast<std::size_t>(body)].name));
  for (Eigen::Index i = 0; i < volume.line.points.cols(); ++i)
    points.push_back(toml_vector(1000 * volume.line.points.col(i)));
  const ActionLine& line = volume.line;
  text += fmt::format(
      "\n[muscles.action_line]\nrays = {}\nscaling = {}\ntendon_mm = {}{}\norigin_tendon_mm = {}\n{}"
      "optimal_fiber_mm = {}\npennation_deg = {}\nbodies = [{}]\npoints_mm = [{}]\n",
      line.rays, line.scaling, 1000 * line.tendon, belly, 1000 * line.origin_tendon,
      line.tendon_sections ? "tendon_sections = true\n" : "", 1000 * line.optimal_fiber, degrees(line.pennation),
      fmt::join(bodies, ", "), fmt::join(points, ", "));
  if (line.centers.cols() > 0) {
    std::vector<std::string> centers;
    for (const Vec3 center : line.centers.colwise()) centers.push_back(toml_vector(1000 * center));
    text += fmt::format("centers_mm = [{}]\n", fmt::join(centers, ", "));
  }
  text += path;
  for (const HeldVertices& held : volume.held) {
    const char* end = held.end == AttachmentEnd::origin ? "origin" : "insertion";
    text +=
        fmt::format("\n[[muscles.attachments]]\nname = \"{0}\"\nend = \"{0}\"\nbody = {1}\nvertices = [{2}]\n", end,
                    toml_text(model.bodies[static_cast<std::size_t>(held.body)].name), fmt::join(held.vertices, ", "));
  }
  return text;
}

/// Where muscles that keep out of each other have less of their volume than this it is told.
static constexpr Real told_share = 0.75;

static std::string head(const Model& model, bool apart) {
  return fmt::format(
      "# Made of the OpenSim model {} by 'gracilis import'. Bones and muscles in the pose of its default\n"
      "# coordinates. Muscles are {} about the model's lines, with the volumes that its forces and fiber\n"
      "# lengths ask for{}.\n"
      "schema = 1\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n\n[contact]\nmuscle = {}\n",
      toml_text(model.name), apart ? "side by side" : "round",
      apart ? " where there is room, and their bellies keep out of each other"
            : "; lines run through each other, so contact between muscles is off",
      apart ? "\"surface\"" : "\"none\"");
}

/// The muscles asked for, in the model's order.
static std::vector<const Muscle*> chosen(const Model& model, const std::vector<std::string>& names) {
  std::vector<const Muscle*> muscles;
  for (const std::string& name : names)
    if (index_of(model.muscles, name) < 0)
      throw ConfigurationError({"--muscles", "", fmt::format("the model has no muscle '{}'", name), ""});
  for (const Muscle& muscle : model.muscles)
    if (names.empty() || std::find(names.begin(), names.end(), muscle.name) != names.end()) muscles.push_back(&muscle);
  return muscles;
}

/// As each would be alone; those that have no volume are told of later.
static std::map<std::string, RoundMuscle> round_muscles(const Model& model, const std::vector<const Muscle*>& muscles,
                                                        const std::vector<RigidTransform>& poses,
                                                        const Eigen::VectorXd& coordinates,
                                                        const VolumeSettings& settings) {
  std::map<std::string, RoundMuscle> round;
  for (const Muscle* muscle : muscles) {
    if (settings.surfaces.count(muscle->name) > 0) continue;
    try {
      round[muscle->name] = round_muscle(model, *muscle, poses, coordinates, settings);
    } catch (const InputError&) {
    }
  }
  return round;
}

std::string motion_file_name(const NamedMotion& motion) {
  std::set<std::string> taken = {"model"};
  return file_name_of(motion.name, taken);
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
      folder / (name + ".toml"),
      fmt::format("schema = 1\nname = {}\ninclude = \"model.toml\"\n\n[motion]\nfile = {}\n"
                  "time_step = {}   # s; rows of the file that follow sooner are left out ({} of {} stay)\n",
                  toml_text(name), toml_text(name + ".sto"), imported_time_step, kept_rows(motion),
                  motion.motion.times.size()));
}

std::vector<std::string> write_scene_folder(const Model& model, const GeometryPlaces& places,
                                            const std::vector<NamedMotion>& motions,
                                            const SceneFolderSettings& settings, const fs::path& folder) {
  Skeleton skeleton(model);
  const Eigen::VectorXd coordinates = default_coordinates(model);
  skeleton.place(coordinates);
  const ModelBones bones = load_bones(model, skeleton.poses(), places);
  std::vector<std::string> left_out = bones.missing;
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
  const std::vector<const Muscle*> muscles = chosen(model, settings.muscles);
  if (settings.apart)
    volumes.beside =
        tendons_beside_bellies(round_muscles(model, muscles, skeleton.poses(), coordinates, volumes), *volumes.bones);
  // Muscles are files beside bones, and columns beside coordinates.
  std::set<std::string> names;
  for (const ModelBone& bone : bones.bones) names.insert(bone.name);
  for (const Joint& joint : model.joints)
    for (const SceneAxis& axis : scene_axes(model, joint)) names.insert(axis.coordinate);
  std::string on_surfaces = "muscle,sections,that_cut_the_surface,of_these_centers_outside\n";
  std::vector<const Muscle*> made;
  std::vector<MuscleVolume> surfaces;
  for (const Muscle* muscle : muscles) {
    try {
      surfaces.push_back(muscle_volume(model, *muscle, skeleton.poses(), coordinates, volumes));
      made.push_back(muscle);
    } catch (const InputError& error) {
      left_out.push_back(error.what());
    }
  }
  if (settings.apart) draw_volumes_apart(surfaces);
  for (std::size_t m = 0; m < made.size(); ++m) {
    const Muscle& muscle = *made[m];
    const MuscleVolume& volume = surfaces[m];
    const std::string name = file_name_of(muscle.name, names);
    if (settings.volumes.surfaces.count(muscle.name) > 0 && volume.sections_on_surface == 0)
      left_out.push_back(fmt::format("muscle '{}': its surface is nowhere near its line", muscle.name));
    if (settings.apart && volume.volume_share < told_share)
      left_out.push_back(fmt::format("muscle '{}': between the others there is room for {:.0f} % of its volume",
                                     muscle.name, 100 * volume.volume_share));
    if (volume.tendon_share < 1)
      left_out.push_back(fmt::format("muscle '{}': its line has room for {:.0f} % of the tendon", muscle.name,
                                     100 * volume.tendon_share));
    if (settings.volumes.surfaces.count(muscle.name) > 0)
      on_surfaces += fmt::format("{},{},{},{}\n", muscle.name, (volume.surface.vertex_count() - 2) / volume.line.rays,
                                 volume.sections_on_surface, volume.centers_outside);
    write_surface(folder / "muscles" / (name + ".vtp"), volume.surface.vertices, volume.surface.faces);
    text += muscle_text(model, name, volume, belly_text(muscle, volumes),
                        line_path_text(model, muscle, skeleton.poses(), coordinates, left_out));
  }
  write_text_atomically(folder / "model.toml", text);
  if (!settings.volumes.surfaces.empty()) write_text_atomically(folder / "surfaces.csv", on_surfaces);
  for (const NamedMotion& motion : motions) write_motion(model, motion, folder);
  return left_out;
}

}  // namespace gracilis::opensim
