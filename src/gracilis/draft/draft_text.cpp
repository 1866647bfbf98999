#include <gracilis/draft/draft_text.hpp>

#include <gracilis/draft/folder_names.hpp>

#include <gracilis/core/quoted_text.hpp>
#include <gracilis/io/atomic_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

std::string list(const std::vector<std::string>& texts) {
  if (texts.size() == 1) return quoted_text(texts.front());
  std::string result;
  for (const std::string& text : texts) result += (result.empty() ? "[" : ", ") + quoted_text(text);
  return result + "]";
}

/// Without "-0".
std::string number(Real value, int digits) {
  const Real scale = std::pow(10.0, digits), rounded = std::round(value * scale) / scale;
  return fmt::format("{:.10g}", rounded == 0 ? 0 : rounded);
}

std::string vector_text(const Vec3& v, int digits) {
  return fmt::format("[{}, {}, {}]", number(v[0], digits), number(v[1], digits), number(v[2], digits));
}

std::string path_text(const fs::path& file, const fs::path& folder) {
  std::error_code ignored;
  const fs::path relative = fs::relative(fs::absolute(file), fs::absolute(folder), ignored);
  return quoted_text((relative.empty() ? fs::absolute(file) : relative).generic_string());
}

std::string guessed_line(const Guess& guess) { return "# guessed: " + to_string(guess) + "\n"; }

/// Writes one draft section by section.
struct Writing {
  const SceneDraft& draft;
  fs::path folder;
  std::string text = {};

  bool is_whole() const { return !draft.skeleton.joints.empty(); }
  void line(const std::string& words) { text += words + "\n"; }
  /// What a surface's file needs to be said beside its name.
  std::string unit() const {
    return (draft.found.unit == "m" ? "" : "unit = " + quoted_text(draft.found.unit) + "\n") +
           (draft.found.is_mirrored ? "mirror = true\n" : "");
  }

  /// The lines that name a surface. What was mended is in metres, and mirrored already.
  template <class Found>
  std::string surface(const Found& found) const {
    if constexpr (requires { found.mended; })
      if (found.mended) return "file = " + path_text(found.mended->file, folder) + "\n";
    return "file = " + path_text(found.file, folder) + "\n" + of_part(found.part) + unit();
  }

  static std::string of_part(const std::string& part) {
    return part.empty() ? "" : "part = " + quoted_text(part) + "\n";
  }

  void in_list(const Guess& guess) { line("  " + quoted_text(guess.subject + ": " + to_string(guess)) + ","); }

  void head(const std::string& name, const fs::path& landmarks) {
    if (is_whole()) {
      line(drafted_scene_mark +
           std::string(" What follows '# guessed:' nobody said: look at the picture beside this file,"));
      line("# correct what is wrong, and take what you have checked off the list 'guessed'. 'gracilis print-config'");
      line("# explains every key.");
    } else {
      line(drafted_scene_mark +
           std::string(" Where it says '# missing:', take the '# ' off the lines that follow, and"));
      line(
          "# change what they say. 'gracilis inspect FILE' tells what is wrong still, 'gracilis print-config' "
          "explains");
      line("# every key.");
    }
    line("schema = 1");
    line("name = " + quoted_text(name) + " # of runs");
    if (!is_whole()) {
      line("anterior = [1, 0, 0] # where the body looks, in the files' frame; change it with 'superior'");
      line("superior = [0, 1, 0]");
      return;
    }
    const BodyFrame& frame = draft.skeleton.frame;
    text += guessed_line({"", frame.how, frame.certainty});
    line("anterior = " + vector_text(frame.anterior, 6));
    line("superior = " + vector_text(frame.superior, 6));
    line("guessed = [ # repeated in each run's manifest");
    for (const Guess& guess : draft.guesses) in_list(guess);
    for (const DraftMuscle& muscle : draft.muscles)
      for (const DraftAttachment& each : muscle.attachments) in_list(each.guess);
    for (const DraftMuscle& muscle : draft.muscles)
      if (muscle.pennation) in_list(muscle.pennation_guess);
    line("]");
    if (landmarks.empty()) return;
    line("\n[landmarks]");
    line("file = " + path_text(landmarks, folder));
    line("unit = \"mm\"");
  }

