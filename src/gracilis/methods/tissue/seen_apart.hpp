#pragma once

#include <gracilis/methods/tissue/settle_muscles.hpp>

namespace gracilis::tissue {

/// Takes what is seen of muscles (`seen`) out of each other where it lies deeper than at rest, half of the way each,
/// and gives it its volume back and keeps it out of bones; the tissue stays where its forces are in balance.
/// `distances`: to the bones. `moved` (m): how much nearer muscles may have come to each other since they last looked.
void keep_seen_apart(TissueMuscles& tissues, const std::vector<SignedDistance>& distances, Real moved,
                     std::vector<MovingMuscle>& moving);

}  // namespace gracilis::tissue
