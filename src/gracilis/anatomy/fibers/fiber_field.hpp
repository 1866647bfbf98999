#pragma once

#include <gracilis/geometry/solid_grid.hpp>

#include <vector>

namespace gracilis {

/// Somebody saw a fiber run this way here.
struct DirectionSample {
  Vec3 place;
  Vec3 direction;   ///< unit
  Real weight = 1;  ///< its share in the whole
  Index tract = 0;  ///< samples of one tract are turned around together
};

/// Which way fibers run in a muscle, smooth, from origin to insertion.
class FiberField {
 public:
  /// Vectors at the nodes (3 × their count) that need not be unit, and the way over which a jump of directions is
  /// spread in them, m.
  FiberField(const SolidGrid& grid, Points vectors, Real smoothing)
      : grid_(&grid), vectors_(std::move(vectors)), smoothing_(smoothing) {}

  /// Unit; zero where nothing is known.
  Vec3 direction(const Vec3& p) const;
  const Points& vectors() const { return vectors_; }  ///< at the nodes, as given: 3 × their count
  Real smoothing() const { return smoothing_; }       ///< m

 private:
  const SolidGrid* grid_;
  Points vectors_;
  Real smoothing_;
};

/// The field of least \f$\ell^2 \int |\nabla v|^2 + \sum_i w_i |v - d_i|^2\f$, weights summing to the volume: a sample
/// speaks for what is as near as ℓ = `smoothing` (m), and beyond samples it goes on as it comes. Found from `start` on.
Points smooth_directions(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing,
                         const Points& start);

/// The same where samples may be noisy, turned around, or wrong: tracts are turned to agree with the field, and samples
/// count the less the more they are at odds with it (Geman and McClure's weights, their scale from the samples). How
/// smooth it is, and whether it may jump where two sides meet, is chosen so that the field fitted to a part of the
/// tracts tells the others best. Precondition: there is a sample.
FiberField fitted_field(const SolidGrid& grid, std::vector<DirectionSample> samples);

}  // namespace gracilis
