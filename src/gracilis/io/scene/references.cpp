#include <gracilis/io/scene/references.hpp>

#include <gracilis/io/suggestions.hpp>

#include <algorithm>
#include <map>
#include <unordered_set>

namespace gracilis::sections {

using Names = std::vector<std::string>;

static bool among(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

static const std::string& name_of(const BoneDescription& bone) { return bone.name; }
static const std::string& name_of(const MuscleDescription& description) { return description.muscle.name; }
static const std::string& name_of(const AttachmentDescription& description) { return description.attachment.name; }

template <class Description>
static void reject_duplicates(const std::vector<Description>& list, const std::string& kind,
                              std::vector<Problem>& problems) {
  std::map<std::string, Problem> first;
  for (const Description& element : list) {
    const std::string& name = name_of(element);
    const auto [found, inserted] = first.emplace(name, element.place);
    if (inserted || name.empty()) continue;
    Problem problem = element.place;
    problem.what = "duplicate " + kind + " name '" + shortened(name) + "'";
    problem.remedy = "the first one is at " + found->second.file + ":" + found->second.where;
    problems.push_back(problem);
  }
}

namespace {

/// Names in the order in which they were first told, each once.
struct NameList {
  Names names;
  std::unordered_set<std::string> all;

  NameList() = default;
  explicit NameList(const Names& list) {
    for (const std::string& name : list) add(name);
  }
  void add(const std::string& name) {
    if (all.insert(name).second) names.push_back(name);
  }
};

}  // namespace

static void require_known(const std::string& name, const NameList& known, const std::string& kind, const Problem& place,
                          std::vector<Problem>& problems) {
  if (name.empty() || known.all.contains(name)) return;
  Problem problem = place;
  problem.what = "there is no " + kind + " '" + shortened(name) + "'";
  problem.remedy = suggestion(name, known.names);
  problems.push_back(problem);
}

static void require_known(const Names& names, const NameList& known, const std::string& kind, const Problem& place,
                          std::vector<Problem>& problems) {
  for (const std::string& name : names) require_known(name, known, kind, place, problems);
}

static Names names_of(const std::vector<MuscleDescription>& muscles) {
  Names names;
  for (const MuscleDescription& description : muscles) names.push_back(description.muscle.name);
  return names;
}

namespace {

/// All that elements of a scene may be referred to by.
struct KnownNames {
  NameList bones, bodies, joints, coordinates;
  NameList muscles;  ///< also those that --only leaves out
};

}  // namespace

static KnownNames names_in(const SceneDescription& scene) {
  KnownNames known;
  for (const BoneDescription& bone : scene.bones) {
    known.bones.add(bone.name);
    known.bodies.add(bone.body);
  }
  // A body without a bone is known by the joint that moves it or that it carries; a misspelled one then hangs on
  // nothing, which the scene's validation finds.
  for (const JointDescription& description : scene.joints) {
    known.joints.add(description.joint.name);
    known.bodies.add(description.parent);
    known.bodies.add(description.child);
    for (const JointAxis& axis : description.joint.axes) known.coordinates.add(axis.coordinate);
  }
  known.muscles = NameList(names_of(scene.muscles));
  return known;
}

static void check_attachment(const SceneDescription& scene, const AttachmentDescription& description,
                             const KnownNames& known, std::vector<Problem>& problems) {
  require_known(description.bones, known.bones, "bone", description.place, problems);
  require_known(description.body, known.bodies, "body", description.place, problems);
  require_known(description.muscle, known.muscles, "muscle", description.place, problems);
  if (description.clouds.empty() || !scene.landmarks.path.empty()) return;
  Problem problem = description.place;
  problem.what = "attachment '" + description.attachment.name + "' names a cloud but the scene names no landmark file";
  problem.remedy = "add [landmarks] with 'file' and 'unit'";
  problems.push_back(problem);
}

static void check_line(const MuscleDescription& muscle, const LineDescription& line, const KnownNames& known,
                       std::vector<Problem>& problems) {
  for (const Names* bodies : {&line.bodies, &line.path.point_bodies, &line.path.wrap_bodies})
    require_known(*bodies, known.bodies, "body", muscle.place, problems);
  for (const auto& of_point : line.path.coordinates)
    for (const std::string& coordinate : of_point)
      require_known(coordinate, known.coordinates, "coordinate", muscle.place, problems);
}

static void check_muscle(const SceneDescription& scene, const MuscleDescription& muscle, const KnownNames& known,
                         std::vector<Problem>& problems) {
  reject_duplicates(muscle.attachments, "attachment", problems);
  check_line(muscle, muscle.line, known, problems);
  for (const LineDescription& head : muscle.heads) check_line(muscle, head, known, problems);
  for (const AttachmentDescription& attachment : muscle.attachments)
    check_attachment(scene, attachment, known, problems);
}

/// Key poses are of rotations or of translations, as their coordinates are.
static void check_key_poses(const SceneDescription& scene, std::vector<Problem>& problems) {
  const MotionDescription& motion = scene.motion;
  if (motion.key_poses.rows() == 0) return;
  for (const JointDescription& description : scene.joints)
    for (const JointAxis& axis : description.joint.axes) {
      if (!among(motion.coordinates, axis.coordinate) || axis.translation == motion.translations) continue;
      Problem problem = motion.place;
      problem.what = "'" + axis.coordinate + (axis.translation ? "' is a translation" : "' is a rotation");
      problem.remedy = axis.translation ? "give 'key_poses_mm'" : "give 'key_poses_deg'";
      problems.push_back(problem);
    }
}

static void check_motion(const SceneDescription& scene, const KnownNames& known, std::vector<Problem>& problems) {
  check_key_poses(scene, problems);
  require_known(scene.motion.coordinates, known.coordinates, "coordinate", scene.motion.place, problems);
}

void check_references(const SceneDescription& scene, std::vector<Problem>& problems) {
  const KnownNames known = names_in(scene);
  for (const MuscleDescription& muscle : scene.muscles) check_muscle(scene, muscle, known, problems);
  check_motion(scene, known, problems);
  for (const ActivationDescription& activation : scene.activations) {
    require_known(activation.muscles, known.muscles, "muscle", activation.place, problems);
    require_known(activation.coordinate, known.coordinates, "coordinate", activation.place, problems);
  }
  for (const TransversalDescription& each : scene.transversals) {
    require_known(each.muscle, known.muscles, "muscle", each.place, problems);
    require_known(each.other, known.muscles, "muscle", each.place, problems);
    require_known(each.bones, known.bones, "bone", each.place, problems);
  }
  for (const ControlUnitDescription& description : scene.control_units) {
    const JointControlUnit& unit = description.unit;
    require_known(unit.joint, known.joints, "joint", description.place, problems);
    require_known(unit.muscles, known.muscles, "muscle", description.place, problems);
    require_known(unit.coordinates, known.coordinates, "coordinate", description.place, problems);
  }
  reject_duplicates(scene.bones, "bone", problems);
  reject_duplicates(scene.muscles, "muscle", problems);
}

void check_given(const SceneDescription& scene, Index surfaces, std::vector<Problem>& problems) {
  const auto check = [&](const std::string& name, const SurfaceDescription& surface, const Problem& place) {
    if (!surface.given || *surface.given < surfaces) return;
    Problem problem = place;
    problem.what = "no program gives surface " + std::to_string(*surface.given) + " of '" + name + "'";
    problem.remedy = "name a 'file'";
    problems.push_back(problem);
  };
  for (const BoneDescription& bone : scene.bones) check(bone.name, bone.surface, bone.place);
  for (const MuscleDescription& muscle : scene.muscles) check(muscle.muscle.name, muscle.surface, muscle.place);
}

void keep_only(std::vector<MuscleDescription>& muscles, const std::vector<std::string>& only, const Problem& place,
               std::vector<Problem>& problems) {
  if (only.empty()) return;
  require_known(only, NameList(names_of(muscles)), "muscle", place, problems);
  std::erase_if(muscles, [&](const MuscleDescription& description) { return !among(only, description.muscle.name); });
  const Names kept = names_of(muscles);
  for (const MuscleDescription& description : muscles)
    for (const AttachmentDescription& each : description.attachments) {
      if (each.muscle.empty() || among(kept, each.muscle)) continue;
      Problem problem = place;
      problem.what = description.muscle.name + " lies on " + each.muscle + ", which is left out";
      problem.remedy = "name " + each.muscle + ", too";
      problems.push_back(problem);
    }
}

}  // namespace gracilis::sections
