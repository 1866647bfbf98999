#include <gracilis/methods/xpbd/preparation.hpp>

#include <gracilis/anatomy/attachments/skinning_weights.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/dynamics/constraints/compliance.hpp>
#include <gracilis/dynamics/constraints/dihedral.hpp>
#include <gracilis/dynamics/particle_order.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/xpbd/bone_gaps.hpp>
#include <gracilis/methods/xpbd/contraction.hpp>
#include <gracilis/methods/xpbd/fiber_directions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::xpbd {

namespace {

/// Below this share of its stiffness an edge along the fibers would carry nothing and its compliance no finite number.
constexpr Real smallest_anisotropy = 1e-6;
constexpr Real smallest_mass_share = 1e-3;
/// Inverse mass of a tendon's particles over that of the belly's: what pulls at a tendon moves the belly instead. Less
/// folds tendons where their lines bend, more lets an active muscle draw them off these.
constexpr Real tendon_mobility = 0.05;
/// Stiffness of a tendon's edges over that of the belly's.
constexpr Real tendon_stiffness = 200;
/// A belly passes into its tendon over this length, m: in less its edges stretch there, over more it folds.
constexpr Real tendon_border = 0.03;
/// A triangle is a sliver when its tip is nearer to its longest side than this share of that, or of all sides' mean.
constexpr float flattest = 0.1f;
/// Parts of a muscle nearer to each other than this at rest are kept on their side one by one, m.
constexpr Real tight = 1e-4;
/// A face is large when the circle in it has a radius above this many cells of the bones' fields.
constexpr Real large_radius = 2;

/// Numbers the particles and puts the muscle's surface into their order; the attachments, in particle numbers.
std::vector<Attachment> renumber(const Muscle& muscle, PreparedMuscle& prepared) {
  {
    const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
    prepared.order = particle_order(muscle.surface.vertices, topology.stars);
  }
  std::vector<Index> particle_of(prepared.order.size());
  prepared.rest.resize(3, muscle.surface.vertex_count());
  for (std::size_t p = 0; p < prepared.order.size(); ++p) {
    particle_of[static_cast<std::size_t>(prepared.order[p])] = static_cast<Index>(p);
    prepared.rest.col(static_cast<Index>(p)) = muscle.surface.vertices.col(prepared.order[p]);
  }
  const auto numbered = [&](Index v) { return particle_of[static_cast<std::size_t>(v)]; };
  prepared.faces = muscle.surface.faces.unaryExpr(numbered);
  prepared.fixed_body.assign(prepared.order.size(), -1);
  std::vector<Attachment> attachments = muscle.attachments;
  for (Attachment& attachment : attachments)
    for (Index& v : attachment.vertices) {
      v = numbered(v);
      prepared.fixed_body[static_cast<std::size_t>(v)] = attachment.body;
    }
  return attachments;
}

/// What carries each particle along the lines: its own section, or, where the surface is a finer or coarser copy, the
/// nearest; and how far it is from the tendon.
void follow_lines(const Scene& scene, const Muscle& muscle, PreparedMuscle& prepared) {
  prepared.lines = carrying_lines(muscle);
  std::vector<Points> centers;
  for (const LineSections& line : prepared.lines) {
    const PlacedSections sections = sections_at(line, capture_pose(scene.bodies.size()));
    centers.push_back(sections.centers);
    std::vector<RigidTransform>& to_sections = prepared.to_sections.emplace_back();
    for (Eigen::Index k = 0; k < sections.centers.cols(); ++k) to_sections.push_back(sections.frame(k).inverse());
  }
  const std::vector<LineShare> shares = vertex_shares(muscle, centers);
  for (const Index vertex : prepared.order) {
    const LineShare share = shares[static_cast<std::size_t>(vertex)];
    prepared.shares.push_back(share);
    const auto from_tendon = [&](std::size_t line) {
      return std::clamp(distance_from_tendon(prepared.lines[line], share.section) / tendon_border, 0.0, 1.0);
    };
    const Real next = share.next > 0 ? share.next * from_tendon(share.line + 1) : 0;
    const Real t = (1 - share.next) * from_tendon(share.line) + next;
    prepared.belly.push_back(t * t * (3 - 2 * t));
  }
}

/// Mass of each vertex by its share of the surface, over all: density times volume. Tendons are heavier.
Eigen::VectorXd inverse_masses(const Scene& scene, const PreparedMuscle& prepared) {
  const MaterialSettings& settings = prepared.settings;
  Eigen::VectorXd masses = Eigen::VectorXd::Ones(prepared.rest.cols());
  if (!settings.unit_masses) {
    const Eigen::VectorXd areas = vertex_areas(prepared.rest, prepared.faces);
    // A vertex among slivers would weigh next to nothing and fly.
    const Eigen::VectorXd shares = areas.cwiseMax(smallest_mass_share * areas.mean());
    masses = settings.density * enclosed_volume(prepared.rest, prepared.faces) / shares.sum() * shares;
  }
  Eigen::VectorXd inverse = masses.cwiseInverse();
  for (std::size_t p = 0; p < prepared.belly.size(); ++p)
    inverse[static_cast<Index>(p)] *= std::pow(tendon_mobility, 1 - prepared.belly[p]);
  for (Index p = 0; p < inverse.size(); ++p) {
    const Index body = prepared.fixed_body[static_cast<std::size_t>(p)];
    // What lies on a muscle gives way with it.
    if (body >= 0 && !muscle_body(scene, body)) inverse[p] = 0;
  }
  return inverse;
}

/// The fibers that the anisotropy asks for the nearest of.
NearestFiber anisotropy_fibers(const Muscle& muscle, const MaterialSettings& settings) {
  const bool asks = settings.fiber_anisotropy && settings.fiber_direction == FiberDirection::nearest_fiber;
  return asks ? NearestFiber(fibers_of(muscle)) : NearestFiber();
}

/// The published anisotropy: edges along the fibers are softer by 1 - |u·v| (Cervenka and Kohout 2020).
Real anisotropy(Real cosine, const MaterialSettings& settings) {
  if (!settings.fiber_anisotropy) return 1;
  return std::max({1 - std::abs(cosine), settings.anisotropy_floor, smallest_anisotropy});
}

/// Stiffness of one edge: the setting, scaled by A/l² (1 between equilateral triangles) so that a sheet strains alike
/// however it is triangulated and a short edge does not take the stretch of its long neighbors (Van Gelder 1998).
Real edge_stiffness(const Points& x, const Eigen::Matrix3Xi& faces, const MeshEdge& edge,
                    const MaterialSettings& settings) {
  const Real length2 = (x.col(edge.b) - x.col(edge.a)).squaredNorm(), equilateral = std::sqrt(Real{3}) / 2;
  if (!settings.distance_shape_scaling || !(length2 > 0)) return settings.distance_stiffness;
  const Real shape = area_at(edge, x, faces) / length2 / equilateral;
  return settings.distance_stiffness * std::clamp(shape, 1 / largest_shape, largest_shape);
}

/// How much stiffer an edge is for being in a tendon.
Real tendon_factor(const PreparedMuscle& prepared, const MeshEdge& edge) {
  if (prepared.belly.empty()) return 1;
  const Real belly =
      (prepared.belly[static_cast<std::size_t>(edge.a)] + prepared.belly[static_cast<std::size_t>(edge.b)]) / 2;
  return std::pow(tendon_stiffness, 1 - belly);
}

void build_edges(const Muscle& muscle, const std::vector<Attachment>& attachments, const MeshTopology& topology,
                 PreparedMuscle& prepared) {
  const Points& x = prepared.rest;
  const Points directions =
      edge_fiber_directions({x, prepared.faces}, topology, attachments, anisotropy_fibers(muscle, prepared.settings));
  std::vector<DistanceConstraint> constraints;
  constraints.reserve(topology.edges.size());
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const MeshEdge& edge = topology.edges[e];
    const Vec3 along = x.col(edge.b) - x.col(edge.a);
    const Real length = along.norm();
    const Real cosine = length > 0 ? directions.col(static_cast<Index>(e)).dot(along) / length : 0;
    const Real stiffness = edge_stiffness(x, prepared.faces, edge, prepared.settings) *
                           anisotropy(cosine, prepared.settings) * tendon_factor(prepared, edge);
    constraints.push_back({edge.a, edge.b, length, compliance_of(stiffness)});
  }
  prepared.system.distances = build_distance_set(constraints, prepared.particle_count());
}

