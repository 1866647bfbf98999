#include <gracilis/methods/mass_spring/sphere_collisions.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>

namespace gracilis::mass_spring {

namespace {

/// How far apart two spheres want to be, m.
Real reach_of(const Spheres& a, Index s, const Spheres& b, Index t, bool keeps_rest_gap, const Points& rest_a,
              const Points& rest_b) {
  const Real radii = a.radii[static_cast<std::size_t>(s)] + b.radii[static_cast<std::size_t>(t)];
  return keeps_rest_gap ? std::min(radii, (rest_a.col(s) - rest_b.col(t)).norm()) : radii;
}

}  // namespace

Response response(const Vec3& a, const Vec3& b, Real reach, bool a_is_fixed, bool b_is_fixed) {
  const Vec3 apart = a - b;
  const Real distance = apart.norm();
  if (!(distance < reach) || !(distance > 0) || (a_is_fixed && b_is_fixed)) return {};
  const Vec3 missing = (reach - distance) / distance * apart;
  if (a_is_fixed) return {Vec3::Zero(), -missing};
  if (b_is_fixed) return {missing, Vec3::Zero()};
  return {missing / 2, -missing / 2};
}

std::vector<std::vector<std::array<std::size_t, 2>>> rounds_of_pairs(std::size_t count) {
  std::vector<std::vector<std::array<std::size_t, 2>>> rounds;
  // The last seat stays, all others move on by one; of an odd number whoever meets the empty seat rests.
  const std::size_t seats = count + count % 2;
  for (std::size_t round = 0; round + 1 < seats; ++round) {
    rounds.emplace_back();
    for (std::size_t i = 0; i < seats / 2; ++i) {
      const std::size_t a = (round + i) % (seats - 1);
      const std::size_t b = i == 0 ? seats - 1 : (round + seats - 1 - i) % (seats - 1);
      if (std::max(a, b) < count) rounds.back().push_back({std::min(a, b), std::max(a, b)});
    }
  }
  return rounds;
}

SphereCollisions::SphereCollisions(const std::vector<MuscleSpheres>& muscles, const std::vector<PlacedSpheres>& bones,
                                   bool between_muscles, TreeUpdate update)
    : muscles_(muscles),
      between_muscles_(between_muscles),
      answers_(muscles.size()),
      rounds_(rounds_of_pairs(muscles.size() + bones.size())) {
  for (const MuscleSpheres& muscle : muscles) {
    auto placed = std::make_unique<Placed>(Placed{muscle.rest, muscle.rest, nullptr});
    placed->tree = std::make_unique<SphereTree>(placed->now, update);
    placed_.push_back(std::move(placed));
  }
  for (const PlacedSpheres& bone : bones) {
    auto placed = std::make_unique<Placed>(Placed{bone.rest, bone.rest, nullptr});
    placed->now.centers = bone.motion * bone.rest.centers;
    placed->tree = std::make_unique<SphereTree>(placed->now, update);
    bones_.push_back(std::move(placed));
  }
}

void SphereCollisions::meet_muscles(std::size_t m, std::size_t n) {
  const MuscleSpheres &one = muscles_[m], &other = muscles_[n];
  const Placed &a = *placed_[m], &b = *placed_[n];
  const bool keeps_rest_gap = one.keeps_rest_gap || other.keeps_rest_gap;
  for (const auto& [s, t] : SphereTree::intersecting(*a.tree, *b.tree)) {
    const Real reach = reach_of(a.now, s, b.now, t, keeps_rest_gap, a.rest.centers, b.rest.centers);
    const bool s_is_fixed = one.fixed[static_cast<std::size_t>(s)],
               t_is_fixed = other.fixed[static_cast<std::size_t>(t)];
    const Response moved = response(a.now.centers.col(s), b.now.centers.col(t), reach, s_is_fixed, t_is_fixed);
    if (moved.a.isZero(0) && moved.b.isZero(0)) continue;
    answers_[m].shifts.col(s) += moved.a;
    answers_[n].shifts.col(t) += moved.b;
    answers_[m].is_hit[static_cast<std::size_t>(s)] = answers_[n].is_hit[static_cast<std::size_t>(t)] = 1;
    ++answers_[m].collisions;
    ++answers_[n].collisions;
  }
}

void SphereCollisions::meet_bone(std::size_t m, Placed& bone) {
  const Placed& muscle = *placed_[m];
  for (const auto& [s, t] : SphereTree::intersecting(*muscle.tree, *bone.tree)) {
    const Real reach =
        reach_of(muscle.now, s, bone.now, t, muscles_[m].keeps_rest_gap, muscle.rest.centers, bone.rest.centers);
    const bool is_fixed = muscles_[m].fixed[static_cast<std::size_t>(s)];
    const Response moved = response(muscle.now.centers.col(s), bone.now.centers.col(t), reach, is_fixed, true);
    if (moved.a.isZero(0)) continue;
    answers_[m].shifts.col(s) += moved.a;
    answers_[m].is_hit[static_cast<std::size_t>(s)] = 1;
    ++answers_[m].collisions;
  }
}

/// Two muscles, or a muscle and a bone; nothing else collides.
void SphereCollisions::meet(std::size_t a, std::size_t b) {
  const std::size_t muscle_count = muscles_.size();
  if (b < muscle_count) {
    if (between_muscles_) meet_muscles(a, b);
  } else if (a < muscle_count && muscles_[a].meets_bones) {
    meet_bone(a, *bones_[b - muscle_count]);
  }
}

/// Moves the particles that were hit, and stops them.
void SphereCollisions::answer(std::size_t m, Motion& motion) const {
  for (std::size_t s = 0; s < answers_[m].is_hit.size(); ++s) {
    if (!answers_[m].is_hit[s] || muscles_[m].fixed[s]) continue;
    const Index p = muscles_[m].particles[s];
    motion.now.col(p) += answers_[m].shifts.col(static_cast<Index>(s));
    motion.before.col(p) = motion.now.col(p);
  }
}

std::vector<Index> SphereCollisions::resolve(std::vector<RelaxedMuscle>& muscles) {
  parallel_for_each(muscles.size(), [&](std::size_t m) {
    const std::vector<Index>& particles = muscles_[m].particles;
    for (std::size_t s = 0; s < particles.size(); ++s)
      placed_[m]->now.centers.col(static_cast<Index>(s)) = muscles[m].motion.now.col(particles[s]);
    placed_[m]->tree->update();
    answers_[m] = {Points::Zero(3, static_cast<Index>(particles.size())), std::vector<char>(particles.size(), 0), 0};
  });
  // Looking for pairs divides both trees, so no two pairs with one in common are looked for at once.
  for (const auto& round : rounds_)
    parallel_for_each(round.size(), [&](std::size_t i) { meet(round[i][0], round[i][1]); });
  std::vector<Index> collisions(muscles.size());
  parallel_for_each(muscles.size(), [&](std::size_t m) {
    answer(m, muscles[m].motion);
    collisions[m] = answers_[m].collisions;
  });
  return collisions;
}

}  // namespace gracilis::mass_spring
