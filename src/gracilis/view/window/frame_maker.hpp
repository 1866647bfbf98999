#pragma once

#include <gracilis/geometry/decimation.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/pictures/vertex_stretch.hpp>
#include <gracilis/view/window/contact_depth.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Thins surfaces for a window, at rest and then frame by frame.
class FrameMaker {
 public:
  /// Surfaces at rest, m. Fills the faces, points and arrow roots of `shapes`.
  FrameMaker(std::vector<TriangleMesh> muscles, std::vector<TriangleMesh> bones, ShownShapes& shapes);

  /// Fills what follows from where the muscles' vertices are (whole surfaces), and frame.bones. Contact depths when
  /// asked for. One call at a time.
  void fill(const std::vector<Points>& muscles, std::vector<RigidTransform> bones, bool contact_depth,
            ShownFrame& frame);
  /// Fibers, and their lengths over those of the first call. At most 24 of a muscle's are shown.
  void fill_fibers(const std::vector<Polylines>& fibers, ShownFrame& frame);
  /// Of the fibers at each vertex (Pa), and of all fibers of each muscle (N); empty entries: nobody knows.
  void fill_stress(const std::vector<Eigen::VectorXd>& stresses, ShownFrame& frame) const;
  /// Of the fibers that are shown, N; `tensions` per muscle and fiber.
  static void fill_tension(const std::vector<Eigen::VectorXd>& tensions, ShownFrame& frame);

  /// Values per vertex of a muscle's whole surface, at those that are shown.
  template <class Value>
  std::vector<Value> shown_of(std::size_t muscle, const std::vector<Value>& values) const {
    std::vector<Value> result;
    for (const Index v : shown_[muscle]) result.push_back(values[static_cast<std::size_t>(v)]);
    return result;
  }
  /// What a muscle looks like, at the vertices that are shown.
  void paint(std::size_t muscle, const MuscleLook& look, ShownShapes& shapes) const;
  /// The vertices of a muscle's whole surface at which arrows begin.
  const std::vector<Index>& arrow_vertices(std::size_t muscle) const { return arrow_vertices_[muscle]; }
  const std::vector<TriangleMesh>& bones() const { return bones_; }  ///< at rest, m

 private:
  std::vector<TriangleMesh> muscles_, bones_;
  std::vector<std::vector<Index>> shown_, arrow_vertices_;  ///< per muscle
  std::vector<VertexStretch> stretch_;
  std::vector<Real> volumes_;  ///< at rest, m³
  std::vector<std::vector<Real>> fiber_lengths_;
  std::optional<ContactDepth> depth_;  ///< made when asked for at first
};

}  // namespace gracilis
