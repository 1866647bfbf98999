#include <gracilis/draft/scene_draft.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/draft/pennate_fibers.hpp>
#include <gracilis/draft/tendon_ends.hpp>
#include <gracilis/geometry/mirrored_mesh.hpp>
#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/suggestions.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

/// The first words of a table's columns, or nothing of what is no table.
std::set<std::string> column_words(const fs::path& table) {
  std::set<std::string> words;
  try {
    const std::string text = read_text(table);
    const CsvRows rows(table, text);
    for (const std::string_view label : rows.labels())
      if (const NameWords name = read_name(label, {}); !name.words.empty()) words.insert(name.words.front());
  } catch (const InputError&) {
    return {};
  }
  return words;
}

/// Whether somebody may have meant the table as one of landmarks, by its name or its columns.
bool looks_like_landmarks(const fs::path& table) {
  const std::vector<std::string> name = read_name(table.stem().string(), {}).words;
  if (std::any_of(name.begin(), name.end(), [](const std::string& word) { return word.starts_with("landmark"); }))
    return true;
  const std::set<std::string> columns = column_words(table);
  return columns.contains("cloud") || (columns.contains("x") && columns.contains("y") && columns.contains("z"));
}

/// Tables that are none of landmarks are passed over, since folders hold many, unless they look like such.
Landmarks read_tables(SceneDraft& draft) {
  Landmarks all;
  for (const fs::path& table : draft.found.tables) {
    try {
      for (LandmarkCloud& cloud : read_landmarks(table, draft.found.unit_length)) all.push_back(std::move(cloud));
    } catch (const InputError& error) {
      if (looks_like_landmarks(table)) draft.left_out.push_back(error.what());
    }
  }
  return all;
}

/// A point by the label of its row, or the middle of a cloud by its name.
Vec3 landmark(const std::string& name, const Landmarks& landmarks) {
  std::vector<std::string> known;
  for (const LandmarkCloud& cloud : landmarks) {
    if (cloud.name == name) return cloud.points.rowwise().mean();
    for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
      if (cloud.labels[i] == name) return cloud.points.col(static_cast<Index>(i));
      known.push_back(cloud.labels[i]);
    }
    known.push_back(cloud.name);
  }
  std::erase(known, "");
  throw ConfigurationError(
      {"--joint", "", "the folder's tables have no landmark '" + name + "'",
       known.empty() ? "there is no table with columns cloud, index, x_mm, y_mm, z_mm" : suggestion(name, known)});
}

JointOverrides overrides_of(const DraftOptions& options, const Landmarks& landmarks) {
  JointOverrides overrides;
  for (const auto& [joint, names] : options.joint_landmarks) {
    Points points(3, static_cast<Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) points.col(static_cast<Index>(i)) = landmark(names[i], landmarks);
    overrides[joint] = points;
  }
  return overrides;
}

bool uses(const DraftMuscle& muscle, const FoundPatch& patch) {
  return std::any_of(muscle.attachments.begin(), muscle.attachments.end(), [&](const DraftAttachment& each) {
    return each.given_by == patch.file && each.part == patch.part;
  });
}

void leave_out_unused_patches(SceneDraft& draft) {
  for (const FoundPatch& patch : draft.found.patches)
    if (std::none_of(draft.muscles.begin(), draft.muscles.end(), [&](const auto& each) { return uses(each, patch); }))
      draft.left_out.push_back(
          fmt::format("{}: no muscle takes this patch of {}: none that is here has that name, or lies near it; name it "
                      "after its muscle",
                      with_part(patch.file.string(), patch.part), patch.muscle));
}

void draft_muscles(SceneDraft& draft, const Landmarks& landmarks) {
  const BoneParts bones(draft.found, draft.skeleton);
  const std::vector<FoundMuscle>& all = draft.found.muscles;
  std::vector<DraftMuscle> drafted(all.size());
  std::vector<std::string> why(all.size());
  parallel_for_each(all.size(), [&](std::size_t m) {
    drafted[m] = {&all[m], draft_attachments(all[m], draft.found, draft.skeleton, bones, landmarks, why[m])};
  });
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (drafted[m].attachments.empty())
      draft.left_out.push_back(fmt::format("{}: {}", with_part(all[m].file.string(), all[m].part), why[m]));
    else
      draft.muscles.push_back(std::move(drafted[m]));
  }
  leave_out_unused_patches(draft);
  lay_on_muscles(draft.muscles, draft.found.size);
  parallel_for_each(draft.muscles.size(), [&](std::size_t m) { guess_pennation(draft.found.size, draft.muscles[m]); });
}

/// Whether a body hangs on the joint.
bool is_moved_by(const DraftJoint& joint, const std::string& body, const Skeleton& skeleton) {
  for (const DraftJoint* at = skeleton.joint_of(body); at; at = skeleton.joint_of(at->parent))
    if (at->child == joint.child) return true;
  return false;
}

bool is_crossed(const DraftJoint& joint, const SceneDraft& draft) {
  return std::any_of(draft.muscles.begin(), draft.muscles.end(), [&](const DraftMuscle& muscle) {
    bool moved = false, resting = false;
    for (const DraftAttachment& each : muscle.attachments)
      (is_moved_by(joint, each.body, draft.skeleton) ? moved : resting) = true;
    return moved && resting;
  });
}

