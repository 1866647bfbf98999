#pragma once

#include <gracilis/study/study.hpp>

namespace gracilis {

/// Most runs that a study may have.
inline constexpr Index most_study_runs = 1'000'000;

/// Of runs that nobody names: 1 as 0001.
std::string run_name(Index number);

/// Puts a parameter's value into a run. False where it cannot be one: an angle that is none.
bool give_value(StudyRun& run, const std::string& key, const std::string& value);

/// The lines of a .csv as runs: the column `run` names them, `scene` their scene, `flexion` how far a built-in one
/// flexes; all others are keys as `--set` takes them. An empty cell leaves a key as it is. `scene` is that of rows
/// which name none; may be empty. Throws InputError with file and line.
void read_run_table(const std::filesystem::path& file, const std::string& scene, Study& study);

}  // namespace gracilis
