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
    const NearestPoint below = host_tree.query(guest.rest.col(p));
    const auto corners = host.faces.col(below.face);
    tied.ties.push_back({p,
                         {corners[0], corners[1], corners[2]},
                         below.barycentric.cast<float>(),
                         (guest.rest.col(p) - below.point).cast<float>()});
  }
  return tied;
}

}  // namespace

MuscleTies prepare_ties(const Scene& scene, const std::vector<PreparedMuscle>& muscles) {
  MuscleTies ties;
  if (scene.muscle_bodies.empty()) return ties;
  ties.groups = hosts_first(scene);
  for (const std::vector<std::size_t>& group : ties.groups)
    for (const MuscleBody& each : scene.muscle_bodies) {
      const auto host = static_cast<std::size_t>(each.muscle);
      if (std::find(group.begin(), group.end(), host) == group.end()) continue;
      ties.bodies.push_back(carried_body(each, muscles[host]));
      const NearestTriangle tree({muscles[host].rest, muscles[host].faces});
      for (std::size_t guest = 0; guest < muscles.size(); ++guest) {
        TiedSurfaces tied =
            tied_surfaces(ties.bodies.back(), static_cast<Index>(guest), muscles[guest], muscles[host], tree);
        if (!tied.ties.empty()) ties.surfaces.push_back(std::move(tied));
      }
    }
  return ties;
}

}  // namespace gracilis::xpbd