  void bones() {
    for (std::size_t b = 0; b < draft.found.bones.size(); ++b) {
      const FoundBone& bone = draft.found.bones[b];
      line("\n[[bones]] # rigid; 'body' is what it moves with (without: by itself)");
      line("name = " + quoted_text(bone.name));
      if (draft.skeleton.bodies[b] != bone.name) line("body = " + quoted_text(draft.skeleton.bodies[b]));
      text += surface(bone);
    }
  }

  void joints() {
    for (const DraftJoint& joint : draft.skeleton.joints) {
      text += "\n" + guessed_line(joint.guess) +
              guessed_line({"", "capture pose: " + joint.capture_guess.how, joint.capture_guess.certainty});
      line("[[joints]] # change 'center' (m, in the files' frame) where it lies elsewhere");
      line("name = " + quoted_text(joint.name));
      line("parent = " + quoted_text(joint.parent));
      line("child = " + quoted_text(joint.child));
      line("center = " + vector_text(joint.center, 5));
      for (const DraftAxis& axis : joint.axes) {
        line("[[joints.axes]] # 'capture_deg' is its value as the files have it; outside of 'range_deg' runs warn");
        line("coordinate = " + quoted_text(axis.coordinate));
        line("axis = " + vector_text(axis.direction, 5));
        if (axis.capture != 0) line("capture_deg = " + number(degrees(axis.capture), 2));
        line(fmt::format("range_deg = [{}, {}]", number(degrees(axis.range_min), 1),
                         number(degrees(axis.range_max), 1)));
      }
    }
  }

  void attachment(const DraftAttachment& each) {
    text += "\n" + guessed_line(each.guess);
    line(fmt::format("[[muscles.attachments]] # {} vertices; smaller distances hold fewer, larger ones more",
                     each.vertices.size()));
    line("name = " + quoted_text(each.name));
    line(each.end == AttachmentEnd::origin ? "end = \"origin\"" : "end = \"insertion\"");
    if (!each.muscle.empty())
      line("muscle = " + quoted_text(each.muscle) + " # shares its tendon; or give 'bone', as other ends do");
    else if (each.bones.empty())
      line("body = " + quoted_text(each.body));
    else
      line("bone = " + list(each.bones));
    if (!each.patch.empty()) text += "patch = " + path_text(each.patch, folder) + "\n" + of_part(each.part) + unit();
    if (!each.cloud.empty()) line("cloud = " + quoted_text(each.cloud));
    if (each.line == LineKind::open) line("line = \"open\"");
    if (each.line == LineKind::closed) line("line = \"closed\"");
    if (each.bone_distance > 0) line("bone_distance_mm = " + number(1000 * each.bone_distance, 2));
    if (each.muscle_distance > 0) line("muscle_distance_mm = " + number(1000 * each.muscle_distance, 2));
    if (each.landmark_distance > 0) line("landmark_distance_mm = " + number(1000 * each.landmark_distance, 4));
    if (each.guess.certainty < 0.85) line("guessed = true");
  }

  void muscles() {
    for (const DraftMuscle& muscle : draft.muscles) {
      line("\n[[muscles]] # a closed surface, held at one origin and one insertion or more");
      line("name = " + quoted_text(muscle.found->name));
      if (muscle.found->mended)
        line(std::string("# mended, since ") +
             (muscle.found->mended->refused ? "a run would refuse " : "something is wrong with ") +
             path_text(muscle.found->file, folder) +
             (muscle.found->part.empty() ? "" : " part " + quoted_text(muscle.found->part)) + ": " +
             muscle.found->mended->why);
      text += surface(*muscle.found);
      for (const DraftAttachment& each : muscle.attachments) attachment(each);
      if (muscle.attachments.empty()) missing_attachments();
      if (muscle.pennation) pennate_fibers(muscle);
    }
  }

  void pennate_fibers(const DraftMuscle& muscle) {
    text += "\n" + guessed_line(muscle.pennation_guess);
    line("[muscles.fibers] # or give the sheets as 'aponeurosis' of attachments, or fascicles as 'tracts'");
    line("ends = \"aponeuroses\"");
    line("pennation_deg = " + number(degrees(*muscle.pennation), 0));
  }

  /// A bone by its place in the folder, or an example's name.
  std::string bone_name(std::size_t b) const {
    return b < draft.found.bones.size() ? draft.found.bones[b].name : b == 0 ? "resting_bone" : "moving_bone";
  }

