#pragma once

#include <gracilis/geometry/thin_plate.hpp>
#include <gracilis/transfer/similarity.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// How far a template's bone, laid on the subject's, lies from it.
struct BoneFit {
  Real to_subject = 0;   ///< m, root mean square from the template's surface, where it has a counterpart
  Real to_template = 0;  ///< m, likewise from the subject's surface
  Real p95 = 0;          ///< m, of both: so many of 100 are nearer
  Real worst = 0;        ///< m, where there is a counterpart
  Real all = 0;          ///< m, root mean square both ways with what has no counterpart
  Real trimmed_template = 0, trimmed_subject = 0;  ///< share of the surface without a counterpart
};

struct RegisteredBone {
  Similarity similarity;  ///< where the deformation began
  Real similar = 0;       ///< m, root mean square both ways by the similarity alone, of the nearest 80 %
  ThinPlateMap map;       ///< of the template's surface and what is near
  BoneFit fit;
};

/// From a similarity the template's surface is deformed, coarse to fine, by thin plate splines that bend as little as
/// they must, each place towards the nearest one on the subject's surface and each of the subject's towards it, along
/// the normal mostly. What is far in comparison with the rest, or faces another way, does not count, so that either
/// surface may lack a part.
RegisteredBone register_bone(const PairedBone& bone, const NamedPoints& named, const Similarity& start);

/// Distances of a deformed surface. A place has no counterpart where it is farther from the other surface than
/// `far` times the middle one of all distances (and a hundredth of the size), or faces another way.
BoneFit measure_fit(const PairedBone& bone, const Points& moved);

}  // namespace gracilis
