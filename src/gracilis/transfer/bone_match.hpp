#pragma once

#include <gracilis/draft/found_surfaces.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A bone of the template and the subject's of the same name.
struct BoneMatch {
  Index of_template = 0;
  std::size_t of_subject = 0;  ///< in FoundFolder::bones
};

struct BoneMatches {
  std::vector<BoneMatch> pairs;         ///< in the template's order
  std::vector<std::string> missing;     ///< the template's bones that the subject lacks
  std::vector<std::string> not_needed;  ///< the subject's bones that the template lacks
};

/// By the dictionary's names and sides, in any of its languages; names that it does not know must be equal.
BoneMatches match_bones(const Scene& scene, const FoundFolder& subject);

/// The scene's bones as if they had been found in a folder, for what asks a folder's. Of subjects whose size against a
/// grown person's is `size`.
FoundFolder found_bones(const Scene& scene, Real size);

/// The side that more of a scene's bones are of.
BodySide side_of(const Scene& scene);

}  // namespace gracilis
