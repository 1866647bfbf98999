#include <gracilis/io/scene/attachments.hpp>

#include <gracilis/anatomy/attachments/attachment_patch.hpp>
#include <gracilis/anatomy/attachments/attachment_reach.hpp>
#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/bodies.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/io/suggestions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gracilis::sections {

static AttachmentEnd read_end(TomlReader& table) {
  const std::string end = table.required_text("end");
  if (end == "insertion") return AttachmentEnd::insertion;
  if (end != "origin" && !end.empty()) table.add_problem("end", "'end' must be \"origin\" or \"insertion\"");
  return AttachmentEnd::origin;
}

static LineKind read_line_kind(TomlReader& table) {
  const std::string line = table.text("line").value_or("cloud");
  if (line == "open") return LineKind::open;
  if (line == "closed") return LineKind::closed;
  if (line == "outline") return LineKind::outline;
  if (line != "cloud") table.add_problem("line", "'line' must be \"cloud\", \"open\", \"closed\" or \"outline\"");
  return LineKind::cloud;
}

static Real millimetres(TomlReader& table, const std::string& key) {
  return table.number(key, {0, 1000, "mm"}).value_or(0) / 1000;
}

/// Which of the five rules is meant follows from the keys; they must fit together.
static void check_rule(TomlReader& table, const AttachmentDescription& description) {
  const bool patch = !description.patch.path.empty();
  const bool points = !description.clouds.empty() || !description.points.empty(), landmarks = points || patch;
  const bool listed = description.attachment.listed;
  const auto complain = [&](const std::string& what, const std::string& remedy) {
    Problem problem = description.place;
    problem.what = "attachment '" + description.attachment.name + "' " + what;
    problem.remedy = remedy;
    table.add_problem(problem);
  };
  const bool on_muscle = !description.muscle.empty();
  if (on_muscle && (!description.bones.empty() || !description.body.empty()))
    complain("lies on a muscle and also on a bone or body", "keep one of the two, or make it two attachments");
  if (description.bones.empty() && description.body.empty() && !on_muscle)
    complain("is fixed to nothing", "give 'bone', 'body' or 'muscle'");
  if (patch && points) {
    complain("has both a patch and landmarks", "keep one of the two");
  } else if (listed && (landmarks || description.bone_distance > 0 || description.landmark_distance > 0)) {
    complain("lists its vertices and also asks for distances", "keep one of the two");
  } else if (!listed && !landmarks && description.bones.empty() && !on_muscle) {
    complain("does not say which vertices it takes", "give 'cloud', 'points_mm', 'patch', 'bone' or 'vertices'");
  } else if (!listed && !patch && !description.bones.empty() && description.bone_distance == 0) {
    complain("needs the key 'bone_distance_mm'", "the distance to the bone within which vertices are taken");
  } else if (!listed && !patch && on_muscle && description.bone_distance == 0) {
    complain("needs the key 'muscle_distance_mm'", "the distance to the muscle within which vertices are taken");
  } else if (landmarks && description.landmark_distance == 0) {
    complain("needs the key 'landmark_distance_mm'",
             "the distance to the landmarks or the patch within which vertices are taken");
  } else if (description.line == LineKind::outline && on_muscle) {
    complain("has an outline on a muscle", "list its vertices, or give 'muscle_distance_mm'");
  } else if (description.line == LineKind::outline && description.bones.empty()) {
    complain("has an outline but no bone", "give 'bone', on whose surface the inside lies");
  } else if (!landmarks && description.landmark_distance > 0) {
    complain("gives a distance to landmarks but no landmarks", "give 'cloud', 'points_mm' or 'patch'");
  }
}

