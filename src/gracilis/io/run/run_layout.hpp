#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace gracilis {

/// How a run's frames lie in its folder. `surfaces`: a file per muscle, bone and frame. `compact`: a file per frame
/// with all muscles (shapes/), each bone once (bones/) with its motion in the frames' files, and fibers once where they
/// follow the surfaces. Both hold the same numbers.
enum class RunLayout { surfaces, compact };
inline constexpr std::array<RunLayout, 2> run_layouts = {RunLayout::compact, RunLayout::surfaces};

/// "compact" or "surfaces".
std::string name_of(RunLayout layout);
/// The layout of that name, if there is one.
std::optional<RunLayout> run_layout_called(const std::string& name);

/// That of the run in a folder; `otherwise` where there is no frame yet.
RunLayout layout_of(const std::filesystem::path& folder, RunLayout otherwise = RunLayout::surfaces);

/// `RUN/frames/<name>_<number as four digits>.vtp`
std::filesystem::path frame_file(const std::filesystem::path& folder, const std::string& name, int number);
/// `RUN/shapes/<number as four digits>.vtp`
std::filesystem::path shapes_file(const std::filesystem::path& folder, int number);
/// `RUN/fibers/<number as four digits>.vtp`
std::filesystem::path fibers_file(const std::filesystem::path& folder, int number);
/// `RUN/bones/<name>.vtp`
std::filesystem::path bone_file(const std::filesystem::path& folder, const std::string& name);

/// The file that holds a muscle or a bone in a frame.
std::filesystem::path file_of_surface(const std::filesystem::path& folder, RunLayout layout, const std::string& name,
                                      int number);
/// Which piece of that file a muscle is; empty: the only one.
std::string piece_of_muscle(RunLayout layout, const std::string& muscle);

/// Throws InputError, which names the file, where one of the numbers read from it is not finite; `what` is what they
/// are, as in "a vertex".
void require_finite(const Eigen::Ref<const Eigen::MatrixXd>& numbers, const std::filesystem::path& file,
                    const std::string& what);

/// Throws InputError, which names the file, unless it has as many of a surface's vertices as frame 0.
void require_vertices(const std::filesystem::path& file, Index count, Index of_frame_0);

}  // namespace gracilis
