#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/scene_description.hpp>

#include <string>
#include <vector>

/// Names by which elements of a scene refer to each other.
namespace gracilis::sections {

/// Adds problems for names of bones, bodies, joints, coordinates and muscles that are not there, for names that stand
/// twice, and for key poses in the unit of another kind of coordinate.
void check_references(const SceneDescription& scene, std::vector<Problem>& problems);

/// Adds problems for surfaces that are given by numbers of which there are not so many.
void check_given(const SceneDescription& scene, Index surfaces, std::vector<Problem>& problems);

/// Keeps the muscles with these names, or all where there are none. Adds a problem at `place` for a name that is not
/// there.
void keep_only(std::vector<MuscleDescription>& muscles, const std::vector<std::string>& only, const Problem& place,
               std::vector<Problem>& problems);

}  // namespace gracilis::sections
