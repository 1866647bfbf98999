#include <gracilis/transfer/muscle_transfer.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/arap_surface.hpp>
#include <gracilis/geometry/arap_volume.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace gracilis {
namespace {

/// An attached vertex farther from the bones of its body than this is on none of them: a tendon that is not modelled.
constexpr Real farthest_held = 0.02;

/// Distances to the template's bones and the subject's, of those that both have.
struct Bones {
  std::vector<Index> bodies;
  std::vector<SignedDistance> from, to;

  Bones(const Scene& scene, const std::vector<TriangleMesh>& subject) {
    for (std::size_t b = 0; b < subject.size(); ++b) {
      if (subject[b].face_count() == 0) continue;
      bodies.push_back(scene.bones[b].body);
      from.emplace_back(scene.bones[b].surface);
      to.emplace_back(subject[b]);
    }
  }

  /// The nearest bone of a body to a place of the template; bodies.size(): none within reach.
  std::size_t nearest(Index body, const Vec3& p, Real& distance) const {
    std::size_t best = bodies.size();
    Real least = farthest_held;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b] != body) continue;
      const SignedDistance::Answer answer = from[b].query(p, least);
      if (answer.nearest.face < 0 || answer.nearest.distance >= least) continue;
      least = answer.nearest.distance;
      distance = answer.distance;
      best = b;
    }
    return best;
  }
};

/// The place nearest to p that is at a distance from the surface, negative inside.
Vec3 at_distance(const SignedDistance& surface, const Vec3& p, Real wanted) {
  const SignedDistance::Answer answer = surface.query(p);
  const Vec3 way = p - answer.nearest.point;
  // On the surface itself no direction is known; half a gap away there is one next time.
  if (way.norm() < 1e-7) return p;
  const Vec3 outwards = way / answer.distance;
  return answer.nearest.point + wanted * outwards;
}

struct Held {
  std::vector<Index> vertices;  ///< ascending
  Points places;
};

/// Where a muscle's attached vertices belong on the subject.
Held held_places(const Scene& scene, const Muscle& from, const Points& warped, const Bones& bones,
                 std::vector<AttachmentFit>& fits) {
  std::vector<char> is_held(static_cast<std::size_t>(warped.cols()), 0);
  Points places = warped;
  for (const Attachment& attachment : from.attachments) {
    AttachmentFit fit{from.name, attachment.name, static_cast<Index>(attachment.vertices.size())};
    Index on_bone = 0;
    for (const Index v : attachment.vertices) {
      is_held[static_cast<std::size_t>(v)] = 1;
      Real distance = 0;
      if (muscle_body(scene, attachment.body)) continue;
      const std::size_t bone = bones.nearest(attachment.body, from.surface.vertices.col(v), distance);
      if (bone == bones.bodies.size()) continue;
      places.col(v) = at_distance(bones.to[bone], warped.col(v), distance);
      const Real way = (places.col(v) - warped.col(v)).norm();
      fit.brought += way;
      fit.brought_most = std::max(fit.brought_most, way);
      ++on_bone;
    }
    fit.on_bone = 2 * on_bone > fit.vertices;
    fit.brought /= std::max<Index>(1, on_bone);
    fits.push_back(fit);
  }
  Held held;
  for (Index v = 0; v < static_cast<Index>(is_held.size()); ++v)
    if (is_held[static_cast<std::size_t>(v)]) held.vertices.push_back(v);
  held.places = places(Eigen::all, held.vertices);
  return held;
}

void bring(const Held& held, const Eigen::Matrix3Xi& faces, Points& vertices) {
  if (held.vertices.empty()) return;
  const Points moves = held.places - vertices(Eigen::all, held.vertices);
  const MeshTopology topology = build_topology(faces, static_cast<Index>(vertices.cols()));
  vertices += harmonic_fields(vertices, topology, held.vertices, moves.transpose()).transpose();
  vertices(Eigen::all, held.vertices) = held.places;
}

