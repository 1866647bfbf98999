#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/run.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace gracilis {

/// The first line of measures.csv: columns with their units.
std::string measures_header(const Scene& scene);

/// One line per muscle of the frame.
std::string measures_rows(const Scene& scene, const FrameRecord& record);

/// Calls act(record) for each frame before `end`, with its number, measures and metrics as the table rounds them.
/// Throws InputError where the file is missing or damaged. Precondition: it has the columns of this scene
/// (require_same_columns).
void read_measures(const std::filesystem::path& path, const Scene& scene, int end,
                   const std::function<void(const FrameRecord&)>& act);

/// Adds lines at the end of the file and flushes them; creates it with `header` where it is missing. Throws InputError.
void append_measures(const std::filesystem::path& path, const std::string& header, const std::string& rows);

/// Throws InputError where the file is there and begins with other columns: rows of two kinds would stand in one table.
void require_same_columns(const std::filesystem::path& path, const std::string& header);

/// Throws InputError where a frame before `end` has another time or other coordinates than its pose, as the table
/// rounds them: what goes on there would join two motions. Does nothing when there is no file.
void require_same_poses(const std::filesystem::path& path, const Scene& scene, const std::vector<Pose>& poses, int end);

/// Drops all rows from frame `first_dropped` on. Does nothing when there is no file.
void truncate_measures(const std::filesystem::path& path, int first_dropped);

}  // namespace gracilis
