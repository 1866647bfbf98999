#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <nlohmann/json.hpp>

namespace gracilis {

/// What the report says of a run, shapes apart: name, manifest, frames, times, coordinates, muscles with their colors,
/// and
///
///   charts   id, title, unit, limits, and series: muscle, values per frame (null where there is none), for fibers also
///            low and high
///   gates    per muscle and quality gate: limit, worst value and its frame, frames that miss it, whether it is met
nlohmann::ordered_json report_data(const RecordedRun& run);

}  // namespace gracilis
