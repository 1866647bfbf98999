#pragma once

#include <gracilis/opensim/reader/model.hpp>

namespace gracilis::opensim {

/// How long a muscle's belly is on its line, m, at rest. Where belly_lengths.toml knows the muscle by its name: the
/// published length (Ward et al. 2009) but for what lies before lines that begin in the middle of a long origin, times
/// the muscle's own rest length (l_opt cos α + l_ts) over that of the same muscle in gait2392, so that it grows with
/// the model. Else l_opt cos α + √A / sin max(α, 10°): fibers side by side over a square of the physiological
/// cross-section A, their ends along an aponeurosis (this project's own). A is F_max over `specific_tension`, N/m².
/// Precondition: force and specific tension above 0.
Real belly_length(const Muscle& muscle, Real specific_tension);

/// Whether belly_length has a published length for the muscle.
bool has_published_belly(const Muscle& muscle);

/// The same length where the muscle's line of this length (m) allows it: a tenth of it at least is tendon, a fifth
/// belly.
Real belly_on_line(const Muscle& muscle, Real specific_tension, Real line);

}  // namespace gracilis::opensim
