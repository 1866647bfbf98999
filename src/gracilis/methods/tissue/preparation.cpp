#include <gracilis/methods/tissue/preparation.hpp>

#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/tissue/fiber_flux.hpp>
#include <gracilis/methods/tissue/lattice_field.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::tissue {

namespace {

/// How firmly fascia grips harmonic fields, as attachments do.
constexpr Real fascia_grip = 10;

void place_points(const Muscle& muscle, PreparedTissue& prepared) {
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  prepared.points.resize(static_cast<std::size_t>(muscle.surface.vertex_count()));
  for (std::size_t v = 0; v < prepared.points.size(); ++v) {
    SurfacePoint& point = prepared.points[v];
    point.rest = muscle.surface.vertices.col(static_cast<Index>(v));
    point.area = point.vertex_area = areas[static_cast<Index>(v)];
    point.at = embed(prepared.lattice, point.rest);
  }
  prepared.vertex_count = muscle.surface.vertex_count();
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) {
      prepared.points[static_cast<std::size_t>(v)].held_by = attachment.body;
      prepared.points[static_cast<std::size_t>(v)].end = attachment.end;
    }
}

/// What acts on triangles acts on points of them, or tissue would sag between their corners and the surface would lose
/// volume: as close as a cell, and half of one where they are held and so much stiffer.
void spread_over_triangles(const TriangleMesh& surface, PreparedTissue& prepared) {
  for (Index f = 0; f < surface.face_count(); ++f) {
    const auto corner = [&](Index k) -> SurfacePoint& {  // anew each time: points grow
      return prepared.points[static_cast<std::size_t>(surface.faces(k, f))];
    };
    const Index body = corner(0).held_by;
    const AttachmentEnd end = corner(0).end;
    if (corner(1).held_by != body || corner(2).held_by != body) continue;
    const Real spacing = prepared.lattice.cell_size / (body < 0 ? 1 : 2);
    const Vec3 a = corner(0).rest, ab = corner(1).rest - a, ac = corner(2).rest - a;
    const Real longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const int pieces = static_cast<int>(std::ceil(longest / spacing));
    const Real area = ab.cross(ac).norm() / 2;
    if (pieces < 2) {
      for (Index k = 0; k < 3 && body >= 0; ++k) corner(k).held_area += area / 3;
      continue;
    }
    for (Index k = 0; k < 3; ++k) corner(k).area -= area / 3;
    const auto add = [&](Real u, Real v) {
      SurfacePoint point;
      point.rest = a + u / pieces * ab + v / pieces * ac;
      point.at = embed(prepared.lattice, point.rest);
      point.area = area / (pieces * pieces);
      point.held_by = body;
      point.held_area = body >= 0 ? point.area : 0;
      point.end = end;
      // A triangle may cut the corner of a cell that is none.
      if (point.at.cell < 0)
        corner(0).area += point.area;
      else
        prepared.points.push_back(point);
    };
    // The middles of the equal triangles that it falls into.
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; i + j < pieces; ++j) {
        add(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j + 1 < pieces) add(i + 2.0 / 3, j + 2.0 / 3);
      }
  }
  for (SurfacePoint& point : prepared.points) point.area = std::max(point.area, 0.0);
}

/// How far each point is from the nearest bone of each body of the scene, m, at most `reach`; a column a point.
Eigen::MatrixXd distances_to_bodies(const Scene& scene, const std::vector<SignedDistance>& distances,
                                    const std::vector<SurfacePoint>& points, Real reach) {
  const auto count = static_cast<Index>(points.size());
  Eigen::MatrixXd nearest = Eigen::MatrixXd::Constant(static_cast<Index>(scene.bodies.size()), count, reach);
  parallel_for(count, 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v)
      for (std::size_t b = 0; b < distances.size(); ++b) {
        Real& of_body = nearest(scene.bones[b].body, v);
        of_body = std::min(of_body, distances[b].query(points[static_cast<std::size_t>(v)].rest, reach).distance);
      }
  });
  return nearest;
}

