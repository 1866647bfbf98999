#include <gracilis/draft/pennate_fibers.hpp>

#include <gracilis/anatomy/fibers/fitted_pennation.hpp>

#include <fmt/format.h>

namespace gracilis {

/// Its ends alone: what carries them does not matter to fibers.
static Muscle muscle_of(const DraftMuscle& draft) {
  Muscle muscle;
  muscle.name = draft.found->name;
  muscle.surface = draft.found->mesh;
  for (const DraftAttachment& each : draft.attachments) {
    Attachment attachment;
    attachment.name = each.name;
    attachment.end = each.end;
    attachment.vertices = each.vertices;
    muscle.attachments.push_back(std::move(attachment));
  }
  return muscle;
}

void guess_pennation(Real size, DraftMuscle& muscle) {
  if (!muscle.found->known || !(muscle.found->known->fiber_length > 0)) return;
  const Real length = size * muscle.found->known->fiber_length;
  muscle.pennation = fitted_pennation(muscle_of(muscle), length);
  if (muscle.pennation)
    muscle.pennation_guess = {
        muscle.found->name + " fibers",
        fmt::format("between the belly's broad sides, at {:.0f} degrees, with which they are {:.0f} "
                    "mm long on average, as published; no aponeurosis is here",
                    degrees(*muscle.pennation), 1e3 * length),
        0.5};
}

}  // namespace gracilis
