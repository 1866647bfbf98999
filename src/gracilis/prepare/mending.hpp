#pragma once

#include <gracilis/prepare/surface_repair.hpp>
#include <gracilis/scene/settings.hpp>

#include <string>

namespace gracilis {

/// A surface of a muscle as near to the given one as a run takes: repaired (fix_surface) and not remeshed, which would
/// take ten times as long and move all of it; only edges far shorter than the others go that repairs leave
/// (slivers.hpp). Where repair made several times as many triangles, by a grid, these are joined to ones of
/// `PrepareSettings::edge_length`. Throws InputError where the surface cannot be mended, or not within
/// `PrepareSettings::time_limit`.
FixedSurface mended_surface(const TriangleMesh& mesh, const std::string& name, const PrepareSettings& settings = {});

}  // namespace gracilis
