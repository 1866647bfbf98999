#include <gracilis/methods/tissue/settle_joined.hpp>

#include <algorithm>

namespace gracilis::tissue {

namespace {

/// An end within the group, and how it has turned.
struct Joint {
  const EndOnMuscle* end = nullptr;
  std::size_t guest = 0, host = 0;  ///< in the group
  Matrix3 turn = Matrix3::Identity();
};

/// Where the nodes of each muscle begin among those of all.
std::vector<Index> first_nodes(const std::vector<JoinedTissue>& group) {
  std::vector<Index> first = {0};
  for (const JoinedTissue& each : group) first.push_back(first.back() + static_cast<Index>(each.nodes->cols()));
  return first;
}

std::vector<Joint> joints_of(const std::vector<EndOnMuscle>& ends, const std::vector<JoinedTissue>& group) {
  const auto place = [&](std::size_t number) {
    return static_cast<std::size_t>(
        std::find_if(group.begin(), group.end(), [&](const JoinedTissue& each) { return each.number == number; }) -
        group.begin());
  };
  std::vector<Joint> joints;
  for (const EndOnMuscle& end : ends) {
    const std::size_t guest = place(end.guest), host = place(end.host);
    if (guest == group.size() || host == group.size()) continue;
    joints.push_back({&end, guest, host, turn_of_patch(end, surface_at(*group[host].muscle, *group[host].nodes))});
  }
  return joints;
}

/// What the springs of a joint add to the derivative by the host's nodes.
void add_host_gradient(const Joint& joint, const PlacedTissue& guest, const Points& held, const PreparedTissue& host,
                       Eigen::Ref<Points> gradient) {
  for (const JoinedPoint& each : joint.end->points) {
    const Vec3 pull = joint_stiffness(guest.muscle, each) * (guest.place(each.point) - held.col(each.point));
    for (std::size_t k = 0; k < 3; ++k) {
      const EmbeddedPoint& at = host.points[static_cast<std::size_t>(each.place.corners[k])].at;
      for (std::size_t n = 0; n < 4; ++n)
        gradient.col(at.nodes[n]) -=
            each.place.weights[static_cast<Index>(k)] * at.weights[static_cast<Index>(n)] * pull;
    }
  }
}

/// The energy of a group and its derivative.
class JoinedEnergy {
 public:
  JoinedEnergy(const std::vector<JoinedTissue>& group, const std::vector<Joint>& joints)
      : group_(group), joints_(joints), first_(first_nodes(group)), workspaces_(group.size()) {}

  Points nodes_of(const Points& all, std::size_t i) const {
    return all.middleCols(first_[i], first_[i + 1] - first_[i]);
  }

  Points together() const {
    Points all(3, first_.back());
    for (std::size_t i = 0; i < group_.size(); ++i)
      all.middleCols(first_[i], first_[i + 1] - first_[i]) = *group_[i].nodes;
    return all;
  }

  Real operator()(const Points& all, Points& gradient) {
    std::vector<Points> nodes;
    for (std::size_t i = 0; i < group_.size(); ++i) nodes.push_back(nodes_of(all, i));
    const auto placed = [&](std::size_t i) { return PlacedTissue{*group_[i].muscle, nodes[i]}; };
    for (const Joint& joint : joints_)
      hold_on_host(*joint.end, joint.turn, placed(joint.host), *group_[joint.guest].around);
    gradient.resize(3, all.cols());
    Real sum = 0;
    Points of_one;
    for (std::size_t i = 0; i < group_.size(); ++i) {
      sum += total_energy(*group_[i].muscle, *group_[i].around, nodes[i], workspaces_[i], of_one);
      gradient.middleCols(first_[i], of_one.cols()) = of_one;
    }
    for (const Joint& joint : joints_)
      add_host_gradient(joint, placed(joint.guest), group_[joint.guest].around->held, *group_[joint.host].muscle,
                        gradient.middleCols(first_[joint.host], first_[joint.host + 1] - first_[joint.host]));
    return sum;
  }

  void by_metric(std::span<Points> gradients) const {
    for (std::size_t i = 0; i < group_.size(); ++i) {
      std::vector<Points> blocks;
      for (const Points& each : gradients) blocks.push_back(nodes_of(each, i));
      group_[i].metric->solve(blocks);
      for (std::size_t k = 0; k < blocks.size(); ++k)
        gradients[k].middleCols(first_[i], first_[i + 1] - first_[i]) = blocks[k];
    }
  }

 private:
  const std::vector<JoinedTissue>& group_;
  const std::vector<Joint>& joints_;
  std::vector<Index> first_;
  std::vector<EnergyWorkspace> workspaces_;
};

void draw_hosts(const std::vector<Joint>& joints, const std::vector<JoinedTissue>& group) {
  const auto placed = [&](std::size_t i) { return PlacedTissue{*group[i].muscle, *group[i].nodes}; };
  for (const Joint& joint : joints)
    hold_on_host(*joint.end, joint.turn, placed(joint.host), *group[joint.guest].around);
  for (const Joint& joint : joints)
    draw_host(*joint.end, placed(joint.guest), placed(joint.host), *group[joint.guest].around,
              *group[joint.host].around);
}

}  // namespace

Minimized settle_joined(const std::vector<EndOnMuscle>& ends, const std::vector<JoinedTissue>& group, int iterations) {
  MinimizeSettings settings;
  settings.iterations = iterations;
  settings.residual = settings.largest_move = std::numeric_limits<Real>::infinity();
  for (const JoinedTissue& each : group) {
    settings.residual = std::min(settings.residual, each.muscle->settings.minimizer_residual);
    settings.largest_move = std::min(settings.largest_move, each.muscle->lattice.cell_size);
    each.around->drawn_by.clear();  // here the springs are those of the guests
    find_near_bones(*each.muscle, *each.nodes, *each.around);
  }
  const std::vector<Joint> joints = joints_of(ends, group);
  JoinedEnergy energy(group, joints);
  Points all = energy.together();
  const Minimized done = minimize([&](const Points& at, Points& gradient) { return energy(at, gradient); },
                                  [&](std::span<Points> gradients) { energy.by_metric(gradients); }, settings, all);
  for (std::size_t i = 0; i < group.size(); ++i) *group[i].nodes = energy.nodes_of(all, i);
  draw_hosts(joints, group);
  return done;
}

}  // namespace gracilis::tissue
