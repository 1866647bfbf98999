#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// `count` points spread evenly over the area that one end of a muscle is attached by: on its triangles all of whose
/// corners are attached, or, where there is none, on its vertices (repeated when there are fewer). Each stands for an
/// equal part of a dense regular sampling, so that means over them hardly depend on the count; always the same points
/// for the same surface. 3 × count, m; empty when the muscle has no such end.
Points attachment_samples(const Muscle& muscle, AttachmentEnd end, Index count);

/// The same on a whole surface. Precondition: at least one vertex.
Points surface_points(const TriangleMesh& surface, Index count);

/// The middle of the area (of the vertices where it has none), m.
Vec3 attachment_center(const Muscle& muscle, AttachmentEnd end);

}  // namespace gracilis
