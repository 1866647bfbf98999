#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Everything that makes a scene unfit for a run, all at once; empty when there is nothing. Behind it code may rely on:
/// names are unique and fit for file names, indices lie in range, numbers are finite, joints stand parents before
/// children and connect every body to bodies[0], axes have unit length, surfaces have triangles, attachments have
/// ascending vertices of which none is fixed to two bodies, settings lie within their ranges, and the motion's times
/// increase. Whether a surface is closed is for `inspect` and the readers to say; what its method asks for, for
/// `validate_method` (methods/registry.hpp).
std::vector<Problem> validate(const Scene& scene);

}  // namespace gracilis
