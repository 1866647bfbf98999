#include <gracilis/transfer/transfer.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/median.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/transfer/carried_part.hpp>
#include <gracilis/transfer/mirrored_scene.hpp>
#include <gracilis/transfer/space_warp.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

std::string side_word(BodySide side) { return side == BodySide::left ? "left" : "right"; }

/// Names that tell no side are of the side asked for, or of the template's.
void take_side(const Scene& scene, const TransferOptions& options, Transferred& result) {
  FoundFolder& subject = result.subject;
  if (!subject.side_is_guessed) return;
  const BodySide side = options.side.value_or(side_of(scene));
  if (side == BodySide::none) return;
  for (FoundBone& bone : subject.bones) {
    if (!bone.known || !bone.known->paired) continue;
    if (bone.name.ends_with(side_ending(bone.side))) bone.name.replace(bone.name.size() - 2, 2, side_ending(side));
    bone.side = side;
  }
  subject.side = side;
  result.guesses.push_back({"side", "no bone's name says right or left: taken as " + side_word(side), 0.5});
}

/// With what the folder holds and was not taken: it may be what is missing.
[[noreturn]] void refuse(const FoundFolder& subject, const std::string& what, const std::string& remedy) {
  std::vector<Problem> problems = {{"--bones", "", what, remedy}};
  for (const std::string& line : subject.left_out) problems.push_back({"left out", "", line, ""});
  throw InputError(problems);
}

/// The template as it is or mirrored, whichever has more bones in the subject; or as asked for.
void choose_half(const Scene& scene, const TransferOptions& options, Transferred& result) {
  const Scene other = mirrored_scene(scene);
  BoneMatches as_is = match_bones(scene, result.subject), mirrored = match_bones(other, result.subject);
  const BodySide own = side_of(scene);
  result.is_mirrored =
      options.side && own != BodySide::none ? *options.side != own : mirrored.pairs.size() > as_is.pairs.size();
  result.whole_template = result.is_mirrored ? other : scene;
  result.matches = result.is_mirrored ? std::move(mirrored) : std::move(as_is);
  if (!result.matches.pairs.empty()) return;
  std::vector<std::string> wanted, here;
  for (const Bone& bone : result.whole_template.bones) wanted.push_back(bone.name);
  for (const FoundBone& bone : result.subject.bones) here.push_back(bone.name);
  refuse(result.subject,
         fmt::format("none of the template's bones ({}) is among the subject's ({})", fmt::join(wanted, ", "),
                     fmt::join(here, ", ")),
         "name bones as in femur_r.ply or 'left scapula.stl', or choose another template");
}

/// Bodies of which nothing is there take their joints and muscles with them, and what these alone connected.
void leave_out(Transferred& result) {
  keep_connected_part(result.scene, result.skeleton.has_bones, result.left_out);
  for (const std::string& bone : result.matches.missing)
    result.left_out.push_back(fmt::format("bone {}: the subject has none of this name", bone));
  if (!result.scene.muscles.empty()) return;
  refuse(result.subject, "no muscle of the template ends on the subject's bones alone",
         fmt::format("add the bones that are missing: {}", fmt::join(result.matches.missing, ", ")));
}

/// With the subject's shapes; those that it lacks have no faces.
std::vector<TriangleMesh> place_bones(Transferred& result) {
  std::vector<TriangleMesh> subject(result.whole_template.bones.size());
  for (const BoneMatch& match : result.matches.pairs)
    subject[static_cast<std::size_t>(match.of_template)] = result.subject.bones[match.of_subject].mesh;
  std::vector<Bone> bones;
  for (std::size_t b = 0; b < subject.size(); ++b) {
    if (subject[b].face_count() == 0) continue;
    bones.push_back(result.whole_template.bones[b]);
    bones.back().surface = subject[b];
  }
  result.scene.bones = std::move(bones);
  return subject;
}

void move_joints(Transferred& result) {
  // In the order of the template's bones, as its joints know them.
  std::vector<Real> scales;
  for (const FittedBone& bone : result.skeleton.bones) scales.push_back(bone.registered.similarity.scale);
  const Scene& from = result.whole_template;
  const FoundFolder of_template = found_bones(from, result.subject.size / median(scales));
  const bool any_known = std::any_of(of_template.bones.begin(), of_template.bones.end(),
                                     [](const FoundBone& bone) { return bone.known != nullptr; });
  const JointShapes shapes = {any_known ? find_skeleton(of_template, {}) : Skeleton{},
                              find_skeleton(result.subject, {})};
  for (Joint& joint : result.scene.joints) {
    result.joints.push_back(transfer_joint(from, result.skeleton, shapes, result.warp, joint));
    result.guesses.push_back(result.joints.back().guess);
    for (const std::string& capture : result.joints.back().captures)
      result.guesses.push_back({joint.name + " capture pose", capture, 0.7});
  }
}