/// Every free vertex within reach of a body's bones is tied to that body, the more weakly the further it is away: once,
/// whatever pieces its bones come in. Where fibers gather in a tendon they glide more easily.
void tie_to_bodies(const Scene& scene, const std::vector<SignedDistance>& distances, PreparedTissue& prepared) {
  const TissueSettings& settings = prepared.settings;
  const Eigen::MatrixXd nearest = distances_to_bodies(scene, distances, prepared.points, settings.fascia_reach);
  for (Index v = 0; v < nearest.cols(); ++v) {
    SurfacePoint& point = prepared.points[static_cast<std::size_t>(v)];
    point.ties_begin = static_cast<Index>(prepared.ties.size());
    const Real gliding = std::min(1.0, 1 / prepared.relative_tension[static_cast<std::size_t>(point.at.cell)]);
    for (Index body = 0; body < nearest.rows() && point.held_by < 0; ++body) {
      const Real share = 1 - std::max(0.0, nearest(body, v)) / settings.fascia_reach;
      if (share > 0 && settings.fascia_stiffness > 0)
        prepared.ties.push_back(
            {body, prepared.directions.col(point.at.cell), settings.fascia_stiffness * point.area * share * gliding});
    }
    point.ties_end = static_cast<Index>(prepared.ties.size());
  }
}

void find_fibers(const Muscle& muscle, PreparedTissue& prepared) {
  const Polylines fibers = fibers_of(muscle);
  for (Index f = 0; f < fibers.count(); ++f) {
    const Points line = fibers.line(f);
    std::vector<Index>& cells = prepared.fiber_cells.emplace_back();
    for (Index i = 0; i + 1 < static_cast<Index>(line.cols()); ++i)
      if (const Index c = embed(prepared.lattice, (line.col(i) + line.col(i + 1)) / 2).cell; c >= 0) cells.push_back(c);
  }
}

void keep_gaps(const Scene& scene, const std::vector<DistanceField>& fields,
               const std::vector<SignedDistance>& distances, PreparedTissue& prepared) {
  for (std::size_t b = 0; b < fields.size(); ++b) {
    BoneGap bone{scene.bones[b].body, bounded(fields[b]), {}, {}, {}};
    for (const SurfacePoint& point : prepared.points)
      bone.gaps.push_back(
          std::min(prepared.settings.contact_gap, sample_spline_precise(bone.field.grid, point.rest).distance));
    // Far ones need not be asked: the field is not that wrong.
    const auto seen_least = [&](const Vec3& rest, Real by_field) {
      return by_field < seen_clearance + field_error ? std::min(seen_clearance, distances[b].query(rest).distance)
                                                     : seen_clearance;
    };
    for (Index v = 0; v < prepared.vertex_count; ++v) {
      const auto p = static_cast<std::size_t>(v);
      const bool is_held = prepared.points[p].held_by >= 0;  // it goes with its bone
      bone.seen_least.push_back(is_held ? seen_clearance : seen_least(prepared.points[p].rest, bone.gaps[p]));
    }
    for (const auto& [first, second] : prepared.edges) {
      const Vec3 middle = (prepared.points[static_cast<std::size_t>(first)].rest +
                           prepared.points[static_cast<std::size_t>(second)].rest) /
                          2;
      bone.edge_least.push_back(seen_least(middle, sample_spline_precise(bone.field.grid, middle).distance));
    }
    prepared.bones.push_back(std::move(bone));
  }
}

void list_edges(const TriangleMesh& surface, PreparedTissue& prepared) {
  prepared.faces = surface.faces;
  const auto is_free = [&](Index v) { return prepared.points[static_cast<std::size_t>(v)].held_by < 0; };
  for (const MeshEdge& edge : build_topology(surface.faces, surface.vertex_count()).edges)
    if (is_free(edge.a) || is_free(edge.b)) prepared.edges.push_back({edge.a, edge.b});
  std::vector<Index> ends;
  for (const auto& edge : prepared.edges) ends.insert(ends.end(), edge.begin(), edge.end());
  prepared.edges_of_vertices = group_by_key(ends, prepared.vertex_count);
}

void see_large_faces(const TriangleMesh& surface, PreparedTissue& prepared) {
  prepared.volume = enclosed_volume(surface.vertices, surface.faces);
  std::vector<char> is_free;
  for (Index v = 0; v < prepared.vertex_count; ++v)
    is_free.push_back(prepared.points[static_cast<std::size_t>(v)].held_by < 0);
  LargeFaces& large = prepared.large_faces = find_large_faces(surface, is_free, prepared.lattice);
  for (const BoneGap& bone : prepared.bones) {
    std::vector<Real>& least = large.least.emplace_back();
    for (const FacePlace& kept : large.kept) {
      Vec3 p = Vec3::Zero();
      for (Index k = 0; k < 3; ++k)
        p += kept.shares[k] * surface.vertices.col(kept.corners[static_cast<std::size_t>(k)]);
      least.push_back(std::min(seen_clearance, sample_spline_precise(bone.field.grid, p).distance));
    }
  }
}

