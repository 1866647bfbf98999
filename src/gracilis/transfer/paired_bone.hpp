#pragma once

#include <gracilis/geometry/area_samples.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>

namespace gracilis {

/// A place on one surface and the nearest one on the other: of the template's surface as it is at rest, and of the
/// subject's.
struct PlacePairs {
  Points from, to;
  Points from_normals, to_normals;  ///< unit; the template's as it lies now
  Eigen::VectorXd distances;        ///< m, between the two as they lie now
  Index of_template = 0;  ///< so many pairs begin at samples of the template's surface, the others at the subject's

  Index count() const { return static_cast<Index>(from.cols()); }  ///< of pairs
  /// Whether the normals of a pair point about the same way: their cosine is above this.
  bool faces_alike(Index pair, Real least_cosine) const {
    return from_normals.col(pair).dot(to_normals.col(pair)) > least_cosine;
  }
};

/// A bone of the template and the subject's, with samples of both.
class PairedBone {
 public:
  /// Precondition: both have area.
  PairedBone(std::string name, TriangleMesh from, TriangleMesh to, Index samples);

  /// With the template's surface moved by linear * p + shift, invertible.
  PlacePairs pairs(const Eigen::Matrix3d& linear, const Vec3& shift) const;
  /// With the template's vertices at `moved`.
  PlacePairs pairs(const Points& moved) const;

  const std::string& name() const { return name_; }                ///< of both bones
  const TriangleMesh& from() const { return from_; }               ///< the template's, at rest, m
  const TriangleMesh& to() const { return to_; }                   ///< the subject's, m
  const Points& from_points() const { return from_points_; }       ///< samples of it
  const Points& to_points() const { return to_points_; }           ///< likewise
  const NearestTriangle& from_tree() const { return from_tree_; }  ///< of the template's
  const NearestTriangle& to_tree() const { return to_tree_; }      ///< of the subject's

 private:
  std::string name_;
  TriangleMesh from_, to_;
  AreaSamples from_samples_, to_samples_;
  Points from_points_, from_normals_, to_points_, to_normals_;
  NearestTriangle from_tree_, to_tree_;
};

}  // namespace gracilis
