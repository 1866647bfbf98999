#pragma once

#include <gracilis/dynamics/contact/self/self_intersections.hpp>

#include <numeric>
#include <vector>

namespace gracilis {

/// A surface and where its particles are, at first at rest.
struct Sheet {
  ContactSurface surface;
  Eigen::Matrix3Xf rest;
  Particles particles, before;

  explicit Sheet(const TriangleMesh& mesh, Real inverse_mass = 1)
      : surface(build_contact_surface(mesh.faces, mesh.vertex_count())),
        rest(mesh.vertices.cast<float>()),
        particles(make_particles(mesh.vertices, Eigen::VectorXd::Constant(mesh.vertex_count(), inverse_mass))),
        before(particles) {}

  std::vector<Index> all_faces() const {
    std::vector<Index> faces(static_cast<std::size_t>(surface.faces.cols()));
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
  std::vector<FacePair> cuts() const { return find_self_intersections(surface, rest, before, particles, all_faces()); }
  std::vector<FacePair> folds() const { return find_folds(surface, rest, before, particles); }
  void carry(const Eigen::Matrix3f& linear, const Eigen::Vector3f& by) {
    for (Index p = 0; p < particles.count(); ++p) particles.position(p) = linear * rest.col(p) + by;
  }
};

}  // namespace gracilis
