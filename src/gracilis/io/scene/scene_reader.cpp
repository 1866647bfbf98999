#include <gracilis/anatomy/activation/activation.hpp>
#include <gracilis/anatomy/attachments/attachment_reach.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/scene/prepared_cache.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/activation_samples.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/validate.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

/// One scene on its way from its description to its values; collects the problems of each phase.
class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription& description, fs::path data_root, const SceneOptions& options)
      : description_(description), data_root_(std::move(data_root)), options_(options) {}

  LoadedScene build() {
    result_.preset = description_.preset;
    result_.max_frames = description_.motion.max_frames;
    result_.inputs = description_.files;
    result_.warnings = description_.notes;
    result_.scene.name = description_.name;
    result_.scene.sequence = description_.sequence;
    result_.scene.axes = description_.axes;
    result_.scene.distance_fields = description_.distance_fields;
    result_.scene.method = description_.method;
    place_bodies();
    stop_at<ConfigurationError>();
    read_files();
    stop_at<InputError>();
    if (description_.prepare) prepare_muscles();
    for (std::size_t i = 0; i < description_.muscles.size(); ++i) attach(i);
    place_transversals();
    stop_at<ConfigurationError>();
    std::vector<Problem> invalid = validate(result_.scene);
    for (Problem& problem : validate_method(result_.scene)) invalid.push_back(std::move(problem));
    for (Problem& problem : invalid) problem.file = description_.files.front().string();
    if (!invalid.empty()) throw ConfigurationError(std::move(invalid));
    let_go_of_attachments();
    for (std::string& warning : warnings_about(result_.scene)) result_.warnings.push_back(std::move(warning));
    return std::move(result_);
  }

  SceneSurfaces build_surfaces() {
    raw_muscles_ = true;
    place_bodies();
    stop_at<ConfigurationError>();
    read_files();
    stop_at<InputError>();
    auto [muscles, bones] = named_surfaces();
    return {description_.name, std::move(muscles), std::move(bones), description_.prepare.value_or(PrepareSettings{})};
  }

 private:
  template <class Kind>
  void stop_at() {
    if (!problems_.empty()) throw Kind(std::move(problems_));
  }

  void add_problem(Problem place, const std::string& what, const std::string& remedy = "") {
    place.what = what;
    place.remedy = remedy;
    problems_.push_back(std::move(place));
  }

  /// Those of muscles that are left out are left out, too.
  void place_transversals() {
    const Scene& scene = result_.scene;
    const auto muscle_index = [&](const std::string& name) {
      const auto same = [&](const Muscle& muscle) { return muscle.name == name; };
      const auto found = std::find_if(scene.muscles.begin(), scene.muscles.end(), same);
      return found == scene.muscles.end() ? Index{-1} : static_cast<Index>(found - scene.muscles.begin());
    };
    for (const TransversalDescription& description : description_.transversals) {
      Transversal transversal = description.transversal;
      transversal.moved.muscle = muscle_index(description.muscle);
      transversal.other.muscle = muscle_index(description.other);
      for (std::size_t bone = 0; bone < scene.bones.size(); ++bone)
        if (std::find(description.bones.begin(), description.bones.end(), scene.bones[bone].name) !=
            description.bones.end())
          transversal.bones.push_back(static_cast<Index>(bone));
      if (transversal.moved.muscle >= 0) result_.scene.transversals.push_back(transversal);
    }
  }

  // ---- Bodies and joints

  Index body_index(const std::string& name) {
    std::vector<std::string>& bodies = result_.scene.bodies;
    const auto found = std::find(bodies.begin(), bodies.end(), name);
    if (found != bodies.end()) return static_cast<Index>(found - bodies.begin());
    bodies.push_back(name);
    return static_cast<Index>(bodies.size()) - 1;
  }

  /// Bodies in the order of the joints, the one that no joint moves first; joints parents before children.
  void place_bodies() {
    std::vector<const JointDescription*> waiting;
    for (const JointDescription& joint : description_.joints) waiting.push_back(&joint);
    const auto moved = [&](const std::string& body) {
      return std::any_of(waiting.begin(), waiting.end(), [&](const JointDescription* j) { return j->child == body; });
    };
    for (const JointDescription& joint : description_.joints) {
      if (!moved(joint.parent)) body_index(joint.parent);
    }
    while (!waiting.empty()) {
      const auto next = std::find_if(waiting.begin(), waiting.end(),
                                     [&](const JointDescription* joint) { return !moved(joint->parent); });
      if (next == waiting.end()) {
        add_problem(
            waiting.front()->place,
            "joint '" + waiting.front()->joint.name + "' moves its own parent '" + waiting.front()->parent + "'",
            "joints must not form a circle");
        return;
      }
      Joint joint = (*next)->joint;
      joint.parent_body = body_index((*next)->parent);
      joint.child_body = body_index((*next)->child);
      result_.scene.joints.push_back(std::move(joint));
      waiting.erase(next);
    }
    for (const BoneDescription& bone : description_.bones) body_index(bone.body);
  }

  // ---- Files

  static fs::path beside_scene(const NamedFile& file) { return fs::path(file.place.file).parent_path() / file.path; }

  /// The file beside the scene or in the data root; empty when it is in neither.
  fs::path located(const NamedFile& file) const {
    std::error_code ignored;
    if (const fs::path beside = beside_scene(file); fs::exists(beside, ignored)) return beside.lexically_normal();
    if (fs::path(file.path).is_relative() && !data_root_.empty() && fs::exists(data_root_ / file.path, ignored))
      return (data_root_ / file.path).lexically_normal();
    return {};
  }

  /// The same; adds a problem when it is in neither.
  fs::path find(const NamedFile& file) {
    const fs::path found = located(file);
    if (!found.empty()) {
      if (std::find(result_.inputs.begin(), result_.inputs.end(), found) == result_.inputs.end()) {
        result_.inputs.push_back(found);
      }
      return found;
    }
    std::string remedy = "looked for '" + beside_scene(file).lexically_normal().string() + "'";
    if (fs::path(file.path).is_relative()) {
      remedy += data_root_.empty() ? "; there is no data root: give --data DIR or set GRACILIS_DATA"
                                   : " and '" + (data_root_ / file.path).lexically_normal().string() + "'";
    }
    add_problem(file.place, "the file '" + file.path + "' does not exist", remedy);
    return {};
  }

  /// Reads a named file by `read`, or adds what is wrong with it.
  template <class Read>
  void read(const NamedFile& file, Read&& reading) {
    const fs::path path = find(file);
    if (path.empty()) return;
    try {
      reading(path);
    } catch (const InputError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }

  /// Loads all surfaces that must be fit for a role, side by side, before they are taken one by one.
  void load_ahead() {
    std::vector<const NamedFile*> named;
    std::vector<SurfaceFile> files;
    const auto add = [&](const auto& description, SurfaceRole role) {
      const fs::path path = description.box ? fs::path() : located(description.file);
      if (path.empty()) return;
      named.push_back(&description.file);
      files.push_back({path, description.file.unit, role});
    };
    for (const BoneDescription& bone : description_.bones) add(bone, SurfaceRole::bone);
    for (const MuscleDescription& muscle : description_.muscles)
      if (!stays_raw(muscle)) add(muscle, SurfaceRole::muscle);
    std::vector<LoadOutcome> outcomes = load_surfaces(files);
    for (std::size_t i = 0; i < files.size(); ++i) loaded_[named[i]] = std::move(outcomes[i]);
  }

  /// A surface that is fit for its role; what had to be repaired becomes a warning. Tells whether anything had to.
  template <class Description>
  bool read_surface(const Description& description, TriangleMesh& surface) {
    if (description.box) {
      surface = box_mesh(description.box->low, description.box->high, description.box->cells);
      return false;
    }
    const NamedFile& file = description.file;
    bool repaired = false;
    read(file, [&](const fs::path&) {
      LoadOutcome& outcome = loaded_.at(&file);
      if (outcome.error) throw InputError(*outcome.error);
      LoadedMesh loaded = std::move(outcome.loaded);
      surface = std::move(loaded.mesh);
      repaired = !loaded.repairs.empty();
      for (const auto* lines : {&loaded.repairs, &loaded.warnings}) {
        result_.warnings.insert(result_.warnings.end(), lines->begin(), lines->end());
      }
    });
    return repaired;
  }

  /// Whether the muscle's surface is taken as it is, to be prepared.
  bool stays_raw(const MuscleDescription& description) const {
    return (description_.prepare || raw_muscles_) && !description.box;
  }

  void read_muscle(const MuscleDescription& description) {
    Muscle& muscle = result_.scene.muscles.emplace_back();
    muscle.name = description.name;
    muscle.settings = description.settings;
    muscle.fibers = description.fibers;
    if (!description.fiber_file.path.empty()) {
      read(description.fiber_file, [&](const fs::path& path) {
        muscle.given_fibers = read_polylines(path, description.fiber_file.unit);
        muscle.given_are_superficial = description.superficial_fibers;
      });
    }
    muscle.contraction = description.contraction;
    muscle.action_line = description.action_line.line;
    for (const std::string& body : description.action_line.bodies)
      muscle.action_line.bodies.push_back(body_index(body));
    muscle.action_line.path = place_line_path(description.action_line.path, result_.scene,
                                              [this](const std::string& body) { return body_index(body); });
    if (!description.contraction_file.path.empty()) {
      read(description.contraction_file, [&](const fs::path& path) {
        muscle.given_surface_fibers = read_polylines(path, description.contraction_file.unit);
      });
    }
    if (stays_raw(description)) {
      read(description.file, [&](const fs::path& path) { muscle.surface = read_mesh(path, description.file.unit); });
      return;
    }
    if (!read_surface(description, muscle.surface)) return;
    for (const AttachmentDescription& attachment : description.attachments) {
      if (attachment.vertices.empty()) continue;
      add_problem(attachment.place,
                  "attachment '" + attachment.name + "' of " + muscle.name +
                      " lists vertices, but the surface had to be repaired, which may have renumbered them",
                  "write the repaired surface to a file of its own, or describe the attachment by distances");
    }
  }

  std::pair<std::vector<NamedSurface>, std::vector<NamedSurface>> named_surfaces() const {
    std::vector<NamedSurface> muscles, bones;
    for (const Muscle& muscle : result_.scene.muscles) muscles.push_back({muscle.name, muscle.surface});
    for (const Bone& bone : result_.scene.bones) bones.push_back({bone.name, bone.surface});
    return {std::move(muscles), std::move(bones)};
  }

  /// Puts prepared surfaces in the place of those that were read.
  void prepare_muscles() {
    for (const MuscleDescription& description : description_.muscles)
      for (const AttachmentDescription& attachment : description.attachments)
        if (!attachment.vertices.empty())
          add_problem(attachment.place,
                      "attachment '" + attachment.name + "' lists vertices, which preparation renumbers",
                      "describe the attachment by distances");
    stop_at<ConfigurationError>();
    Scene& scene = result_.scene;
    const auto [muscles, bones] = named_surfaces();
    const auto say = options_.say ? options_.say : [](const std::string&) {};
    std::vector<TriangleMesh> prepared =
        cached_preparation(muscles, bones, *description_.prepare, options_.prepare, say, default_cache_folder(),
                           [this](const std::string& warning) { result_.warnings.push_back(warning); });
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
      scene.muscles[m].surface =
          check_surface(prepared[m], 1, SurfaceRole::muscle, "prepared " + scene.muscles[m].name).mesh;
  }

  void read_files() {
    load_ahead();
    for (const BoneDescription& bone : description_.bones) {
      result_.scene.bones.push_back({bone.name, body_index(bone.body), {}});
      read_surface(bone, result_.scene.bones.back().surface);
    }
    for (const MuscleDescription& muscle : description_.muscles) read_muscle(muscle);
    if (!description_.landmarks.path.empty()) {
      read(description_.landmarks,
           [&](const fs::path& path) { landmarks_ = read_landmarks(path, description_.landmarks.unit); });
    }
    read_motion();
    for (const ActivationDescription& activation : description_.activations) activate(activation);
    for (const ControlUnitDescription& unit : description_.control_units) add_control_unit(unit);
  }

  void read_motion() {
    const MotionDescription& description = description_.motion;
    Motion& motion = result_.scene.motion;
    if (!description.file.path.empty()) {
      read(description.file, [&](const fs::path& path) {
        const Table table = read_table(path);
        result_.warnings.insert(result_.warnings.end(), table.warnings.begin(), table.warnings.end());
        motion = motion_from_table(table, translation_names());
        thin_out(motion, description.begin, description.end, description.time_step);
        if (motion.times.empty())
          add_problem({path.string(), "", "", ""}, "no row of the motion is between its 'begin' and 'end'");
        match_coordinates(path.string());
      });
    } else if (description.key_poses.rows() > 0) {
      motion = motion_through(description.coordinates, description.key_poses, description.step, description.time_step,
                              description.max_frames);
      motion.name = description_.name;
    }
  }

  std::vector<std::string> translation_names() const {
    std::vector<std::string> names;
    for (const Joint& joint : result_.scene.joints)
      for (const JointAxis& axis : joint.axes)
        if (axis.translation) names.push_back(axis.coordinate);
    return names;
  }

  /// A motion's file usually tells of more joints than the scene has; one that tells of none of them is the wrong file.
  void match_coordinates(const std::string& file) {
    std::vector<std::string> known = coordinate_names(result_.scene);
    if (!description_.motion.coordinates.empty()) known = description_.motion.coordinates;
    const std::vector<std::string> dropped = drop_unknown_coordinates(result_.scene.motion, known);
    for (const std::string& coordinate : known) {
      const auto& found = result_.scene.motion.coordinates;
      if (std::find(found.begin(), found.end(), coordinate) != found.end()) continue;
      if (description_.motion.coordinates.empty()) {
        result_.warnings.push_back(file + ": has no column '" + coordinate + "'; it keeps its capture value");
      } else {
        add_problem({file, "", "", ""}, "has no column '" + coordinate + "'", suggestion(coordinate, dropped));
      }
    }
    if (result_.scene.motion.coordinates.empty()) {
      add_problem({file, "", "", ""}, "none of its columns is a coordinate of the scene", suggestion("", known));
    }
  }

  // ---- Activation

  void activate(const ActivationDescription& description) {
    ActivationPlan& plan = result_.scene.activation;
    const std::vector<std::string> coordinates = coordinate_names(result_.scene);
    for (const std::string& muscle : description.muscles) {
      if (description.value) {
        plan.signals.push_back({muscle, {0}, {*description.value}});
      } else if (!description.coordinate.empty()) {
        const auto found = std::find(coordinates.begin(), coordinates.end(), description.coordinate);
        plan.functions.push_back(
            {muscle, along_coordinate(static_cast<std::size_t>(found - coordinates.begin()), description.points)});
      } else {
        read(description.file, [&](const fs::path& path) {
          const Table table = read_table(path);
          const std::string& name = description.column.empty() ? muscle : description.column;
          const std::optional<Eigen::Index> found = column_of(table, name);
          if (!found) {
            add_problem({path.string(), "", "", ""}, "has no column '" + name + "'", suggestion(name, table.columns));
            return;
          }
          const Eigen::VectorXd values = table.values.col(*found);
          plan.signals.push_back({muscle, table.times, {values.begin(), values.end()}});
        });
      }
    }
  }

  /// What 'gracilis activations join' makes of the unit's files.
  Table join(const ControlUnitDescription& description, const fs::path& results) {
    Trial trial{description.name, {}, read_table(results), {}};
    JoinSettings settings;
    read(description.motion, [&](const fs::path& path) { trial.motion = read_table(path); });
    if (!description.names.path.empty())
      read(description.names, [&](const fs::path& path) { settings.muscles = read_muscle_mapping(path); });
    settings.combine = description.combine;
    if (!description.forces.path.empty())
      read(description.forces, [&](const fs::path& path) { trial.forces = read_table(path); });
    if (trial.motion.columns.empty() || (!description.forces.path.empty() && trial.forces.columns.empty())) return {};
    JoinedSamples joined = join_samples({trial}, settings);
    for (const std::string& problem : joined.problems)
      result_.warnings.push_back("joint control unit '" + description.name + "': " + problem);
    return std::move(joined.samples);
  }

  void add_control_unit(const ControlUnitDescription& description) {
    JointControlUnit unit{description.name,   description.joint, description.coordinates, description.muscles, {}, {},
                          description.falloff};
    if (unit.coordinates.empty()) {
      for (const Joint& joint : result_.scene.joints)
        if (joint.name == unit.joint)
          for (const JointAxis& axis : joint.axes) unit.coordinates.push_back(axis.coordinate);
    }
    const bool joined = description.samples.path.empty();
    read(joined ? description.results : description.samples, [&](const fs::path& path) {
      const Table table = joined ? join(description, path) : read_table(path);
      if (unit.muscles.empty()) {
        for (const Muscle& muscle : result_.scene.muscles)
          if (column_of(table, muscle.name)) unit.muscles.push_back(muscle.name);
      }
      const auto columns = [&](const std::vector<std::string>& names, Real factor) {
        Eigen::MatrixXd values(table.values.rows(), static_cast<Index>(names.size()));
        for (std::size_t i = 0; i < names.size(); ++i) {
          if (const std::optional<Eigen::Index> found = column_of(table, names[i])) {
            values.col(static_cast<Index>(i)) = factor * table.values.col(*found);
          } else {
            add_problem({path.string(), "", "", ""}, "has no column '" + names[i] + "'",
                        suggestion(names[i], table.columns));
          }
        }
        return values;
      };
      unit.angles = columns(unit.coordinates, table.in_degrees ? radians(1) : 1);
      unit.activations = columns(unit.muscles, 1);
      result_.scene.activation.units.push_back(unit);
    });
  }

  // ---- Attachments

  const NearestTriangle& tree_of(Index bone) {
    const auto [found, inserted] = trees_.try_emplace(bone, nullptr);
    if (inserted) found->second = std::make_unique<NearestTriangle>(result_.scene.bones[bone].surface);
    return *found->second;
  }

  Index bone_index(const std::string& name) const {
    const auto& bones = result_.scene.bones;
    return static_cast<Index>(
        std::find_if(bones.begin(), bones.end(), [&](const Bone& bone) { return bone.name == name; }) - bones.begin());
  }

  std::vector<LandmarkSet> landmarks_of(const AttachmentDescription& attachment) {
    std::vector<LandmarkSet> sets;
    std::vector<std::string> known;
    for (const LandmarkCloud& cloud : landmarks_) known.push_back(cloud.name);
    for (const std::string& name : attachment.clouds) {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found != known.end()) {
        sets.push_back({landmarks_[static_cast<std::size_t>(found - known.begin())].points, attachment.line});
      } else {
        add_problem(attachment.place, "the landmark file has no cloud '" + name + "'", suggestion(name, known));
      }
    }
    for (const Points& points : attachment.points) sets.push_back({points, attachment.line});
    return sets;
  }

  AttachmentRule rule_of(const AttachmentDescription& attachment) {
    if (!attachment.vertices.empty()) return ListedVertices{attachment.vertices};
    std::vector<LandmarkSet> landmarks = landmarks_of(attachment);
    if (attachment.clouds.empty() && attachment.points.empty()) return NearBone{attachment.bone_distance};
    if (attachment.bones.empty()) return NearPoints{std::move(landmarks), attachment.landmark_distance};
    if (attachment.line == LineKind::outline) {
      std::vector<const TriangleMesh*> surfaces;
      for (const std::string& bone : attachment.bones)
        surfaces.push_back(&result_.scene.bones[static_cast<std::size_t>(bone_index(bone))].surface);
      for (LandmarkSet& set : landmarks) set = outline_on_bones(set.points, surfaces);
    }
    return NearLandmarks{std::move(landmarks), attachment.bone_distance, attachment.landmark_distance};
  }

  void attach(std::size_t index) {
    Muscle& muscle = result_.scene.muscles[index];
    for (const AttachmentDescription& description : description_.muscles[index].attachments) {
      Attachment attachment{
          description.name, description.end, 0, {}, description.guessed, !description.vertices.empty()};
      std::vector<const NearestTriangle*> trees;
      std::string body = description.body;
      for (const std::string& bone : description.bones) {
        trees.push_back(&tree_of(bone_index(bone)));
        const std::string& of_bone = result_.scene.bodies[result_.scene.bones[bone_index(bone)].body];
        if (body.empty()) body = of_bone;
        if (description.body.empty() && body != of_bone) {
          add_problem(description.place,
                      "the bones of attachment '" + description.name + "' belong to different bodies",
                      "split it, or say with 'body' to which one it is fixed");
        }
      }
      attachment.body = body_index(body);
      const AttachmentRule rule = rule_of(description);
      attachment.vertices = select_vertices(muscle.surface, trees, rule);
      if (attachment.vertices.empty()) {
        add_problem(description.place, "attachment '" + description.name + "' of " + muscle.name + " holds no vertex",
                    "give larger distances, or check the units and that the muscle reaches there");
      }
      muscle.attachments.push_back(std::move(attachment));
    }
  }

  /// Distances to a bone take vertices that could not follow it, too.
  void let_go_of_attachments() {
    for (const LetGo& each : let_go_beyond_reach(result_.scene, pose_sequence(result_.scene, result_.max_frames)))
      result_.warnings.push_back(
          fmt::format("{}: attachment '{}' lets go of {} of its {} vertices, because the motion takes '{}' {:.1f} "
                      "times as far from "
                      "them as at rest (at most {:g}); list its vertices to hold them all",
                      each.muscle, each.attachment, each.vertices, each.of, each.other, each.stretch, longest_reach));
  }

  const SceneDescription& description_;
  fs::path data_root_;
  const SceneOptions& options_;
  bool raw_muscles_ = false;
  LoadedScene result_;
  std::vector<Problem> problems_;
  std::map<const NamedFile*, LoadOutcome> loaded_;
  std::vector<LandmarkCloud> landmarks_;
  std::map<Index, std::unique_ptr<NearestTriangle>> trees_;
};

}  // namespace

static fs::path data_root_of(const SceneDescription& description, const SceneOptions& options) {
  fs::path data_root;
  for (const fs::path& file : description.files)
    if (data_root.empty()) data_root = find_data_root(file, options.data);
  return data_root;
}

LoadedScene read_scene(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  return SceneBuilder(description, data_root_of(description, options), options).build();
}

SceneSurfaces read_scene_surfaces(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  return SceneBuilder(description, data_root_of(description, options), options).build_surfaces();
}

}  // namespace gracilis