AttachmentDescription read_attachment(TomlReader table) {
  AttachmentDescription result;
  Attachment& attachment = result.attachment;
  result.place = table.place();
  attachment.name = table.required_text("name");
  attachment.end = read_end(table);
  result.line = read_line_kind(table);
  result.body = table.text("body").value_or("");
  result.bones = table.texts("bone");
  result.muscle = table.text("muscle").value_or("");
  result.clouds = table.texts("cloud");
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("points_mm", 3))
    result.points = {rows->transpose() / 1000};
  if (const std::optional<std::string> patch = table.text("patch")) result.patch = surface_file(table, *patch);
  for (const std::string& file : table.texts("aponeurosis")) result.aponeuroses.push_back(surface_file(table, file));
  result.bone_distance = millimetres(table, result.muscle.empty() ? "bone_distance_mm" : "muscle_distance_mm");
  result.landmark_distance = millimetres(table, "landmark_distance_mm");
  attachment.vertices = table.indices("vertices");
  attachment.listed = !attachment.vertices.empty();
  attachment.guessed = table.flag("guessed").value_or(false);
  table.reject_unknown_keys();
  check_rule(table, result);
  return result;
}

AttachmentSelector::AttachmentSelector(SceneInProgress& progress) : progress_(progress) {
  const NamedFile& file = progress.description.landmarks;
  if (file.path.empty()) return;
  read_file(progress, file, [&](const std::filesystem::path& path) { landmarks_ = read_landmarks(path, file.unit); });
}

const NearestTriangle& AttachmentSelector::tree_of(Index bone) {
  return trees_.try_emplace(bone, progress_.loaded.scene.bones[bone].surface).first->second;
}

Index AttachmentSelector::bone_index(const std::string& name) const {
  const std::vector<Bone>& bones = progress_.loaded.scene.bones;
  const auto found = std::find_if(bones.begin(), bones.end(), [&](const Bone& bone) { return bone.name == name; });
  return static_cast<Index>(found - bones.begin());
}

Index AttachmentSelector::muscle_index(const std::string& name) const {
  const std::vector<Muscle>& muscles = progress_.loaded.scene.muscles;
  const auto found =
      std::find_if(muscles.begin(), muscles.end(), [&](const Muscle& each) { return each.name == name; });
  return static_cast<Index>(found - muscles.begin());
}

const NearestTriangle& AttachmentSelector::tree_of_muscle(Index muscle) {
  return muscle_trees_.try_emplace(muscle, progress_.loaded.scene.muscles[muscle].surface).first->second;
}

std::vector<LandmarkSet> AttachmentSelector::landmarks_of(const AttachmentDescription& description) {
  std::vector<LandmarkSet> sets;
  std::vector<std::string> known;
  for (const LandmarkCloud& cloud : landmarks_) known.push_back(cloud.name);
  for (const std::string& name : description.clouds) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found != known.end()) {
      sets.push_back({landmarks_[static_cast<std::size_t>(found - known.begin())].points, description.line});
    } else {
      progress_.add_problem(description.place, "the landmark file has no cloud '" + name + "'",
                            suggestion(name, known));
    }
  }
  for (const Points& points : description.points) sets.push_back({points, description.line});
  return sets;
}

AttachmentRule AttachmentSelector::rule_of(const AttachmentDescription& description) {
  if (description.attachment.listed) return ListedVertices{description.attachment.vertices};
  std::vector<LandmarkSet> landmarks = landmarks_of(description);
  if (description.clouds.empty() && description.points.empty()) return NearBone{description.bone_distance};
  if (description.bones.empty() && description.muscle.empty())
    return NearPoints{std::move(landmarks), description.landmark_distance};
  if (description.line == LineKind::outline) {
    std::vector<const TriangleMesh*> surfaces;
    for (const std::string& bone : description.bones)
      surfaces.push_back(&progress_.loaded.scene.bones[bone_index(bone)].surface);
    for (LandmarkSet& set : landmarks) set = outline_on_bones(set.points, surfaces);
  }
  return NearLandmarks{std::move(landmarks), description.bone_distance, description.landmark_distance};
}

std::string AttachmentSelector::body_of(const AttachmentDescription& description) {
  const Scene& scene = progress_.loaded.scene;
  std::string body = description.body;
  for (const std::string& bone : description.bones) {
    const std::string& of_bone = scene.bodies[scene.bones[bone_index(bone)].body];
    if (body.empty()) body = of_bone;
    if (!description.body.empty() || body == of_bone) continue;
    progress_.add_problem(description.place,
                          "the bones of attachment '" + description.attachment.name + "' belong to different bodies",
                          "split it, or say with 'body' to which one it is fixed");
  }
  return body;
}

