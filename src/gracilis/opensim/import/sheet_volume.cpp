#include <gracilis/opensim/import/sheet_volume.hpp>

#include <gracilis/anatomy/sections/sheet.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_tree.hpp>
#include <gracilis/opensim/import/muscle_names.hpp>
#include <gracilis/opensim/import/sheet_heads.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis::opensim {

/// Parts of a section's side such that they are, on average, as long as those between sections.
static Index side_of(const std::vector<SheetHead>& heads) {
  Real width = 0, length = 0;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    length += polyline_length(heads[h].centers) / static_cast<Real>(heads.size());
    if (h > 0) width += (heads[h].centers - heads[h - 1].centers).colwise().norm().mean();
  }
  const Real part = length / static_cast<Real>(heads[0].centers.cols() - 1);
  return std::clamp(static_cast<Index>(std::ceil(width / part)), static_cast<Index>(heads.size()) - 1, Index{100});
}

namespace {

/// A sheet's middle surface: lines from origin to insertion, from head to head as many as a side has corners.
struct MiddleSurface {
  std::vector<Points> lines;
  std::vector<Points> tangents, across;  ///< of each line's points; unit, and perpendicular to each other
};

/// Between one of a list of things and the next.
struct Between {
  std::size_t before = 0;
  Real next = 0;
};

}  // namespace

static Between between(Real place, std::size_t count) {
  const std::size_t before = std::min(static_cast<std::size_t>(place), count - 2);
  return {before, place - static_cast<Real>(before)};
}

/// The directions from line to line, smooth along the lines: where these come together, which has no direction of its
/// own, that of the sections beside it, within about three of them.
static Points smooth_along(const Points& directions) {
  const Eigen::Index n = directions.cols();
  const Real stiffness = 9;
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) system.block<2, 2>(k, k) += stiffness * Eigen::Matrix2d{{1, -1}, {-1, 1}};
  return system.ldlt().solve(directions.transpose()).transpose();
}

/// What of a direction is across another, unit.
static Vec3 unit_across(const Vec3& direction, const Vec3& along) {
  const Vec3 across = direction - direction.dot(along) * along;
  return across.norm() > 1e-9 ? across.normalized() : along.unitOrthogonal();
}

static MiddleSurface middle_surface(const std::vector<SheetHead>& heads, Index side, const VolumeSettings& settings) {
  MiddleSurface middle;
  for (Index j = 0; j <= side; ++j) {
    const Between at = between(static_cast<Real>(j) * static_cast<Real>(heads.size() - 1) / side, heads.size());
    const SheetHead &a = heads[at.before], &b = heads[at.before + 1];
    const Points line = (1 - at.next) * a.centers + at.next * b.centers;
    const Eigen::VectorXd radii = (1 - at.next) * a.radii + at.next * b.radii;
    middle.lines.push_back(settings.bones ? clear_centers(line, radii, *settings.bones) : line);
    middle.tangents.push_back(section_frames(middle.lines.back(), Vec3::UnitX()).normals);
  }
  for (std::size_t j = 0; j < middle.lines.size(); ++j) {
    const Points& before = middle.lines[j > 0 ? j - 1 : 0];
    Points across = smooth_along(middle.lines[std::min(j + 1, middle.lines.size() - 1)] - before);
    for (Eigen::Index k = 0; k < across.cols(); ++k)
      across.col(k) = unit_across(across.col(k), middle.tangents[j].col(k));
    middle.across.push_back(across);
  }
  return middle;
}

namespace {

/// All that the shape of a sheet follows from but how far its heads swell.
struct Sheet {
  std::vector<SheetHead> heads;
  SheetParts parts;
  Index rays = 0, side = 0;
  MiddleSurface middle;

  Index sections() const { return static_cast<Index>(heads[0].centers.cols()); }

  /// Of the hull of sections of heads that swell so many times as far.
  SectionRays hull(Real swelling) const {
    SectionRays result{Points(3, rays * sections()), Points(3, rays * sections()), Eigen::MatrixXd(rays, sections())};
    for (Index i = 0; i < rays; ++i) {
      const SheetCorner corner = sheet_corner(rays, side, heads.size(), i);
      const Real share = (static_cast<Real>(corner.head) + corner.next) / static_cast<Real>(heads.size() - 1);
      const auto [j, next] = between(share * side, middle.lines.size());
      const auto mixed = [&, j = j, next = next](const std::vector<Points>& all, Index k) -> Vec3 {
        return (1 - next) * all[j].col(k) + next * all[j + 1].col(k);
      };
      for (Index k = 0; k < sections(); ++k) {
        const Vec3 along = mixed(middle.tangents, k).normalized();
        const Vec3 across = unit_across(mixed(middle.across, k), along);
        const Index column = k * rays + i;
        result.feet.col(column) = mixed(middle.lines, k);
        result.directions.col(column) = std::cos(corner.angle) * across + std::sin(corner.angle) * along.cross(across);
        result.lengths(i, k) =
            (1 - corner.next) * radius(corner.head, k, swelling) + corner.next * radius(corner.head + 1, k, swelling);
      }
    }
    return result;
  }

  Real radius(std::size_t head, Index k, Real swelling) const {
    const Real thin = tendon_radius(heads[head].own.size);
    return thin + swelling * (heads[head].radii[k] - thin);
  }
};

}  // namespace

/// Of the sections from one to another, m³.
static Real volume_between(const Points& corners, Index rays, Index first, Index last) {
  const Points vertices = sheet_vertices(corners.middleCols(first * rays, (last - first + 1) * rays), rays);
  return enclosed_volume(vertices, sheet_faces(last - first + 1, rays));
}

