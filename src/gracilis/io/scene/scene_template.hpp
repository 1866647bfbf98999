#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>

namespace gracilis {

/// A complete scene file in TOML that explains every key it may have; each setting stands with its unit, range and
/// default. It reads back without a problem as far as the files go that it names as examples.
std::string scene_template();

/// Every setting of a scene as resolved, muscle by muscle, in the keys of a scene file.
std::string settings_text(const Scene& scene);

}  // namespace gracilis
