#pragma once

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/geometry/radial_basis.hpp>
#include <gracilis/methods/rbf/curvature_cost.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::rbf {

/// A muscle as radial basis functions, in the capture pose: f is the distance to its surface, negative inside, that
/// levels off within a band about it.
struct MuscleModel {
  RadialBasis rest;
  std::vector<Index> center_vertex;  ///< per center: the vertex whose motion carries it
  std::vector<char> is_free;         ///< per center; the others are attached to a bone
  CurvaturePoints curvature;         ///< at the centers and at vertices
  std::vector<Index> point_vertex;   ///< per point of `curvature`: the vertex whose motion carries it
  Eigen::VectorXd levels;            ///< f at every vertex, m
  Eigen::VectorXd offset_shares;     ///< per vertex: how much of an offset of its level it takes; less where it is thin
  Eigen::MatrixXi bound;             ///< per vertex: centers whose corrections it takes on
  Eigen::MatrixXd bound_shares;      ///< how much of each
  Points fit_points;                 ///< on and beside the surface: where f was fitted
  Eigen::VectorXd fit_values;        ///< of f there, m
  std::vector<Index> fit_vertex;     ///< per such point: the vertex whose motion carries it
  Real depth = 0;                    ///< m, of the centers below the surface
  Real spacing = 0;                  ///< m, between centers
};

/// Weights of the functions where their centers lie now, such that the field has the values at rest in points that
/// moved along: nearest to the given weights, in the sense of damped least squares. `points` are those of `fit_points`.
Eigen::VectorXd refitted_weights(const MuscleModel& model, const RadialBasis& moved, const Points& points);

/// `centers` at most, in and on the muscle's inside, with Gaussians that reach `reach_in_spacings` times as far as
/// centers lie apart. Throws InputError where the fit is singular.
MuscleModel muscle_model(const Muscle& muscle, const MeshTopology& topology, const BodyCarriers& carriers,
                         Index centers, Real reach_in_spacings);

}  // namespace gracilis::rbf
