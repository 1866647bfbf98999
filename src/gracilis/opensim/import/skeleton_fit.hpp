#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// Where one of a model's bodies lies in another skeleton, and what is corrected by hand (Laclé 2014, section 3.3.3).
struct BodyFit {
  std::string body;
  /// Ground frame, m: the joint that carries the body, and the one at its other end. Without them the body keeps its
  /// size and follows the one that carries it.
  std::optional<Vec3> start, end;
  std::string toward;         ///< the body at the other end; empty: the first that it carries
  Vec3 scale = Vec3::Ones();  ///< corrections: factors along the body's axes,
  Vec3 turn = Vec3::Zero();   ///< rad, about the ground's x, then the new y and z,
  Vec3 shift = Vec3::Zero();  ///< m, in the ground frame
};

/// The model in the other skeleton: every body is scaled by the ratio of its lengths, between its joints, and turned by
/// the shortest arc from its direction in the model's default pose to that in the skeleton; then corrected. Points of
/// paths, wrap objects, surfaces and frames go with their bodies; joints are placed anew so that the default
/// coordinates give the skeleton's pose. Muscles' fiber and tendon lengths change as their lines do (eqs. 3.9 and
/// 3.10); masses stay. Throws InputError for bodies that do not exist, and for lengths that are zero.
Model fit_to_skeleton(const Model& model, const std::vector<BodyFit>& fits);

/// Tables [bodies.NAME] with start_mm, end_mm, toward, scale, turn_deg, shift_mm, all of them optional. Throws
/// InputError.
std::vector<BodyFit> read_skeleton_fit(const std::filesystem::path& path);

}  // namespace gracilis::opensim