/// So far the heads swell that the belly of their hull has the volume of theirs.
static Real swelling_of(const Sheet& sheet) {
  Real wanted = 0;
  for (const SheetHead& head : sheet.heads) wanted += gracilis::muscle_volume(head.own.size);
  // The volume grows with the swelling: bisection. Heads on one line swell by the root of their number.
  Real low = 0, high = 2 * std::sqrt(static_cast<Real>(sheet.heads.size()));
  for (int step = 0; step < 40; ++step) {
    const Real middle = (low + high) / 2;
    const Real volume = volume_between(sheet.hull(middle).corners(), sheet.rays, sheet.parts.origin_tendon,
                                       sheet.parts.origin_tendon + sheet.parts.belly);
    (volume < wanted ? low : high) = middle;
  }
  return high;
}

/// The sheet's own line: its heads, and what exports ask of the whole.
static ActionLine line_of_sheet(const Sheet& sheet) {
  ActionLine line;
  line.rays = sheet.rays;
  line.side = sheet.side;
  Real force = 0;
  for (const SheetHead& head : sheet.heads) {
    const Real mean = 1 / static_cast<Real>(sheet.heads.size()), own = head.own.size.max_isometric_force;
    line.heads.push_back(head.own.line);
    line.tendon += mean * head.own.line.tendon;
    line.origin_tendon += mean * head.own.line.origin_tendon;
    line.optimal_fiber += own * head.own.size.optimal_fiber;
    line.pennation += own * head.own.size.pennation;
    force += own;
  }
  line.optimal_fiber /= force;
  line.pennation /= force;
  return line;
}

/// The vertices of an end go with the body that the nearest head's line ends on.
static void hold_end(const ActionLine& line, Index sections, AttachmentEnd end, std::vector<HeldVertices>& held) {
  const Index section = end == AttachmentEnd::origin ? 0 : sections - 1, vertices = line.rays * sections + 2;
  const std::vector<LineShare> shares = line_shares(line, vertices);
  const std::size_t before = held.size();
  for (Index v = 0; v < vertices; ++v) {
    const LineShare& share = shares[static_cast<std::size_t>(v)];
    if (share.section != section) continue;
    const ActionLine& head = line.heads[share.next < 0.5 ? share.line : share.line + 1];
    const Index body = end == AttachmentEnd::origin ? head.bodies.front() : head.bodies.back();
    auto found = std::find_if(held.begin() + static_cast<std::ptrdiff_t>(before), held.end(),
                              [&](const HeldVertices& each) { return each.body == body; });
    if (found == held.end()) found = held.insert(held.end(), {end, body, {}});
    found->vertices.push_back(v);
  }
}

namespace {

/// An edge on its way through all triangles.
struct EdgeOnItsWay {
  const TriangleMesh& surface;
  const MeshEdge& edge;
  bool runs_through = false;
};

}  // namespace

/// Whether the edge runs through a triangle that it meets: edges of flat parts only touch others in their plane.
static void note_met(Index face, void* of_edge) {
  auto& query = *static_cast<EdgeOnItsWay*>(of_edge);
  const auto corners = query.surface.faces.col(face);
  if ((corners.array() == query.edge.a || corners.array() == query.edge.b).any()) return;
  const Points& vertices = query.surface.vertices;
  const Vec3 first = vertices.col(corners[0]), normal = area_vector(vertices, corners).normalized();
  const Real from = normal.dot(vertices.col(query.edge.a) - first), to = normal.dot(vertices.col(query.edge.b) - first);
  const Real touching = 1e-6;  // m
  if (from * to < 0 && std::min(std::abs(from), std::abs(to)) > touching) query.runs_through = true;
}

static bool cuts_itself(const TriangleMesh& surface) {
  const TriangleTree tree(surface);
  for (const MeshEdge& edge : build_topology(surface.faces, surface.vertex_count()).edges) {
    EdgeOnItsWay query{surface, edge};
    tree.all(surface.vertices.col(edge.a), surface.vertices.col(edge.b), note_met, &query);
    if (query.runs_through) return true;
  }
  return false;
}

MuscleVolume sheet_volume(const Model& model, const std::vector<const Muscle*>& muscles,
                          const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                          const VolumeSettings& settings) {
  Sheet sheet;
  SheetHeads heads = sheet_heads(model, muscles, poses, coordinates, settings);
  sheet.heads = std::move(heads.heads);
  sheet.parts = heads.parts;
  sheet.side = side_of(sheet.heads);
  sheet.rays = static_cast<Index>(settings.rays) + 2 * sheet.side;
  sheet.middle = middle_surface(sheet.heads, sheet.side, settings);
  SectionRays rays = sheet.hull(swelling_of(sheet));
  MuscleVolume volume;
  if (settings.bones) {
    std::vector<std::string> own;
    for (const SheetHead& head : sheet.heads) own.push_back(head.own.line.name);
    ClearRays clear = clear_rays(rays, *settings.bones, room_left(settings.beside, own));
    rays.lengths = std::move(clear.lengths);
    volume.volume_share = clear.volume_share;
  }
  volume.surface = {sheet_vertices(rays.corners(), sheet.rays), sheet_faces(sheet.sections(), sheet.rays)};
  if (cuts_itself(volume.surface))
    throw InputError({model.name, muscle_of_head(sheet.heads[0].own.line.name),
                      "a sheet over its heads would cut itself", "their lines cross, or bend within its thickness"});
  for (const SheetHead& head : sheet.heads) volume.tendon_share = std::min(volume.tendon_share, head.own.tendon_share);
  volume.line = line_of_sheet(sheet);
  for (ActionLine& head : volume.line.heads) head.rays = sheet.rays;
  for (const AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion})
    hold_end(volume.line, sheet.sections(), end, volume.held);
  return volume;
}

}  // namespace gracilis::opensim
