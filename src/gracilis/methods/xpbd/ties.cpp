#include <gracilis/methods/xpbd/ties.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>

#include <algorithm>

namespace gracilis::xpbd {

namespace {

CarriedBody carried_body(const MuscleBody& body, const PreparedMuscle& host) {
  CarriedBody result{body.body, body.muscle, {}, {}};
  for (Index p = 0; p < host.particle_count(); ++p)
    if (std::binary_search(body.patch.begin(), body.patch.end(), host.order[static_cast<std::size_t>(p)]))
      result.patch.push_back(p);
  result.rest = host.rest(Eigen::all, result.patch);
  return result;
}

TiedSurfaces tied_surfaces(const CarriedBody& body, Index guest_number, const PreparedMuscle& guest,
                           const PreparedMuscle& host, const NearestTriangle& host_tree) {
  TiedSurfaces tied;
  tied.guest = guest_number, tied.host = body.muscle;
  tied.shift = (guest.origin - host.origin).cast<float>();
  tied.patch = body.patch;
  tied.patch_rest = (body.rest.colwise() - Vec3(body.rest.rowwise().mean())).cast<float>();
  for (Index p = 0; p < guest.particle_count(); ++p) {
    if (guest.fixed_body[static_cast<std::size_t>(p)] != body.body) continue;
    const HostPlace place = host_place(host_tree, host.faces, guest.rest.col(p));
    tied.ties.push_back({p, place.corners, place.weights.cast<float>(), place.offset.cast<float>()});
  }
  return tied;
}

}  // namespace

MuscleTies prepare_ties(const Scene& scene, const std::vector<PreparedMuscle>& muscles) {
  MuscleTies ties;
  if (scene.muscle_bodies.empty()) return ties;
  ties.groups = hosts_first(scene);
  for (const MuscleBody& each : scene.muscle_bodies) {
    const PreparedMuscle& host = muscles[static_cast<std::size_t>(each.muscle)];
    ties.bodies.push_back(carried_body(each, host));
    const NearestTriangle tree({host.rest, host.faces});
    for (std::size_t guest = 0; guest < muscles.size(); ++guest) {
      TiedSurfaces tied = tied_surfaces(ties.bodies.back(), static_cast<Index>(guest), muscles[guest], host, tree);
      if (!tied.ties.empty()) ties.surfaces.push_back(std::move(tied));
    }
  }
  return ties;
}

}  // namespace gracilis::xpbd
