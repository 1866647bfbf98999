#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>

namespace gracilis {

/// A script for ParaView (File, Load State; or paraview --script=...) beside a run's run.pvd: shows the frames'
/// muscles, colored by muscle, and the bones where the frames say that they have moved.
std::string paraview_script(const Scene& scene);

}  // namespace gracilis
