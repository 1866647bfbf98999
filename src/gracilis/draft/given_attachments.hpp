#pragma once

#include <gracilis/draft/draft_attachments.hpp>
#include <gracilis/draft/end_contact.hpp>

#include <vector>

namespace gracilis {

/// What both ends of a muscle may be fixed to.
struct MuscleSites {
  EndSites origin, insertion;

  /// Of one end.
  const EndSites& at(AttachmentEnd end) const { return end == AttachmentEnd::origin ? origin : insertion; }
};

/// The end at which a bone lies: by the dictionary, else the origin where its body is nearer to the trunk.
AttachmentEnd end_on(std::size_t bone, const MuscleSites& sites, const BoneParts& bones, const Skeleton& skeleton);

/// Ends that patches named after the muscle give: one for each end and body. Patches whose names no muscle here has
/// give those of what is near of the same muscle: pieces, heads, or the whole of a head.
std::vector<DraftAttachment> from_patches(const FoundMuscle& muscle, const FoundFolder& found, const MuscleSites& sites,
                                          const BoneParts& bones, const Skeleton& skeleton, const MuscleEnds& ends);

/// Ends that landmarks named after the muscle give: one for each cloud that lies near the muscle.
/// `is_mirrored`: their names tell the other side.
std::vector<DraftAttachment> from_landmarks(const FoundMuscle& muscle, const Landmarks& landmarks,
                                            const MuscleSites& sites, const BoneParts& bones, const Skeleton& skeleton,
                                            const MuscleEnds& ends, bool is_mirrored);

}  // namespace gracilis
