#pragma once

#include <gracilis/draft/found_surfaces.hpp>

namespace gracilis {

/// Leaves out a muscle of which two heads or more are here, too, and lie within it: the same tissue would be there
/// twice. What is said of it names the heads.
void leave_out_wholes(FoundFolder& found);

/// Puts in the place of a muscle that was mended by uniting its heads each of them as a muscle of its own, `name_1_r`
/// and so on, where anatomy has them on bones that move against each other.
void take_heads_apart(FoundFolder& found);

}  // namespace gracilis