  void missing_attachments() {
    for (const std::size_t end : {0u, 1u}) {
      line(end == 0 ? "# missing: where it is held; here, where it lies within 3 mm of a bone" : "#");
      line("# [[muscles.attachments]]");
      line("# name = " + quoted_text(bone_name(end)));
      line(end == 0 ? "# end = \"origin\"" : "# end = \"insertion\"");
      line("# bone = " + quoted_text(bone_name(end)));
      line("# bone_distance_mm = 3");
    }
  }

  void missing_joints() {
    line("\n# missing: joints. All bones but one need a joint that moves them, or the 'body' of another bone.");
    for (std::size_t b = 1; b < std::max<std::size_t>(2, draft.found.bones.size()); ++b) {
      const std::string name = bone_name(b);
      line("# [[joints]]");
      line("# name = " + quoted_text(name + "_joint"));
      line("# parent = " + quoted_text(bone_name(0)) + " # the body that rests");
      line("# child = " + quoted_text(name));
      line("# center = [0, 0, 0] # m, in the files' frame");
      line("# [[joints.axes]]");
      line("# coordinate = " + quoted_text(name + "_flexion"));
      line("# axis = [0, 0, 1] # a right-handed turn about it is positive");
      line("# range_deg = [0, 90]\n#");
    }
    line("# missing: a motion. Without, a run has one frame, as the files are.");
    line("# [motion]");
    line("# coordinates = [" + quoted_text(bone_name(1) + "_flexion") + "]");
    line("# key_poses_deg = [[0], [60]] # a row per pose");
    line("# step_deg = 2");
  }

  void motion() {
    if (draft.motion.empty()) return;
    std::string names, from, to;
    Real farthest = 0;
    for (const DraftMotion& each : draft.motion) {
      farthest = std::max(farthest, std::abs(each.to - each.from));
      const std::string comma = names.empty() ? "" : ", ";
      names += comma + quoted_text(each.coordinate);
      from += comma + number(degrees(each.from), 1);
      to += comma + number(degrees(each.to), 1);
    }
    line("\n# A motion to look at: the first coordinate of each joint that a muscle crosses.");
    line("[motion] # change the poses (a row each), or name a table instead: file = \"walk.mot\"");
    line("coordinates = [" + names + "]");
    line("key_poses_deg = [[" + from + "], [" + to + "]]");
    line("step_deg = " + number(std::min(2.0, 5 * farthest / turn_at_the_end()), 1));
  }

  /// How far the motion turns the body that it turns most: many small turns of a spine's levels add up.
  Real turn_at_the_end() const {
    Real most = 0;
    for (const DraftJoint& last : draft.skeleton.joints) {
      Real sum = 0;
      for (const DraftJoint* at = &last; at; at = draft.skeleton.joint_of(at->parent))
        for (const DraftMotion& each : draft.motion)
          for (const DraftAxis& axis : at->axes)
            if (axis.coordinate == each.coordinate) sum += std::abs(each.to - each.from);
      most = std::max(most, sum);
    }
    return most;
  }

  void left_out() {
    if (draft.left_out.empty()) return;
    line("\n# Left out:");
    for (std::string each : draft.left_out) {
      std::replace(each.begin(), each.end(), '\n', ' ');
      line("# - " + each);
    }
  }
};

}  // namespace

std::string draft_text(const SceneDraft& draft, const fs::path& out, const fs::path& landmarks) {
  Writing writing{draft, folder_of(out)};
  writing.head(out.stem().string(), landmarks);
  writing.bones();
  if (writing.is_whole())
    writing.joints();
  else
    writing.missing_joints();
  writing.muscles();
  writing.motion();
  writing.left_out();
  return std::move(writing.text);
}

std::string draft_landmarks(const SceneDraft& draft) {
  std::string text;
  std::map<std::string, bool> written;
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments) {
      if (each.cloud.empty() || written[each.cloud]) continue;
      written[each.cloud] = true;
      if (text.empty()) text = "cloud,index,x_mm,y_mm,z_mm\n";
      for (Index i = 0; i < each.points.cols(); ++i)
        text += fmt::format("{},{},{:.3f},{:.3f},{:.3f}\n", each.cloud, i, 1000 * each.points(0, i),
                            1000 * each.points(1, i), 1000 * each.points(2, i));
    }
  return text;
}

}  // namespace gracilis
