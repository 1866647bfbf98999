#pragma once

#include <gracilis/io/tables/run_table.hpp>
#include <gracilis/simulate/run.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What a frame's fiber actions add to the run's tables; nothing where it has none. All begin as run_table.hpp
/// says.
///
/// `moment_arms_<coordinate>.sto`, one per coordinate: per muscle `<muscle>`, the mean, `<muscle>_f000` ... (m), and
/// `<muscle>_doubtful`, how many of its fibers are about to snap to another way, and so counted as bodies carry them,
/// or not quite at rest.
///
/// lines_of_action.sto: per muscle `<muscle>_f000_origin_x`, `_y`, `_z`, the unit direction in which the fiber pulls at
/// its origin, and `_insertion_x` ...; `<muscle>_f000_doubtful`, 1 or 0; and per body that the muscle pulls at
/// `<muscle>_on_<body>_force_x` ... (1) and `_moment_x` ... (m) about the body's origin, the place of the ground's
/// origin in the capture pose, which went with the body. All in the directions of the ground.
std::vector<RunTable> action_tables(const Scene& scene, const FrameRecord& record, int rows);

/// Of these the moment arms alone.
std::vector<RunTable> moment_arm_tables(const Scene& scene, const FrameRecord& record, int rows);

/// The names of all .sto tables that a run of the scene may have.
std::vector<std::string> table_names(const Scene& scene);

/// `moment_arms_<coordinate>.sto`, a name of its own among all of the run's coordinates, which come in their order.
std::string moment_arm_file(const std::string& coordinate, const std::vector<std::string>& coordinates = {});

}  // namespace gracilis
