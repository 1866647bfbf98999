#pragma once

#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <filesystem>

namespace gracilis::opensim {

/// A measured force on a body, such as a foot's on the floor, by natural cubic splines through the measured rows.
struct ExternalForce {
  std::string name;
  Index body = 0;                              ///< that it acts on
  Index force_frame = 0, point_frame = 0;      ///< bodies in whose axes force and torque, and the point, are given
  std::vector<Function> force, point, torque;  ///< of time: three each, or none
};

struct ExternalLoads {
  std::vector<ExternalForce> forces;
  Real begin = 0, end = 0;  ///< s, of the measured rows
};

/// Reads OpenSim's ExternalLoads file and the table that it names, which lies beside it. Throws InputError.
ExternalLoads read_external_loads(const Model& model, const std::filesystem::path& path);

/// Adds the loads at `time` (s) for bodies at `poses`.
void add_loads(const ExternalLoads& loads, Real time, const std::vector<RigidTransform>& poses, BodyForces& forces);

}  // namespace gracilis::opensim