/// The patch's pieces on the attachment's bones; all of them where it names none.
TriangleMesh AttachmentSelector::patch_of(const AttachmentDescription& description) {
  TriangleMesh patch;
  read_file(progress_, description.patch, [&](const std::filesystem::path& path) {
    patch = progress_.files->read(path, description.patch.unit, description.patch.part);
  });
  mirror_if_asked(progress_, description.patch, patch);
  if (!inspect_mesh(patch).is_finite()) {
    progress_.add_problem(description.place,
                          "the patch '" + description.patch.path + "' has coordinates that are not finite",
                          "export the surface again");
    return {};
  }
  const std::vector<Bone>& bones = progress_.loaded.scene.bones;
  if (description.bones.empty() || patch.face_count() == 0) return patch;
  std::vector<const NearestTriangle*> trees;
  for (Index bone = 0; bone < static_cast<Index>(bones.size()); ++bone) trees.push_back(&tree_of(bone));
  std::vector<char> keep;
  for (const std::size_t bone : bones_under(patch, trees))
    keep.push_back(std::find(description.bones.begin(), description.bones.end(), bones[bone].name) !=
                   description.bones.end());
  return kept_faces(patch, keep);
}

/// Vertices near the patch and, where that is asked for, near the bone.
std::vector<Index> AttachmentSelector::held_by_patch(const Muscle& muscle, const AttachmentDescription& description,
                                                     const std::vector<const NearestTriangle*>& trees) {
  const TriangleMesh patch = patch_of(description);
  if (patch.face_count() == 0) return {};
  const NearestTriangle tree(patch);
  const std::vector<const NearestTriangle*> of_patch = {&tree};
  std::vector<Index> vertices = select_vertices(muscle.surface, of_patch, NearBone{description.landmark_distance});
  if (description.bone_distance == 0) return vertices;
  const std::vector<Index> near = select_vertices(muscle.surface, trees, NearBone{description.bone_distance});
  std::erase_if(vertices, [&](Index v) { return !std::binary_search(near.begin(), near.end(), v); });
  return vertices;
}

std::vector<const NearestTriangle*> AttachmentSelector::trees_under(const AttachmentDescription& description) {
  std::vector<const NearestTriangle*> trees;
  for (const std::string& bone : description.bones) trees.push_back(&tree_of(bone_index(bone)));
  if (!description.muscle.empty()) trees.push_back(&tree_of_muscle(muscle_index(description.muscle)));
  return trees;
}

/// The body that the muscle below carries there.
Index AttachmentSelector::body_on_muscle(const Muscle& muscle, const Attachment& attachment,
                                         const AttachmentDescription& description) {
  Scene& scene = progress_.loaded.scene;
  std::string name = muscle.name + "_on_" + description.muscle;
  if (std::find(scene.bodies.begin(), scene.bodies.end(), name) != scene.bodies.end()) name += "_" + attachment.name;
  for (const Index v : attachment.vertices)
    if (v < 0 || v >= muscle.surface.vertex_count()) return 0;  // validation says so
  return add_muscle_body(scene, name, muscle_index(description.muscle),
                         muscle.surface.vertices(Eigen::all, attachment.vertices));
}

/// Where a muscle's needles were divided, what lies between vertices that are listed, or that landmarks name one by
/// one, is held, too: of the file's surface the whole edge between the two was.
void AttachmentSelector::add_between(const Muscle& muscle, const AttachmentDescription& description,
                                     std::vector<Index>& vertices) {
  if (progress_.divided.empty()) return;
  const auto number = static_cast<std::size_t>(&muscle - progress_.loaded.scene.muscles.data());
  const VerticesBetween& added = progress_.divided[number];
  if (added.ends.empty()) return;
  for (const Index v : vertices)
    if (description.attachment.listed && (v < 0 || v >= added.first))
      return progress_.add_problem(description.place, "attachment '" + description.attachment.name + "' of " +
                                                          muscle.name + ": vertex " + std::to_string(v) +
                                                          " does not exist (the surface has vertices 0 to " +
                                                          std::to_string(added.first - 1) + ")");
  add_vertices_between(added, vertices);
  if (!description.attachment.listed) std::sort(vertices.begin(), vertices.end());
}

