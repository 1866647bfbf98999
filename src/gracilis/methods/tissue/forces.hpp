#pragma once

#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// A force and its moment about the world's origin.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N·m
};

/// What a muscle pulls by at the points that one of its ends is attached by.
Wrench attachment_wrench(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                         AttachmentEnd end);

}  // namespace gracilis::tissue