/// Stiffness of one dihedral: the setting, scaled by 3 l²/A so that bending does not depend on how finely the surface
/// is triangulated (Grinspun et al. 2003).
Real dihedral_stiffness(const Points& x, const Eigen::Matrix3Xi& faces, const MeshEdge& edge,
                        const MaterialSettings& settings) {
  if (!settings.dihedral_shape_scaling) return settings.dihedral_stiffness;
  const Real area = area_at(edge, x, faces), length2 = (x.col(edge.b) - x.col(edge.a)).squaredNorm();
  return settings.dihedral_stiffness * (area > 0 ? std::min(3 * length2 / area, largest_shape) : largest_shape);
}

void build_dihedrals(const MeshTopology& topology, PreparedMuscle& prepared) {
  const Points& x = prepared.rest;
  std::vector<DihedralConstraint> constraints;
  constraints.reserve(topology.edges.size());
  for (const MeshEdge& edge : topology.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    DihedralConstraint dihedral;
    dihedral.particles = {edge.a, edge.b, edge.left_apex, edge.right_apex};
    dihedral.rest_angle = dihedral_angle(x.col(edge.a), x.col(edge.b), x.col(edge.left_apex), x.col(edge.right_apex));
    if (prepared.settings.dihedral_formula == DihedralFormula::arccos)
      dihedral.rest_angle = std::abs(dihedral.rest_angle);
    dihedral.compliance = compliance_of(dihedral_stiffness(x, prepared.faces, edge, prepared.settings));
    dihedral.edge_length = (x.col(edge.b) - x.col(edge.a)).norm();
    constraints.push_back(dihedral);
  }
  prepared.system.dihedrals = build_dihedral_set(constraints, prepared.particle_count());
}

