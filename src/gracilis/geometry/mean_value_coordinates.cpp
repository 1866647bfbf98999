#include <gracilis/geometry/mean_value_coordinates.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

namespace {

/// Of the arc between two vertices as seen from the point: its angle θ, and sine and cosine of half of it.
struct SeenArc {
  Real angle, half_sine, half_cosine;
  Real sine() const { return 2 * half_sine * half_cosine; }
};

/// sin(a + b + c) from sines and cosines.
Real sine_of_sum(Real sa, Real ca, Real sb, Real cb, Real sc, Real cc) {
  return sa * cb * cc + ca * sb * cc + ca * cb * sc - sa * sb * sc;
}

}  // namespace

MeanValueCoordinates::MeanValueCoordinates(const TriangleMesh& surface) : surface_(surface) {
  const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
  face_edges_.resize(3, surface.face_count());
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const MeshEdge& edge = topology.edges[e];
    edges_.emplace_back(edge.a, edge.b);
    for (const auto& [face, apex] : {std::pair{edge.left, edge.left_apex}, std::pair{edge.right, edge.right_apex}})
      for (int k = 0; face >= 0 && k < 3; ++k)
        if (surface.faces(k, face) == apex) face_edges_(k, face) = static_cast<Index>(e);
  }
}

Eigen::VectorXd MeanValueCoordinates::weights(const Vec3& p) const {
  constexpr Real on_vertex = 1e-14, around = 1e-6, in_face = 1e-12, in_plane = 1e-10;
  const Index n = surface_.vertex_count();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  Points directions = surface_.vertices.colwise() - p;
  const Eigen::RowVectorXd distances = directions.colwise().norm();
  Index nearest = 0;
  if (distances.minCoeff(&nearest) <= on_vertex * distances.maxCoeff()) {
    weights[nearest] = 1;
    return weights;
  }
  directions.array().rowwise() /= distances.array();

  std::vector<SeenArc> arcs(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Real half = std::min((directions.col(edges_[e][0]) - directions.col(edges_[e][1])).norm() / 2, Real{1});
    arcs[e] = {2 * std::asin(half), half, std::sqrt(1 - half * half)};
  }
  for (Index f = 0; f < surface_.face_count(); ++f) {
    const Eigen::Vector3i v = surface_.faces.col(f), e = face_edges_.col(f);
    const std::array<SeenArc, 3> arc = {arcs[static_cast<std::size_t>(e[0])], arcs[static_cast<std::size_t>(e[1])],
                                        arcs[static_cast<std::size_t>(e[2])]};
    const auto sum = [&](Real s0, Real s1, Real s2) {
      return sine_of_sum(s0 * arc[0].half_sine, arc[0].half_cosine, s1 * arc[1].half_sine, arc[1].half_cosine,
                         s2 * arc[2].half_sine, arc[2].half_cosine);
    };
    const std::array<Real, 3> sines = {arc[0].sine(), arc[1].sine(), arc[2].sine()};
    const Vec3 u0 = directions.col(v[0]), u1 = directions.col(v[1]), u2 = directions.col(v[2]);
    const Real volume = u0.dot(u1.cross(u2)), sign = volume < 0 ? -1 : 1;
    // Seen from inside a face its corners lie all around and in one plane.
    if (std::abs(volume) < in_face && pi - (arc[0].angle + arc[1].angle + arc[2].angle) / 2 < around) {
      weights.setZero();
      for (int k = 0; k < 3; ++k)
        weights[v[k]] = sines[static_cast<std::size_t>(k)] * distances[v[(k + 1) % 3]] * distances[v[(k + 2) % 3]];
      return weights / weights.sum();
    }
    // Angles of the spherical triangle at its corners: cosines c from the half sum of its sides, sines s from its
    // volume, which keeps digits where the cosine is nearly 1.
    const Real all = sum(1, 1, 1);
    const std::array<Real, 3> others = {sum(-1, 1, 1), sum(1, -1, 1), sum(1, 1, -1)};
    std::array<Real, 3> c{}, s{};
    bool seen_from_the_side = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Real product = sines[(k + 1) % 3] * sines[(k + 2) % 3];
      c[k] = std::clamp(2 * all * others[k] / product - 1, Real{-1}, Real{1});
      s[k] = std::abs(volume) / product;
      seen_from_the_side |= !(s[k] > in_plane);
    }
    if (seen_from_the_side) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      weights[v[static_cast<int>(k)]] += sign * (arc[k].angle - c[next] * arc[last].angle - c[last] * arc[next].angle) /
                                         (distances[v[static_cast<int>(k)]] * sines[next] * s[last]);
    }
  }
  return weights / weights.sum();
}

}  // namespace gracilis