void reach_volume(const Held& held, Real volume, TriangleMesh& surface) {
  std::vector<char> is_held(static_cast<std::size_t>(surface.vertex_count()), 0);
  for (const Index v : held.vertices) is_held[static_cast<std::size_t>(v)] = 1;
  const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
  // The farther the way the more steps: each is as rigid as the last one leaves it.
  const int steps =
      1 + static_cast<int>(10 * std::abs(std::log(volume / enclosed_volume(surface.vertices, surface.faces))));
  for (int step = 1; step <= steps; ++step) {
    const Real now = enclosed_volume(surface.vertices, surface.faces);
    const Real next = now * std::pow(volume / now, 1.0 / (steps - step + 1));
    const arap::Surface elastic(surface, topology, is_held);
    arap::restore_volume_by_multiplier(elastic, surface.faces, is_held, next, surface.vertices);
  }
}

void warp_lines(const ThinPlateMap& warp, Polylines& lines) { lines.points = warp.at(lines.points); }

void warp_action_line(const ThinPlateMap& warp, ActionLine& line) {
  line.points = warp.at(line.points);
  line.centers = warp.at(line.centers);
  for (LinePoint& point : line.path.points) point.place = warp.at(point.place);
  for (ActionLine& head : line.heads) warp_action_line(warp, head);
}

}  // namespace

TransferredMuscles transfer_muscles(const Scene& scene, const std::vector<TriangleMesh>& subject,
                                    const ThinPlateMap& warp, const std::map<std::string, Real>& volumes,
                                    std::vector<Muscle>& muscles) {
  const Bones bones(scene, subject);
  TransferredMuscles result;
  result.muscles.resize(muscles.size());
  std::vector<std::vector<AttachmentFit>> attachments(muscles.size());
  parallel_for_each(muscles.size(), [&](std::size_t m) {
    const Muscle from = muscles[m];
    Muscle& muscle = muscles[m];
    Points& vertices = muscle.surface.vertices;
    MuscleFit& fit = result.muscles[m];
    fit.muscle = muscle.name;
    fit.template_volume = enclosed_volume(vertices, muscle.surface.faces);
    vertices = warp.at(vertices);
    fit.warped_volume = enclosed_volume(vertices, muscle.surface.faces);
    const Held held = held_places(scene, from, vertices, bones, attachments[m]);
    bring(held, muscle.surface.faces, vertices);
    if (const auto given = volumes.find(muscle.name); given != volumes.end())
      reach_volume(held, given->second, muscle.surface);
    for (Aponeurosis& sheet : muscle.aponeuroses) sheet.surface.vertices = warp.at(sheet.surface.vertices);
    for (Polylines* lines : {&muscle.given_fibers, &muscle.tracts, &muscle.given_surface_fibers})
      warp_lines(warp, *lines);
    warp_action_line(warp, muscle.action_line);
  });
  for (std::vector<AttachmentFit>& some : attachments)
    result.attachments.insert(result.attachments.end(), some.begin(), some.end());
  return result;
}

void measure_muscles(const Scene& scene, TransferredMuscles& muscles) {
  std::vector<NearestTriangle> trees;
  for (const Bone& bone : scene.bones) trees.emplace_back(bone.surface);
  auto attachment_fit = muscles.attachments.begin();
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    const Muscle& muscle = scene.muscles[m];
    muscles.muscles[m].volume = enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
    for (const Attachment& attachment : muscle.attachments) {
      AttachmentFit& fit = *attachment_fit++;
      if (muscle_body(scene, attachment.body)) continue;
      for (const Index v : attachment.vertices) {
        Real least = std::numeric_limits<Real>::infinity();
        for (std::size_t b = 0; b < trees.size(); ++b)
          if (scene.bones[b].body == attachment.body)
            least = std::min(least, trees[b].query(muscle.surface.vertices.col(v), least).distance);
        fit.from_bone += least / static_cast<Real>(attachment.vertices.size());
      }
    }
  }
}

}  // namespace gracilis
