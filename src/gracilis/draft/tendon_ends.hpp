#pragma once

#include <gracilis/draft/draft_attachments.hpp>

#include <vector>

namespace gracilis {

/// Lays ends on muscles that share their tendon, by the dictionary: such as do not reach their bone and lie on a muscle
/// that does, or on one that lies on such in turn; or that lie much nearer to it than to their bone. Ends that touch
/// their bone, and those that patches or landmarks give, stay. No muscle comes to lie on one that lies on it.
/// `size`: of the bones against a grown person's.
void lay_on_muscles(std::vector<DraftMuscle>& muscles, Real size);

}  // namespace gracilis
