#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>

#include <string>

namespace gracilis {

/// Of a recorded muscle: by its attachments, which newer runs tell, or else by where fibers end. Throws InputError when
/// the first frame is damaged.
MuscleLook recorded_look(const RecordedRun& run, const std::string& muscle);

}  // namespace gracilis
