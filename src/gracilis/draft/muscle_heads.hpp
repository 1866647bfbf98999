#pragma once

#include <gracilis/draft/found_surfaces.hpp>

namespace gracilis {

/// Leaves out a muscle of which two heads or more are here, too, and lie within it: the same tissue would be there
/// twice. What is said of it names the heads.
void leave_out_wholes(FoundFolder& found);

}  // namespace gracilis