/// Each node follows the bodies by harmonic shares that attachments and fascia draw to their own.
void share_carriers(PreparedTissue& prepared) {
  const auto column_of = [&](Index body) {
    const auto found = std::find(prepared.carriers.begin(), prepared.carriers.end(), body);
    if (found == prepared.carriers.end()) prepared.carriers.push_back(body);
    return static_cast<Index>(std::find(prepared.carriers.begin(), prepared.carriers.end(), body) -
                              prepared.carriers.begin());
  };
  std::vector<FieldGrip> grips;
  const Real cell = prepared.lattice.cell_size;
  const Real tie_scale = fascia_grip / std::max(prepared.settings.fascia_stiffness, 1e-30) / cell;
  for (const SurfacePoint& point : prepared.points) {
    if (point.held_by >= 0) grips.push_back({point.at, attachment_grip * point.area / cell, column_of(point.held_by)});
    for (Index t = point.ties_begin; t < point.ties_end; ++t) {
      const Tie& tie = prepared.ties[static_cast<std::size_t>(t)];
      grips.push_back({point.at, tie_scale * tie.stiffness, column_of(tie.body)});
    }
  }
  prepared.skinning_weights =
      harmonic_lattice_fields(prepared.lattice, grips, static_cast<Index>(prepared.carriers.size()))
          .cwiseMax(0)
          .cwiseMin(1);
  for (Index n = 0; n < prepared.skinning_weights.rows(); ++n)
    if (const Real sum = prepared.skinning_weights.row(n).sum(); sum > 0) prepared.skinning_weights.row(n) /= sum;
}

Real cell_size_of(const TissueSettings& settings, const TriangleMesh& surface) {
  const Real volume = std::abs(enclosed_volume(surface.vertices, surface.faces));
  if (settings.cells_at_least == 0 || !(volume > 0)) return settings.cell_size;
  return std::min(settings.cell_size, std::cbrt(volume / settings.cells_at_least));
}

}  // namespace

void sort_by_nodes(PreparedTissue& prepared) {
  prepared.cells = cell_lanes(prepared.lattice);
  prepared.point_weights.clear();
  std::vector<Index> node_of_point, node_of_corner;
  for (const SurfacePoint& point : prepared.points) {
    node_of_point.insert(node_of_point.end(), point.at.nodes.begin(), point.at.nodes.end());
    prepared.point_weights.insert(prepared.point_weights.end(), point.at.weights.begin(), point.at.weights.end());
  }
  for (const std::int64_t corner : prepared.cells.corners) node_of_corner.push_back(static_cast<Index>(corner / 3));
  prepared.points_of_nodes = group_by_key(node_of_point, prepared.lattice.node_count());
  prepared.corners_of_nodes = group_by_key(node_of_corner, prepared.lattice.node_count());
}

PreparedTissue prepare_tissue(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                              const std::vector<SignedDistance>& distances) {
  PreparedTissue prepared;
  prepared.name = muscle.name;
  prepared.settings = tissue_settings(scene, muscle);
  prepared.lattice = build_lattice(muscle.surface, cell_size_of(prepared.settings, muscle.surface));
  place_points(muscle, prepared);
  spread_over_triangles(muscle.surface, prepared);
  lay_fibers(prepared);
  find_fibers(muscle, prepared);
  tie_to_bodies(scene, distances, prepared);
  list_edges(muscle.surface, prepared);
  keep_gaps(scene, fields, distances, prepared);
  see_large_faces(muscle.surface, prepared);
  sort_by_nodes(prepared);
  share_carriers(prepared);
  return prepared;
}

std::vector<CellLaw> cell_laws(const PreparedTissue& muscle, Real activation, Real tension) {
  const TissueSettings& s = muscle.settings;
  const FiberLaw fibers{tension * s.fiber_tension, tension * s.fiber_stiffness,
                        tension * activation * s.largest_active_stress, s.optimal_stretch};
  std::vector<CellLaw> laws(muscle.lattice.cells.size());
  for (std::size_t c = 0; c < laws.size(); ++c) {
    const Real pull = muscle.relative_tension[c] * (fibers.rest_tension + fibers.active_tension);
    laws[c].matrix = {std::max(s.matrix_shear_modulus, s.shear_per_tension * pull), s.matrix_lambda,
                      s.matrix_stiffening};
    laws[c].bulk = std::max(s.bulk_modulus, s.bulk_per_tension * pull);
    laws[c].fibers = fibers.scaled(muscle.relative_tension[c]);
    laws[c].direction = muscle.directions.col(static_cast<Index>(c));
  }
  return laws;
}

}  // namespace gracilis::tissue
