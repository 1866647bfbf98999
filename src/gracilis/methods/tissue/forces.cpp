#include <gracilis/methods/tissue/forces.hpp>

#include <gracilis/methods/tissue/lattice_field.hpp>
#include <gracilis/methods/tissue/point_actions.hpp>

#include <algorithm>

namespace gracilis::tissue {

namespace {

/// How far the fibers of every cell are stretched; 0 where there are none.
Eigen::VectorXd fiber_stretches(const PreparedTissue& muscle, const Points& nodes) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(muscle.lattice.cell_count());
  for (Index axis = 0; axis < 3; ++axis)
    squares += cell_gradients(muscle.lattice, nodes.row(axis))
                   .cwiseProduct(muscle.directions)
                   .colwise()
                   .sum()
                   .transpose()
                   .cwiseAbs2();
  return squares.cwiseSqrt();
}

/// Tension per area at rest in every cell, Pa.
Eigen::VectorXd fiber_stresses(const PreparedTissue& muscle, const std::vector<CellLaw>& laws, const Points& nodes) {
  Eigen::VectorXd stresses = fiber_stretches(muscle, nodes);
  for (Index c = 0; c < static_cast<Index>(stresses.size()); ++c)
    if (stresses[c] > 0) stresses[c] = fiber_curve(laws[static_cast<std::size_t>(c)].fibers, stresses[c]).slope;
  return stresses;
}

/// Where a list has the entry of a body or bone; a new one at its end.
Wrench& wrench_on(Index on, std::vector<ForceOn>& list) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const ForceOn& each) { return each.on == on; });
  return found != list.end() ? found->wrench : list.emplace_back(ForceOn{on, {}}).wrench;
}

std::vector<ForceOn>& list_of(PointActor actor, bool at_origin, MuscleForces& forces) {
  switch (actor) {
    case PointActor::attachment:
      return at_origin ? forces.origin : forces.insertion;
    case PointActor::fascia:
      return forces.fascia;
    case PointActor::bone:
      return forces.contact;
    default:
      return forces.muscles;
  }
}

/// All that may ever act, in the order of bodies and bones, without force.
MuscleForces listed(const PreparedTissue& muscle, const Surroundings& around) {
  MuscleForces forces;
  forces.is_known = true;
  for (const Index other : around.others) wrench_on(other, forces.muscles);
  for (const SurfacePoint& point : muscle.points)
    if (point.held_by >= 0)
      wrench_on(point.held_by, point.end == AttachmentEnd::origin ? forces.origin : forces.insertion);
  for (const Tie& tie : muscle.ties) wrench_on(tie.body, forces.fascia);
  for (std::size_t b = 0; b < muscle.bones.size(); ++b) wrench_on(static_cast<Index>(b), forces.contact);
  for (std::vector<ForceOn>* list : {&forces.origin, &forces.insertion, &forces.fascia})
    std::sort(list->begin(), list->end(), [](const ForceOn& a, const ForceOn& b) { return a.on < b.on; });
  return forces;
}

Real power(const Wrench& wrench, const Twist& twist) {
  return wrench.force.dot(twist.velocity) + wrench.moment.dot(twist.turning);
}

Real moment_of(const PreparedTissue& muscle, const MuscleForces& forces, const std::vector<Twist>& bodies) {
  Real sum = 0;
  for (const std::vector<ForceOn>* list : {&forces.origin, &forces.insertion, &forces.fascia})
    for (const ForceOn& each : *list) sum += power(each.wrench, bodies[static_cast<std::size_t>(each.on)]);
  for (const ForceOn& each : forces.contact) {
    const Index body = muscle.bones[static_cast<std::size_t>(each.on)].body;
    sum += power(each.wrench, bodies[static_cast<std::size_t>(body)]);
  }
  return sum;
}

/// The work on the nodes where they move with their shares of the bodies.
Real carried_work(const PreparedTissue& muscle, const Points& gradient, const Points& nodes,
                  const std::vector<Twist>& bodies) {
  Real sum = 0;
  for (Index n = 0; n < static_cast<Index>(nodes.cols()); ++n)
    for (std::size_t b = 0; b < muscle.carriers.size(); ++b) {
      const Twist& twist = bodies[static_cast<std::size_t>(muscle.carriers[b])];
      sum += muscle.skinning_weights(n, static_cast<Index>(b)) * gradient.col(n).dot(twist.velocity_at(nodes.col(n)));
    }
  return sum;
}

}  // namespace

