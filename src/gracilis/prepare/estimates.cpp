#include <gracilis/prepare/estimates.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace gracilis {

static constexpr Real most_triangles = 2e6;
static constexpr Real time_per_triangle = 1e-4;  ///< s, on a machine of two cores

/// "1.1e+12"
static std::string rounded(Real value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// Triangles of half the edge length, which is what remeshing begins with: by the area, and for blades and needles by
/// the length of the edges.
static Real expected_triangles(const TriangleMesh& mesh, Real edge_length) {
  Real area = 0, length = 0;
  for (const Eigen::Vector3i face : mesh.faces.colwise()) {
    const Vec3 a = mesh.vertices.col(face[0]), b = mesh.vertices.col(face[1]), c = mesh.vertices.col(face[2]);
    area += (b - a).cross(c - a).norm() / 2;
    length += ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 2;
  }
  const Real edge = edge_length / 2;
  return std::max(area / (std::sqrt(3.0) / 4 * edge * edge), length / edge);
}

Problem out_of_time(const std::string& name, const PrepareSettings& settings) {
  return {"", name, "could not be prepared in " + rounded(settings.time_limit) + " s",
          "raise 'time_limit' or 'edge_length', or give fewer triangles"};
}

void require_affordable(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                        const PrepareSettings& settings) {
  std::vector<Problem> problems;
  for (const std::vector<NamedSurface>* surfaces : {&muscles, &bones})
    for (const NamedSurface& surface : *surfaces)
      if (!surface.mesh.vertices.allFinite())
        problems.push_back({"", surface.name, "has a coordinate that is not finite", "export the surface again"});
  for (const std::vector<NamedSurface>* surfaces : {&muscles, &bones})
    for (const NamedSurface& surface : *surfaces)
      if (Real(surface.mesh.face_count()) > most_triangles)
        problems.push_back({"", surface.name,
                            "has " + rounded(surface.mesh.face_count()) + " triangles; " + rounded(most_triangles) +
                                " are the most that are prepared",
                            "decimate it before"});
  if (settings.edge_length > 0 && problems.empty())
    for (const NamedSurface& muscle : muscles) {
      const Real triangles = expected_triangles(muscle.mesh, settings.edge_length);
      const Real seconds = triangles * time_per_triangle;
      if (triangles > most_triangles)
        problems.push_back({"", muscle.name,
                            "would have about " + rounded(triangles) + " triangles at an edge length of " +
                                rounded(1000 * settings.edge_length) + " mm; " + rounded(most_triangles) +
                                " are the most that are made",
                            "check its unit and its farthest vertices, or raise 'edge_length'"});
      else if (settings.time_limit > 0 && seconds > settings.time_limit)
        problems.push_back({"", muscle.name,
                            "would take about " + rounded(seconds) + " s, more than 'time_limit', for about " +
                                rounded(triangles) + " triangles",
                            "check its unit and its farthest vertices, or raise 'edge_length' or 'time_limit'"});
    }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void require_apart(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones) {
  std::vector<Problem> problems;
  std::vector<const NamedSurface*> all;
  for (const NamedSurface& muscle : muscles) all.push_back(&muscle);
  for (const NamedSurface& bone : bones) all.push_back(&bone);
  for (const NamedSurface* other : all) {
    if (other->mesh.face_count() == 0) continue;
    const Eigen::AlignedBox3d box = bounding_box(other->mesh.vertices);
    std::unique_ptr<SignedDistance> distance;
    for (const NamedSurface& muscle : muscles) {
      if (&muscle == other || muscle.mesh.vertex_count() == 0) continue;
      if (!box.intersects(bounding_box(muscle.mesh.vertices))) continue;
      if (!distance) distance = std::make_unique<SignedDistance>(other->mesh);
      const Real share = share_within(muscle.mesh, *distance, 0, 500);
      if (share > 0.5)
        problems.push_back({"", muscle.name,
                            "lies for the most part (" + std::to_string(std::lround(100 * share)) + " %) in " +
                                other->name + ": they cannot be pulled apart",
                            "check the unit and the place of both, or leave one out"});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace gracilis
