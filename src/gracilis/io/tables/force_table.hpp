#pragma once

#include <gracilis/io/tables/run_table.hpp>
#include <gracilis/simulate/run.hpp>

#include <optional>

namespace gracilis {

inline constexpr const char* force_file = "forces.sto";

/// What the muscles' forces in a frame add to forces.sto; nothing where the method knows none. It begins as
/// run_table.hpp says; then per muscle, in N, N·m and the directions of the ground:
///
/// `<muscle>_tension` of all fibers together, and `<muscle>_f000_tension` ... of each; `<muscle>_origin_on_<body>`,
/// `_insertion_on_<body>`, `_fascia_on_<body>` and `_contact_on_<bone>`, each with `_force_x` ... and `_moment_x` ...
/// about the place of the ground's origin in the capture pose, which went with the body; `_contact_on_<muscle>_force_x`
/// ...; per coordinate
/// `<muscle>_moment_<coordinate>`, what all of these do in its motion (N·m per rad, or N), and
/// `_moment_by_work_<coordinate>`, the energy that the muscle loses in it: the two differ by what it is not at rest.
std::optional<RunTable> force_table(const Scene& scene, const FrameRecord& record, int rows);

}  // namespace gracilis
