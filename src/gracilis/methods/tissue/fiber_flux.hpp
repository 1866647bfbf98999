#pragma once

#include <gracilis/methods/tissue/preparation.hpp>

namespace gracilis::tissue {

/// Fibers run along the gradient of a harmonic field from origins to insertions, whose size is the density of their
/// flux: the inverse of the section that it goes through. Sets directions, relative tensions, fiber densities and the
/// mean section. Preconditions: lattice and points are there. Without both an origin and an insertion there are no
/// fibers.
void lay_fibers(PreparedTissue& prepared);

}  // namespace gracilis::tissue