Wrench attachment_wrench(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                         AttachmentEnd end) {
  Wrench sum;
  const Points places = points_at(muscle, nodes);
  for (std::size_t v = 0; v < muscle.points.size(); ++v) {
    if (muscle.points[v].held_by < 0 || muscle.points[v].end != end) continue;
    const Vec3 p = places.col(static_cast<Index>(v));
    for_each_action(muscle, around, v, p,
                    [&](PointActor, Index, const PointState& acting) { sum.add(p, acting.gradient); });
  }
  return sum;
}

Real mean_tension(const PreparedTissue& muscle, const std::vector<CellLaw>& laws, const Points& nodes) {
  const Eigen::VectorXd stresses = fiber_stresses(muscle, laws, nodes);
  Real sum = 0;
  for (std::size_t c = 0; c < muscle.lattice.cells.size(); ++c)
    sum += filled_volume(muscle.lattice, muscle.lattice.cells[c]) * stresses[static_cast<Index>(c)] *
           muscle.fiber_density[c];
  return sum;
}

std::vector<Real> fiber_tensions(const PreparedTissue& muscle, const std::vector<CellLaw>& laws, const Points& nodes) {
  const Eigen::VectorXd stresses = fiber_stresses(muscle, laws, nodes);
  const auto count = muscle.fiber_cells.size();
  std::vector<Real> tensions;
  for (const std::vector<Index>& cells : muscle.fiber_cells) {
    Real sum = 0;
    for (const Index c : cells) sum += stresses[c] / muscle.relative_tension[static_cast<std::size_t>(c)];
    const Real mean = cells.empty() ? 0 : sum / static_cast<Real>(cells.size());
    tensions.push_back(mean * muscle.mean_section / static_cast<Real>(count));
  }
  return tensions;
}

Eigen::VectorXd vertex_fiber_stresses(const PreparedTissue& muscle, const std::vector<CellLaw>& laws,
                                      const Points& nodes) {
  const Eigen::VectorXd of_cells = fiber_stresses(muscle, laws, nodes);
  const Index count = muscle.lattice.node_count();
  Eigen::VectorXd of_nodes = Eigen::VectorXd::Zero(count), filled = of_nodes;
  for (std::size_t c = 0; c < muscle.lattice.cells.size(); ++c)
    for (const Index n : muscle.lattice.cells[c].nodes) {
      filled[n] += muscle.lattice.cells[c].fill;
      of_nodes[n] += muscle.lattice.cells[c].fill * of_cells[static_cast<Index>(c)];
    }
  of_nodes = of_nodes.cwiseQuotient(filled);
  Eigen::VectorXd stresses(muscle.vertex_count);
  for (Index v = 0; v < muscle.vertex_count; ++v) {
    const EmbeddedPoint& at = muscle.points[static_cast<std::size_t>(v)].at;
    Real sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += at.weights[static_cast<Index>(k)] * of_nodes[at.nodes[k]];
    stresses[v] = std::max(0.0, sum);
  }
  return stresses;
}

MuscleForces muscle_forces(const PreparedTissue& muscle, const Surroundings& around, const std::vector<CellLaw>& laws,
                           const Points& nodes, const std::vector<std::vector<Twist>>& coordinates) {
  MuscleForces forces = listed(muscle, around);
  forces.tension = mean_tension(muscle, laws, nodes);
  forces.fiber_tensions = fiber_tensions(muscle, laws, nodes);
  const Points places = points_at(muscle, nodes);
  for (std::size_t v = 0; v < muscle.points.size(); ++v) {
    const Vec3 p = places.col(static_cast<Index>(v));
    const bool at_origin = muscle.points[v].end == AttachmentEnd::origin;
    // Where point and body move together nothing changes, so the body feels at the point what the point resists.
    for_each_action(muscle, around, v, p, [&](PointActor actor, Index on, const PointState& acting) {
      if (actor == PointActor::muscle && on < 0) return;  // what it does to itself
      wrench_on(on, list_of(actor, at_origin, forces)).add(p, acting.gradient);
    });
  }
  Points gradient;
  EnergyWorkspace workspace;
  total_energy(muscle, around, nodes, workspace, gradient);
  for (const std::vector<Twist>& bodies : coordinates) {
    forces.moments.push_back(moment_of(muscle, forces, bodies));
    forces.moments_by_work.push_back(forces.moments.back() - carried_work(muscle, gradient, nodes, bodies));
  }
  return forces;
}

}  // namespace gracilis::tissue