void require_known_muscles(const Scene& scene, const std::map<std::string, Real>& volumes) {
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) names.push_back(muscle.name);
  std::vector<Problem> problems;
  for (const auto& [name, volume] : volumes)
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back({"--volumes", "", "there is no muscle '" + name + "'", suggestion(name, names)});
  if (!problems.empty()) throw ConfigurationError(problems);
}

void pull_apart(const SeparateFunction& separate, Transferred& result) {
  std::vector<TriangleMesh> muscles, bones;
  for (const Muscle& muscle : result.scene.muscles) muscles.push_back(muscle.surface);
  for (const Bone& bone : result.scene.bones) bones.push_back(bone.surface);
  result.overlap_left = separate(muscles, bones);
  for (std::size_t m = 0; m < muscles.size(); ++m) result.scene.muscles[m].surface = std::move(muscles[m]);
}

Eigen::AlignedBox3d box_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Bone& bone : scene.bones) box.extend(bounding_box(bone.surface.vertices));
  return box;
}

Eigen::AlignedBox3d box_of(const FoundFolder& subject) {
  Eigen::AlignedBox3d box;
  for (const FoundBone& bone : subject.bones) box.extend(bounding_box(bone.mesh.vertices));
  return box;
}

/// The template's in the half of the body that was chosen, with the centers of its joints.
NamedLandmarks common_landmarks(const NamedLandmarks& given, Transferred& result) {
  if (given.of_subject.empty()) return {};
  NamedLandmarks common{joint_centers(result.whole_template), given.of_subject};
  const Vec3 across = result.whole_template.axes.right().normalized();
  for (const auto& [name, point] : given.of_template)
    common.of_template[result.is_mirrored ? other_side_name(name) : name] =
        result.is_mirrored ? Vec3(point - 2 * across.dot(point) * across) : point;
  int known = 0;
  for (const auto& [name, point] : common.of_subject) {
    if (common.of_template.count(name))
      ++known;
    else
      result.left_out.push_back("landmark " + name + ": the template has none of this name");
  }
  if (known > 0) return common;
  std::vector<std::string> names;
  for (const auto& [name, point] : common.of_template) names.push_back(name);
  throw ConfigurationError({"--landmarks", "", "no landmark has a name that the template knows",
                            fmt::format("it knows {}; give others by --template-landmarks", fmt::join(names, ", "))});
}

Eigen::Matrix3d directions(const AnatomicalAxes& axes) {
  Eigen::Matrix3d columns;
  columns << axes.anterior, axes.superior, axes.right();
  return columns;
}

/// Few bones tell little about how a body stands: where their places say something else than the bones that were laid
/// on each other, the template's directions are taken with the first body's.
AnatomicalAxes checked_axes(const AnatomicalAxes& found, Transferred& result) {
  const std::vector<char>& has_bones = result.skeleton.has_bones;
  const auto body = static_cast<std::size_t>(std::find(has_bones.begin(), has_bones.end(), 1) - has_bones.begin());
  const Eigen::Matrix3d& turn = result.skeleton.bodies[body].rotation;
  AnatomicalAxes carried = {turn * result.whole_template.axes.anterior, turn * result.whole_template.axes.superior};
  const Real nearly = std::cos(radians(25));
  if (found.anterior.dot(carried.anterior) > nearly && found.superior.dot(carried.superior) > nearly) return found;
  result.guesses.front().how = "the template's, turned as its " + result.whole_template.bodies[body];
  result.guesses.front().certainty = 0.7;
  return carried;
}

}  // namespace

Transferred transfer(const Scene& scene, FoundFolder subject, const TransferOptions& options) {
  const auto say = [&](const std::string& words) {
    if (options.say) options.say(words);
  };
  Transferred result;
  result.subject = std::move(subject);
  take_side(scene, options, result);
  choose_half(scene, options, result);
  const Scene& from = result.whole_template;
  require_known_muscles(from, options.volumes);
  require_near(options.landmarks.of_subject, box_of(result.subject), "--landmarks");
  require_near(options.landmarks.of_template, box_of(scene), "--template-landmarks");
  const BodyFrame frame = body_frame(result.subject, bone_axes(result.subject));
  result.guesses.insert(result.guesses.begin(), {"directions", frame.how, frame.certainty});
  const AnatomicalAxes axes = {frame.anterior, frame.superior};
  result.skeleton =
      fit_skeleton(from, result.subject, result.matches.pairs, directions(axes) * directions(from.axes).transpose(),
                   common_landmarks(options.landmarks, result), say);
  result.warp = space_warp(from, result.skeleton);
  result.scene = from;
  result.scene.axes = checked_axes(axes, result);
  const std::vector<TriangleMesh> bones = place_bones(result);
  leave_out(result);
  move_joints(result);
  say(fmt::format("carrying {} muscles", result.scene.muscles.size()));
  result.muscles = transfer_muscles(from, bones, result.warp, options.volumes, result.scene.muscles);
  if (options.separate) {
    say("pulling muscles apart from bones and each other");
    pull_apart(options.separate, result);
  }
  measure_muscles(result.scene, result.muscles);
  return result;
}

}  // namespace gracilis
