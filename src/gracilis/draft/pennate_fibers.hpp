#pragma once

#include <gracilis/draft/draft_attachments.hpp>

namespace gracilis {

/// Has the fibers of a muscle that is known as pennate end on aponeuroses, which are the belly's broad sides where
/// nothing is known of them, at a pennation at which they are as long as published for a body of this size (against a
/// grown person's). Leaves muscles that no such angle fits, and those whose attachments are spread like aponeuroses.
void guess_pennation(Real size, DraftMuscle& muscle);

}  // namespace gracilis
