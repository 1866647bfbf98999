#pragma once

#include <gracilis/methods/registry.hpp>

#include <scenes_for_tests.hpp>

#include "line_scene.hpp"

#include <functional>
#include <initializer_list>
#include <ostream>
#include <set>
#include <string>
#include <vector>

/// Methods under several settings, and what each of them claims.
namespace gracilis {

/// What a method may claim. Frame 0, the error for a pose that is not finite, the same bits for any number of threads
/// and after a resume are asked of all.
enum class Property {
  rest_stays,    ///< at the capture pose nothing moves
  rigid_motion,  ///< of all bodies moves the result rigidly
  any_jump,      ///< gives finite shapes; without this claim it may also be an error
  volume,        ///< stays within 1 % through 45 degrees
  capture_pose,  ///< is come back to within 1 mm
  pieces         ///< of one body's bones that lie in each other hold and push a muscle as one
};
using Claims = std::set<Property>;
inline const Claims everything = {Property::rest_stays, Property::rigid_motion, Property::any_jump,
                                  Property::volume,     Property::capture_pose, Property::pieces};

inline Claims all_but(std::initializer_list<Property> missing) {
  Claims claims = everything;
  for (const Property each : missing) claims.erase(each);
  return claims;
}

struct Variant {
  std::string name, method;
  Claims claims;
  SettingValues settings = {};
  std::function<Scene()> scene = [] { return tube_scene(); };  ///< with two bodies and a hinge between them
};

inline void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

/// A new method is one line here, which says what it claims.
inline std::vector<Variant> all_variants() {
  const Preset thesis = *find_preset("thesis-2024"), pbd_2020 = *find_preset("pbd-2020");
  return {
      {"skinning", "skinning", all_but({Property::volume, Property::any_jump})},
      // Frame 0 is the input; then the fibers come under tension, which moves it a little.
      {"tissue", "tissue", all_but({Property::rest_stays, Property::capture_pose})},
      // Two muscles together are not at rest after a frame's iterations, and rounding decides where they are then (0.06
      // mm).
      {"tissue_end_on_muscle",
       "tissue",
       all_but({Property::rest_stays, Property::capture_pose, Property::rigid_motion}),
       {},
       [] { return end_on_muscle_scene(); }},
      {"cylinder", "cylinder", all_but({Property::volume}), {}, [] { return line_scene(0.05); }},
      // A blend of the bones' motions carries the line through its middle.
      {"cylinder_surface", "cylinder", all_but({Property::volume, Property::any_jump})},
      {"xpbd_physical", "xpbd", everything},
      {"xpbd_substeps", "xpbd", everything, {{"substeps", 3}, {"iterations", 12}}},
      {"xpbd_dynamic", "xpbd", everything, {{"time_mode", "dynamic"}}},
      {"xpbd_dynamic_substeps", "xpbd", everything, {{"time_mode", "dynamic"}, {"substeps", 2}, {"iterations", 15}}},
      {"xpbd_dynamic_frames", "xpbd", everything, {{"time_mode", "dynamic"}, {"time_step", 0.0}}},
      {"xpbd_coarser_copy", "xpbd", everything, {{"simulated_edge", 0.006}, {"full_iterations", 1}}},
      {"xpbd_coarser_copy_dynamic", "xpbd", everything, {{"simulated_edge", 0.006}, {"time_mode", "dynamic"}}},
      // Edges are drawn through bones, and of the points of such an edge rounding decides which one is brought out.
      {"xpbd_arap", "xpbd", all_but({Property::rigid_motion, Property::pieces}), {{"predictor", "arap"}}},
      {"xpbd_arap_vertices", "xpbd", all_but({Property::pieces}), {{"predictor", "arap"}, {"edge_contact", false}}},
      {"xpbd_dissipative", "xpbd", everything, {{"rayleigh_beta", 0.01}}},
      {"xpbd_end_on_muscle", "xpbd", everything, {}, [] { return end_on_muscle_scene(); }},
      {"xpbd_end_on_muscle_copy",
       "xpbd",
       everything,
       {{"simulated_edge", 0.006}, {"full_iterations", 1}},
       [] { return end_on_muscle_scene(); }},
      // As published: free vertices follow only through constraints, and the margin pushes muscles off bones at rest.
      {"xpbd_thesis_2024", "xpbd", {}, thesis.method.settings},
      {"arap", "arap", everything},
      {"arap_end_on_muscle", "arap", everything, {}, [] { return end_on_muscle_scene(); }},
      {"strings", "strings", everything},
      {"strings_end_on_muscle", "strings", everything, {}, [] { return end_on_muscle_scene(); }},
      {"rbf", "rbf", everything},
      // As published neither volume nor contact are asked for, and centers are drawn to where they were in space.
      {"rbf_2024", "rbf", all_but({Property::rigid_motion, Property::volume}),
       find_preset("rbf-2024")->method.settings},
      {"mass_spring", "mass-spring", all_but({Property::volume})},
      {"mass_spring_last", "mass-spring", all_but({Property::volume}), {{"start_from", "last"}}},
      // Each piece has its own spheres.
      {"mass_spring_spheres",
       "mass-spring",
       all_but({Property::volume, Property::pieces}),
       {{"bone_collision", "spheres"}}},
      // As published spheres that overlap at rest are pushed apart.
      {"janak_2012",
       "mass-spring",
       {Property::rigid_motion, Property::any_jump},
       find_preset("janak-2012")->method.settings},
      {"pbd", "pbd", all_but({Property::capture_pose})},
      {"pbd_voxels", "pbd", all_but({Property::capture_pose}), {{"collision", "voxels"}}},
      {"pbd_arap", "pbd", all_but({Property::capture_pose, Property::pieces}), {{"predictor", "arap"}}},
      // As published free vertices follow only through constraints, and so remember by which way they came.
      {"pbd_2020", "pbd", all_but({Property::rigid_motion, Property::capture_pose}), pbd_2020.method.settings},
  };
}

}  // namespace gracilis
