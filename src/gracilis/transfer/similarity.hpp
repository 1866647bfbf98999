#pragma once

#include <gracilis/transfer/paired_bone.hpp>

#include <vector>

namespace gracilis {

/// A turn, a scale and a shift: p ↦ scale * rotation * p + shift.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Real scale = 1;
  Vec3 shift = Vec3::Zero();

  Eigen::Matrix3d linear() const { return scale * rotation; }    ///< scale * rotation
  Vec3 at(const Vec3& p) const { return linear() * p + shift; }  ///< where it takes p
};

/// Points known by name on both sides; they count as much as all surface together.
struct NamedPoints {
  Points from = Points(3, 0), to = Points(3, 0);

  Index count() const { return static_cast<Index>(from.cols()); }  ///< of pairs
};

struct SimilarityFit {
  Similarity similarity;
  Real error = 0;  ///< root mean square of the nearest `counted_share` of all distances, over the subject's size
};

/// The share of both surfaces that counts: the rest may be what one of the two lacks.
inline constexpr Real counted_share = 0.8;

/// Trimmed closest points, both ways (Chetverikov et al. 2005), for bones that move as one.
SimilarityFit closest_similarity(const std::vector<const PairedBone*>& bones, const NamedPoints& named,
                                 const Similarity& start);

/// The turn that is nearest to `turn`, with scale and shift by the bones' extent.
Similarity turned(const std::vector<const PairedBone*>& bones, const Eigen::Matrix3d& turn);

/// The four proper turns that take the principal axes of the one to those of the other.
std::vector<Eigen::Matrix3d> principal_turns(const std::vector<const PairedBone*>& bones);

}  // namespace gracilis
