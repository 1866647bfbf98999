#pragma once

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/draft/guess.hpp>
#include <gracilis/draft/sites.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// An end of a muscle, as a scene file says it.
struct DraftAttachment {
  std::string name;
  AttachmentEnd end = AttachmentEnd::origin;
  std::string body;
  std::vector<std::string> bones;  ///< empty: `body` alone, whose bone is not here
  std::string muscle;              ///< or on this muscle, which moves with `body` there
  std::filesystem::path patch;     ///< or
  std::filesystem::path given_by;  ///< the patch's file, also where vertices are written down instead
  std::string part;                ///< of that file, a .glb
  std::string cloud;               ///< or neither: near the bones alone
  Points points = Points(3, 0);    ///< of the cloud
  LineKind line = LineKind::cloud;
  Real bone_distance = 0, muscle_distance = 0, landmark_distance = 0;
  Real from_bone = 0;           ///< m, how far from its bone contact found it; infinite: hardly there; 0: it was given
  std::vector<Index> vertices;  ///< that it holds
  bool trimmed = false;         ///< fewer than its patch or landmarks say
  Guess guess;
};

struct DraftMuscle {
  const FoundMuscle* found = nullptr;
  std::vector<DraftAttachment> attachments;
  std::optional<Real> pennation = {};  ///< rad, of fibers that end on aponeuroses
  Guess pennation_guess = {};
};

/// m; no vertex but the cloud's own lies so near to one of its points, unless the surface is finer (reach_of).
inline constexpr Real own_vertices = 0.0002;

/// Landmarks of the folder's tables.
using Landmarks = std::vector<LandmarkCloud>;

/// Both ends of a muscle: from patches where there are any, else from landmarks named after it, else from where it
/// touches the bones that the dictionary names, or without such, any two bones. Nothing where an end has no place; then
/// `why` says what is missing.
std::vector<DraftAttachment> draft_attachments(const FoundMuscle& muscle, const FoundFolder& found,
                                               const Skeleton& skeleton, const BoneParts& bones,
                                               const Landmarks& landmarks, std::string& why);

}  // namespace gracilis