/// From the capture pose to where the dictionary says, and back to straight where that is hardly a way.
void draft_motion(SceneDraft& draft) {
  constexpr Real least_way = radians(25);
  for (const DraftJoint& joint : draft.skeleton.joints) {
    if (!is_crossed(joint, draft)) continue;
    for (const DraftAxis& axis : joint.axes) {
      if (!axis.shown) continue;
      const bool far = axis.capture == 0 || std::abs(*axis.shown - axis.capture) >= least_way;
      draft.motion.push_back({axis.coordinate, axis.capture, far ? *axis.shown : 0});
    }
  }
}

Guess mended_guess(const FoundMuscle& muscle) {
  const MendedSurface& mended = *muscle.mended;
  return {muscle.name,
          fmt::format("its surface is mended, since {} that of {}: {}{}",
                      mended.refused ? "a run would refuse" : "something is wrong with", name_in_folder(muscle),
                      mended.why, mended.repairs.empty() ? "" : fmt::format(" ({})", fmt::join(mended.repairs, "; "))),
          0.7};
}

void collect_guesses(SceneDraft& draft) {
  const FoundFolder& found = draft.found;
  draft.guesses.push_back(
      {"unit", fmt::format("{}: bones are then {:.2f} times as large as a grown person's", found.unit, found.size),
       found.size > 0.5 && found.size < 1.5 ? 0.95 : 0.6});
  if (found.side_is_guessed) draft.guesses.push_back({"side", "no name says right or left: taken as right", 0.5});
  draft.guesses.push_back({"directions", draft.skeleton.frame.how, draft.skeleton.frame.certainty});
  for (const FoundBone& bone : found.bones)
    if (bone.known && bone.certainty < 0.8)
      draft.guesses.push_back(
          {bone.name, "by a name that is nearly this, or has more words: " + name_in_folder(bone), bone.certainty});
  for (const DraftMuscle& muscle : draft.muscles)
    if (muscle.found->known && muscle.found->certainty < 0.8)
      draft.guesses.push_back({muscle.found->name, "by a name that is nearly this: " + name_in_folder(*muscle.found),
                               muscle.found->certainty});
  for (const DraftMuscle& muscle : draft.muscles)
    if (muscle.found->mended) draft.guesses.push_back(mended_guess(*muscle.found));
  for (const DraftMuscle& muscle : draft.muscles)
    if (!muscle.found->unmended.empty())
      draft.guesses.push_back({muscle.found->name,
                               fmt::format("its surface stays as it is in {}, though {}", name_in_folder(*muscle.found),
                                           muscle.found->unmended),
                               0.6});
  for (const Guess& guess : draft.skeleton.guesses) draft.guesses.push_back(guess);
  for (const DraftJoint& joint : draft.skeleton.joints) {
    draft.guesses.push_back(joint.guess);
    draft.guesses.push_back(joint.capture_guess);
  }
}

[[noreturn]] void refuse(const fs::path& folder, const SceneDraft& draft, const std::string& what,
                         const std::string& remedy) {
  std::vector<Problem> problems = {{folder.string(), "", what, remedy}};
  for (const std::string& line : draft.left_out) problems.push_back({"left out", "", line, ""});
  throw InputError(problems);
}

}  // namespace

SceneDraft draft_without_joints(const FolderFiles& files, const DraftOptions& options) {
  SceneDraft draft;
  draft.found = find_surfaces(files, "", options.unit);
  draft.left_out = draft.found.left_out;
  for (const FoundBone& bone : draft.found.bones) draft.skeleton.bodies.push_back(bone.name);
  for (const FoundMuscle& muscle : draft.found.muscles) draft.muscles.push_back({&muscle, {}});
  return draft;
}

SceneDraft draft_scene(const fs::path& folder, const DraftOptions& options) {
  return draft_scene(list_folder(folder), folder, options);
}

SceneDraft draft_scene(const FolderFiles& files, const fs::path& folder, const DraftOptions& options) {
  SceneDraft draft;
  draft.found = find_surfaces(files, folder, options.unit, options.mend);
  draft.left_out = draft.found.left_out;
  Landmarks landmarks = read_tables(draft);
  if (options.mirror) {
    const Vec3 right = body_frame(draft.found, bone_axes(draft.found)).right();
    mirror_body(draft.found, right);
    for (LandmarkCloud& cloud : landmarks) cloud.points = mirrored(cloud.points, right);
  }
  for (FoundMuscle& muscle : draft.found.muscles)
    if (muscle.mended) muscle.mended->file = options.mended_folder / (muscle.name + ".vtp");
  if (std::none_of(draft.found.bones.begin(), draft.found.bones.end(), [](const FoundBone& b) { return b.known; }))
    refuse(folder, draft, "holds no bone whose name is known", "name bones as in femur_r.ply or 'left scapula.stl'");
  draft.skeleton = find_skeleton(draft.found, overrides_of(options, landmarks));
  if (draft.found.muscles.empty())
    refuse(folder, draft, "holds no muscle that could be used", "name muscles as in gluteus_maximus_r.ply");
  if (draft.skeleton.joints.empty())
    refuse(folder, draft, "holds no two bones that move against each other",
           "a joint needs the bones on both of its sides");
  draft_muscles(draft, landmarks);
  if (draft.muscles.empty()) refuse(folder, draft, "holds no muscle between its bones", "");
  draft_motion(draft);
  collect_guesses(draft);
  return draft;
}

}  // namespace gracilis