Attachment AttachmentSelector::selected(const Muscle& muscle, const AttachmentDescription& description) {
  Attachment attachment = description.attachment;
  const std::vector<const NearestTriangle*> trees = trees_under(description);
  attachment.vertices = description.patch.path.empty() ? select_vertices(muscle.surface, trees, rule_of(description))
                                                       : held_by_patch(muscle, description, trees);
  const bool by_clouds = !description.clouds.empty() || !description.points.empty();
  if (attachment.listed || by_clouds) add_between(muscle, description, attachment.vertices);
  if (attachment.vertices.empty()) {
    progress_.add_problem(description.place,
                          "attachment '" + attachment.name + "' of " + muscle.name + " holds no vertex",
                          "give larger distances, or check the units and that the muscle reaches there");
    return attachment;
  }
  attachment.body = description.muscle.empty() ? body_index(progress_.loaded.scene, body_of(description))
                                               : body_on_muscle(muscle, attachment, description);
  return attachment;
}

/// A sheet in the muscle or on it, from its file.
void AttachmentSelector::add_aponeurosis(Muscle& muscle, const AttachmentDescription& description,
                                         const NamedFile& file) {
  const auto complain = [&](const std::string& what, const std::string& remedy) {
    progress_.add_problem(description.place, "the aponeurosis '" + file.path + "' " + what, remedy);
  };
  Aponeurosis result{description.attachment.end, {}};
  bool is_read = false;
  read_file(progress_, file, [&](const std::filesystem::path& path) {
    result.surface = progress_.files->read(path, file.unit, file.part);
    is_read = true;
  });
  if (!is_read) return;
  if (!inspect_mesh(result.surface).is_finite())
    return complain("has coordinates that are not finite", "export the surface again");
  mirror_if_asked(progress_, file, result.surface);
  if (muscle.surface.vertex_count() > 0 && !any_point_within(muscle.surface, result.surface.vertices))
    return complain("lies outside of " + muscle.name, "check the units and that both are in the same frame");
  muscle.aponeuroses.push_back(std::move(result));
}

void AttachmentSelector::attach(Muscle& muscle, const std::vector<AttachmentDescription>& attachments) {
  for (const AttachmentDescription& description : attachments) {
    muscle.attachments.push_back(selected(muscle, description));
    for (const NamedFile& file : description.aponeuroses) add_aponeurosis(muscle, description, file);
  }
}

void AttachmentSelector::attach_all(const std::vector<MuscleDescription>& descriptions) {
  std::vector<Muscle>& muscles = progress_.loaded.scene.muscles;
  std::set<std::string> attached;
  const auto is_ready = [&](const MuscleDescription& description) {
    return std::all_of(description.attachments.begin(), description.attachments.end(),
                       [&](const auto& each) { return each.muscle.empty() || attached.count(each.muscle); });
  };
  for (bool any = true; any;) {
    any = false;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      if (attached.count(muscles[m].name) || !is_ready(descriptions[m])) continue;
      attach(muscles[m], descriptions[m].attachments);
      attached.insert(muscles[m].name);
      any = true;
    }
  }
  for (const MuscleDescription& description : descriptions)
    if (!attached.count(description.muscle.name))
      progress_.add_problem(description.place, description.muscle.name + " lies on a muscle that lies on it in turn",
                            "attach one of them to bones alone");
}

void let_go_of_attachments(LoadedScene& loaded) {
  for (const LetGo& each : let_go_beyond_reach(loaded.scene, pose_sequence(loaded.scene, loaded.max_frames)))
    loaded.warnings.push_back(
        fmt::format("{}: attachment '{}' lets go of {} of its {} vertices, because the motion takes '{}' {:.1f} times "
                    "as far from them as at rest (at most {:g}); list its vertices to hold them all",
                    each.muscle, each.attachment, each.vertices, each.of, each.other, each.stretch, longest_reach));
}

}  // namespace gracilis::sections
