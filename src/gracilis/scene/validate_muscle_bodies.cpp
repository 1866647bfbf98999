#include <gracilis/scene/validate_muscle_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>

namespace gracilis {

namespace {

struct MuscleBodyCheck {
  const Scene& scene;
  std::vector<Problem> problems;

  bool is_body(Index body) const { return body > 0 && body < static_cast<Index>(scene.bodies.size()); }
  std::string where(const MuscleBody& each) const {
    return is_body(each.body) ? "body '" + scene.bodies[static_cast<std::size_t>(each.body)] + "'"
                              : "a body that a muscle carries";
  }
  void add(const MuscleBody& each, const std::string& what, const std::string& remedy = "") {
    problems.push_back({"", where(each), what, remedy});
  }

  void check_patch(const MuscleBody& each, const Muscle& muscle) {
    const std::vector<Index>& patch = each.patch;
    if (patch.empty()) add(each, "lies on no vertex of " + muscle.name, "give larger distances, or check the units");
    if (std::adjacent_find(patch.begin(), patch.end(), std::greater_equal<>()) != patch.end())
      add(each, "its vertices do not ascend");
    if (std::any_of(patch.begin(), patch.end(), [&](Index v) { return v < 0 || v >= muscle.surface.vertex_count(); }))
      add(each, "lies on a vertex that " + muscle.name + " does not have");
  }

  void check_shares(const MuscleBody& each) {
    const Real sum = std::accumulate(each.shares.begin(), each.shares.end(), Real{0});
    bool is_sound = each.shares.size() == each.bodies.size() && each.center.allFinite();
    is_sound = is_sound && (each.bodies.empty() || std::abs(sum - 1) < 1e-3);
    for (const Index body : each.bodies) is_sound = is_sound && body >= 0 && (body == 0 || is_body(body));
    if (!is_sound) add(each, "the shares of the bodies that carry it are not right", "make it by add_muscle_body");
  }

  void check(const MuscleBody& each, std::set<Index>& carried) {
    if (!is_body(each.body)) return add(each, "it is number " + std::to_string(each.body) + ", which does not exist");
    if (!carried.insert(each.body).second) add(each, "is carried by two muscles");
    for (const Joint& joint : scene.joints)
      if (joint.child_body == each.body) add(each, "is moved by joint '" + joint.name + "' and carried by a muscle");
    if (each.muscle < 0 || each.muscle >= static_cast<Index>(scene.muscles.size()))
      return add(each, "the muscle that carries it does not exist");
    check_patch(each, scene.muscles[static_cast<std::size_t>(each.muscle)]);
    check_shares(each);
  }

  /// Whether, going from muscle to muscle below it, one comes back to where one was.
  bool goes_around(Index muscle, std::set<Index> above) const {
    if (!above.insert(muscle).second) return true;
    for (const Attachment& attachment : scene.muscles[static_cast<std::size_t>(muscle)].attachments)
      if (const MuscleBody* below = muscle_body(scene, attachment.body))
        if (goes_around(below->muscle, above)) return true;
    return false;
  }
};

}  // namespace

std::vector<Problem> muscle_body_problems(const Scene& scene) {
  MuscleBodyCheck check{scene, {}};
  std::set<Index> carried;
  for (const MuscleBody& each : scene.muscle_bodies) check.check(each, carried);
  if (!check.problems.empty()) return check.problems;
  for (const MuscleBody& each : scene.muscle_bodies)
    if (check.goes_around(each.muscle, {}))
      check.add(each, scene.muscles[static_cast<std::size_t>(each.muscle)].name + " lies on itself by way of others",
                "attach one of them to bones alone");
  return check.problems;
}

}  // namespace gracilis
