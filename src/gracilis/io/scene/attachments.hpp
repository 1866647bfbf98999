#pragma once

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <map>
#include <string>
#include <vector>

/// [[muscles.attachments]] and the landmarks that they name.
namespace gracilis::sections {

/// One table; what is wrong with it goes to the reader's problems.
AttachmentDescription read_attachment(TomlReader table);

/// Selects the vertices that attachments hold.
class AttachmentSelector {
 public:
  /// Reads the scene's landmarks.
  explicit AttachmentSelector(SceneInProgress& progress);

  /// Adds the described attachments to the scene's muscles, those that lie on others after these; one without a vertex
  /// is a problem. The scene's surfaces stay as they are.
  void attach_all(const std::vector<MuscleDescription>& descriptions);

 private:
  void attach(Muscle& muscle, const std::vector<AttachmentDescription>& attachments);
  void add_aponeurosis(Muscle& muscle, const AttachmentDescription& description, const NamedFile& file);
  void add_between(const Muscle& muscle, const AttachmentDescription& description, std::vector<Index>& vertices);
  Attachment selected(const Muscle& muscle, const AttachmentDescription& description);
  std::vector<Index> held_by_patch(const Muscle& muscle, const AttachmentDescription& description,
                                   const std::vector<const NearestTriangle*>& trees);
  TriangleMesh patch_of(const AttachmentDescription& description);
  std::string body_of(const AttachmentDescription& description);
  AttachmentRule rule_of(const AttachmentDescription& description);
  std::vector<LandmarkSet> landmarks_of(const AttachmentDescription& description);
  Index body_on_muscle(const Muscle& muscle, const Attachment& attachment, const AttachmentDescription& description);
  std::vector<const NearestTriangle*> trees_under(const AttachmentDescription& description);
  Index bone_index(const std::string& name) const;
  Index muscle_index(const std::string& name) const;
  const NearestTriangle& tree_of(Index bone);
  const NearestTriangle& tree_of_muscle(Index muscle);

  SceneInProgress& progress_;
  std::vector<LandmarkCloud> landmarks_;
  std::map<Index, NearestTriangle> trees_, muscle_trees_;
};

/// Lets go of the vertices that could not follow the motion (distances to a bone take such, too), with a warning each.
void let_go_of_attachments(LoadedScene& loaded);

}  // namespace gracilis::sections
