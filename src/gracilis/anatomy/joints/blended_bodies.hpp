#pragma once

#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/twist.hpp>

#include <vector>

/// Bodies that muscles carry, where no muscle tells where they are: those of its attachments carry them, by their
/// shares.
namespace gracilis {

/// Puts the bodies that muscles carry where the bodies of the muscles' attachments carry them.
void place_by_bodies(const Scene& scene, Pose& pose);

/// How the bodies that muscles carry move, by those of the others: the mean by their shares.
void add_twists(const Scene& scene, std::vector<Twist>& of_bodies);

}  // namespace gracilis
