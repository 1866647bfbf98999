#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/fiber_settings.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<DistanceFieldSettings>> setting_table() {
  using S = DistanceFieldSettings;
  static const Setting<S> table[] = {
      {"cell_size", &S::cell_size, "m", 1e-5, 1, "Edge of the grid's cells; used where resolution is 0."},
      {"resolution", &S::resolution, "", 0, 1024, "Cells along each axis; 0 takes cell_size instead."},
      {"domain_margin", &S::domain_margin, "m", 0, 1, "Width of the grid around the bone's bounding box."},
      {"domain_factor", &S::domain_factor, "", 1, 10, "The bounding box is scaled by this about its center first."},
  };
  return table;
}

template <>
std::span<const Setting<FiberSettings>> setting_table() {
  using S = FiberSettings;
  static const Setting<S> table[] = {
      {"count", &S::count, "", 0, 100000, "Fibers inside the muscle; 0 makes none."},
      {"segments", &S::segments, "", 1, 10000, "Pieces of each fiber."},
      {"shape", &S::shape, "", 0, 0,
       "How fibers run from origin to insertion: side by side, at an angle, in arcs, or drawn together at the "
       "insertion."},
      {"pennation", &S::pennation, "rad", -1.2, 1.2, "Angle of pennate fibers to the muscle's axis."},
      {"curvature", &S::curvature, "", -0.5, 0.5,
       "Largest deflection of curved fibers, as a share of the muscle's width."},
      {"convergence", &S::convergence, "", 0, 1,
       "How far a fan draws together at the insertion: 0 not at all, 1 to a point."},
      {"smoothing", &S::smoothing, "", 0, 10000, "Rounds of smoothing; the fibers' ends stay in place."},
  };
  return table;
}

template <>
std::span<const Setting<ContractionSettings>> setting_table() {
  using S = ContractionSettings;
  static const Setting<S> table[] = {
      {"threshold", &S::threshold, "", 0, 1, "Activation above which a muscle contracts."},
      {"shortest", &S::shortest, "", 0.1, 1,
       "A segment of a surface fiber aims at its length at rest times the larger of this and 1 - activation."},
      {"stiffness", &S::stiffness, "N/m", 0, 1e18,
       "Tension across each metre of the surface's width per relative excess length, however many fibers there are; "
       "full from the activation on at which segments aim at the shortest."},
      {"spread", &S::spread, "", 0, 0,
       "All edges that run along the fibers pull, by their direction; false: only the edges that fibers carried onto "
       "the surface pass through, as published."},
      {"paths", &S::paths, "", 0, 0,
       "How fibers are carried onto the surface, without spread: 'along_fibers' follows their direction, "
       "'nearest_joined' is "
       "the published way by nearest vertices."},
      {"segments", &S::segments, "", 1, 10000, "Pieces of each fiber that is carried onto the surface."},
  };
  return table;
}

template <>
std::span<const Setting<Sequence>> setting_table() {
  using S = Sequence;
  static const Setting<S> table[] = {
      {"ramp_frames", &S::ramp_frames, "", 0, 100000,
       "Frames from the capture pose to the motion's first pose; 0 takes as many as steps of 1 degree need."},
      {"settle_frames", &S::settle_frames, "", 0, 100000,
       "Frames that repeat the motion's first pose before it begins, in which muscles come to rest. 'gracilis rom' "
       "holds 30 where this is 0."},
      {"hold_frames", &S::hold_frames, "", 0, 100000, "Frames that repeat the motion's last pose."},
      {"return_to_capture", &S::return_to_capture, "", 0, 0, "Ends with a ramp back to the capture pose."},
  };
  return table;
}

template <>
std::span<const Setting<PrepareSettings>> setting_table() {
  using S = PrepareSettings;
  static const Setting<S> table[] = {
      {"edge_length", &S::edge_length, "m", 0, 0.1, "Edge length of the new triangles; 0 keeps the triangles."},
      {"remeshing_rounds", &S::remeshing_rounds, "", 1, 100,
       "Rounds of splitting, collapsing, flipping and smoothing edges."},
      {"smoothing_rounds", &S::smoothing_rounds, "", 0, 1000, "Rounds of smoothing the whole surface first."},
      {"rounding_rounds", &S::rounding_rounds, "", 0, 1000,
       "Rounds of smoothing spikes and rims at which the surface turns by more than 80 degrees."},
      {"muscle_gap", &S::muscle_gap, "m", 0, 0.01, "Gap that is made between two muscles where they are closer."},
      {"bone_gap", &S::bone_gap, "m", 0, 0.01, "Gap that is made between a muscle and a bone where they are closer."},
  };
  return table;
}

}  // namespace gracilis