void build_predictor(const Scene& scene, const MeshTopology& topology, const std::vector<DistanceField>& fields,
                     PreparedMuscle& prepared) {
  for (Index body : prepared.fixed_body)
    if (body >= 0 && std::find(prepared.carriers.begin(), prepared.carriers.end(), body) == prepared.carriers.end())
      prepared.carriers.push_back(body);
  std::sort(prepared.carriers.begin(), prepared.carriers.end());
  prepared.skinning_weights = skinning_weights({prepared.rest, prepared.faces}, topology, prepared.fixed_body,
                                               prepared.carriers, prepared.settings.tendon_length);
  if (prepared.settings.predictor != Predictor::arap || prepared.carriers.empty()) return;
  std::vector<char> held;
  for (Index p = 0; p < prepared.particle_count(); ++p)
    held.push_back(prepared.fixed_body[static_cast<std::size_t>(p)] >= 0 ||
                   !(prepared.skinning_weights.col(p).sum() > 0));
  prepared.predicted =
      std::make_shared<const ArapPredictor>(TriangleMesh{prepared.rest, prepared.faces}, topology, std::move(held));
  const std::vector<Real> margins(prepared.fixed_body.size(), prepared.settings.bone_margin);
  prepared.predicted_bones =
      BoneProjection(scene, prepared.rest, prepared.fixed_body, fields, margins, prepared.settings.bone_rest_gap);
}

/// Between the edges of these faces something as sharp as a bone can poke through.
void build_large_faces(const std::vector<DistanceField>& fields, PreparedMuscle& prepared) {
  Real cell = std::numeric_limits<Real>::infinity();
  for (const DistanceField& field : fields) cell = std::min(cell, field.cell_size.maxCoeff());
  const Points& x = prepared.rest;
  std::vector<Index> large;
  for (Index f = 0; f < static_cast<Index>(prepared.faces.cols()); ++f) {
    const auto corners = prepared.faces.col(f);
    Real around = 0;
    for (int k = 0; k < 3; ++k) around += (x.col(corners[k]) - x.col(corners[(k + 1) % 3])).norm();
    // The radius of the circle in it: twice the area (here: the area vector's length) over the circumference.
    if (area_vector(x, corners).norm() > large_radius * cell * around) large.push_back(f);
  }
  prepared.system.large_faces = build_face_set(prepared.faces(Eigen::all, large), prepared.particle_count());
}

