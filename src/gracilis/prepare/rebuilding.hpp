#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// The surface of everything that any surface encloses, made anew: a point belongs to it where the generalized winding
/// number exceeds 1/2 (Jacobson, Kavan and Sorkine-Hornung 2013), so holes are closed, what overlaps is united, and
/// neither folds nor inner shells matter. Closed, manifold, oriented outwards and without self-intersections, of one or
/// more pieces; empty where nothing is enclosed. On a grid of about a 250th of the diagonal: what is thinner
/// than that is lost. Precondition: at least one face, finite coordinates, faces of a patch agree.
TriangleMesh rebuilt_as_solid(const TriangleMesh& mesh, const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
