#include <gracilis/methods/tissue/ends_on_muscles.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace gracilis::tissue {

namespace {

std::vector<JoinedPoint> joined_points(const PreparedTissue& guest, Index body, const TriangleMesh& host,
                                       const NearestTriangle& host_tree) {
  std::vector<JoinedPoint> joined;
  for (std::size_t p = 0; p < guest.points.size(); ++p) {
    const SurfacePoint& point = guest.points[p];
    if (point.held_by != body) continue;
    joined.push_back({static_cast<Index>(p), host_place(host_tree, host.faces, point.rest)});
  }
  return joined;
}

/// Adds a spring to what draws a vertex already: together they are one to the mean of their places.
void draw(Index vertex, const Vec3& to, Real stiffness, Index by, Surroundings& around) {
  if (!(stiffness > 0)) return;
  if (around.drawn_by.empty()) {
    const auto count = static_cast<Index>(around.held.cols());
    around.drawn_to = Points::Zero(3, count);
    around.drawn_stiffness = Eigen::VectorXd::Zero(count);
    around.drawn_by.assign(static_cast<std::size_t>(count), -1);
  }
  Real& sum = around.drawn_stiffness[vertex];
  around.drawn_to.col(vertex) += stiffness / (sum + stiffness) * (to - around.drawn_to.col(vertex));
  sum += stiffness;
  around.drawn_by[static_cast<std::size_t>(vertex)] = by;
}

}  // namespace

std::vector<EndOnMuscle> ends_on_muscles(const Scene& scene, const std::vector<PreparedTissue>& muscles) {
  std::vector<EndOnMuscle> ends;
  for (const CarriedBody& body : carried_bodies(scene)) {
    const auto host = static_cast<std::size_t>(body.muscle);
    const TriangleMesh& surface = scene.muscles[host].surface;
    const NearestTriangle tree(surface);
    for (std::size_t guest = 0; guest < muscles.size(); ++guest) {
      EndOnMuscle end{guest, host, body, joined_points(muscles[guest], body.body, surface, tree)};
      if (!end.points.empty()) ends.push_back(std::move(end));
    }
  }
  return ends;
}

Real joint_stiffness(const PreparedTissue& guest, const JoinedPoint& joined) {
  return guest.settings.attachment_stiffness * guest.points[static_cast<std::size_t>(joined.point)].area;
}

void prepare_joints(const std::vector<EndOnMuscle>& ends, std::vector<PreparedTissue>& muscles) {
  for (const EndOnMuscle& end : ends)
    for (const JoinedPoint& each : end.points)
      for (std::size_t k = 0; k < 3; ++k)
        muscles[end.host].points[static_cast<std::size_t>(each.place.corners[k])].joined_stiffness +=
            each.place.weights[static_cast<Index>(k)] * joint_stiffness(muscles[end.guest], each);
}

std::vector<std::vector<std::size_t>> joined_groups(const std::vector<EndOnMuscle>& ends, std::size_t muscles) {
  std::vector<std::size_t> first(muscles);
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t pass = 0; pass < ends.size(); ++pass)
    for (const EndOnMuscle& end : ends)
      first[end.guest] = first[end.host] = std::min(first[end.guest], first[end.host]);
  std::map<std::size_t, std::vector<std::size_t>> by_first;
  for (std::size_t m = 0; m < muscles; ++m) by_first[first[m]].push_back(m);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [_, group] : by_first)
    if (group.size() > 1) groups.push_back(std::move(group));
  return groups;
}

Matrix3 turn_of_patch(const EndOnMuscle& end, const Points& host_surface) {
  return motion_of(end.body, host_surface).linear();
}

void hold_on_host(const EndOnMuscle& end, const Matrix3& turn, const PlacedTissue& host, Surroundings& of_guest) {
  for (const JoinedPoint& each : end.points) {
    Vec3 place = turn * each.place.offset;
    for (int k = 0; k < 3; ++k)
      place += each.place.weights[k] * host.place(each.place.corners[static_cast<std::size_t>(k)]);
    of_guest.held.col(each.point) = place;
  }
}

void draw_host(const EndOnMuscle& end, const PlacedTissue& guest, const PlacedTissue& host,
               const Surroundings& of_guest, Surroundings& of_host) {
  for (const JoinedPoint& each : end.points) {
    const Vec3 apart = guest.place(each.point) - of_guest.held.col(each.point);
    for (int k = 0; k < 3; ++k) {
      const Index corner = each.place.corners[static_cast<std::size_t>(k)];
      draw(corner, host.place(corner) + apart, each.place.weights[k] * joint_stiffness(guest.muscle, each),
           static_cast<Index>(end.guest), of_host);
    }
  }
}

}  // namespace gracilis::tissue