void build_contacts(const Scene& scene, const MeshTopology& topology, const std::vector<DistanceField>& fields,
                    PreparedMuscle& prepared) {
  for (std::size_t bone = 0; bone < scene.bones.size(); ++bone) {
    prepared.system.contacts.push_back(bone_contact(prepared, topology, scene.bones[bone], fields[bone]));
    prepared.contact_bodies.push_back(scene.bones[bone].body);
  }
}

}  // namespace

ShapeLimits shape_limits_of(const XpbdSettings& settings) {
  return {static_cast<float>(settings.spike_limit), static_cast<float>(settings.thickness_limit),
          static_cast<float>(settings.thinness_limit)};
}

bool asks_for_strings(const Scene& scene, const Muscle& muscle) {
  const XpbdSettings settings = xpbd_settings(scene, muscle);
  const bool is_carried = settings.predictor != Predictor::none || settings.slack_uptake;
  if (settings.skinning != Skinning::strings || !is_carried || muscle.action_line.rays > 0) return false;
  return strings::runs_between_bodies(muscle);
}

CarryingStrings carrying_strings(const Scene& scene, const Muscle& muscle, const strings::BoneDistances& bones) {
  if (!asks_for_strings(scene, muscle)) return {};
  // Where a muscle crumples at the end of a motion is up to small differences of what carries it. All that is held
  // there was held with strings that move one by one, 0.1 mm from rest on average; contact moves the surface by more.
  strings::StringSettings settings;
  settings.sections_first = false;
  // Strings know no other muscles: held off bones however far these are, they are held off what lies between, too, and
  // lead muscles less deep into each other (docs/decisions/0005).
  settings.support_reach = std::numeric_limits<Real>::infinity();
  std::optional<strings::MuscleStrings> laid = strings::muscle_strings(scene, muscle, bones, settings);
  if (!laid) return {};
  return {&bones, std::make_shared<const strings::MuscleStrings>(std::move(*laid))};
}

PreparedMuscle prepare_muscle(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                              const CarryingStrings& carrying) {
  PreparedMuscle prepared;
  prepared.name = muscle.name;
  prepared.settings = xpbd_settings(scene, muscle);
  prepared.contraction = muscle.contraction;
  const std::vector<Attachment> attachments = renumber(muscle, prepared);
  prepared.origin = prepared.rest.rowwise().mean();
  if (muscle.action_line.rays > 0) follow_lines(scene, muscle, prepared);
  prepared.carrying = carrying;
  if (carrying.strings)
    prepared.carried = std::make_shared<const StringSkinnedSurface>(StringSkinnedSurface{
        prepared.rest, prepared.faces,
        strings::bind_skin(*carrying.strings, {prepared.rest, prepared.faces}, prepared.fixed_body)});
  prepared.system.rest = make_particles(prepared.rest.colwise() - prepared.origin, inverse_masses(scene, prepared));
  // What takes the most memory while it is built comes first.
  const ContactSettings contact = contact_settings(scene);
  prepared.keeps_out_of_itself = contact.self && contact.muscle == MuscleContact::surface && prepared.belly.empty();
  if (prepared.keeps_out_of_itself) {
    prepared.system.slivers = build_sliver_set(prepared.faces, prepared.system.rest, flattest);
    prepared.system.rest_proximities =
        find_rest_proximities(prepared.rest, prepared.faces, tight, prepared.system.rest);
  }
  const MeshTopology topology = build_topology(prepared.faces, prepared.particle_count());
  if (shape_limits_of(prepared.settings).any())
    prepared.system.shape_limits = build_shape_limits(shape_of({prepared.rest, prepared.faces}, topology));
  build_predictor(scene, topology, fields, prepared);
  build_edges(muscle, attachments, topology, prepared);
  build_dihedrals(topology, prepared);
  prepared.system.volume =
      build_volume_set(prepared.faces, prepared.particle_count(), enclosed_volume(prepared.rest, prepared.faces),
                       prepared.settings.volume_compliance);
  prepared.is_driven = drives(scene.activation, muscle.name);
  if (prepared.is_driven) build_contractions(muscle, topology, prepared);
  build_large_faces(fields, prepared);
  build_contacts(scene, topology, fields, prepared);
  return prepared;
}

}  // namespace gracilis::xpbd
