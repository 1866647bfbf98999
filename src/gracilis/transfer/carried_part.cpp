#include <gracilis/transfer/carried_part.hpp>

#include <algorithm>
#include <numeric>
#include <set>

namespace gracilis {
namespace {

using Marks = std::vector<char>;

bool is_marked(const Marks& marks, Index body) { return marks[static_cast<std::size_t>(body)] != 0; }

std::string body_name(const Scene& scene, Index body) { return scene.bodies[static_cast<std::size_t>(body)]; }

void leave_out_joints(Scene& scene, const Marks& has_bones, std::vector<std::string>& left_out) {
  std::erase_if(scene.joints, [&](const Joint& joint) {
    if (is_marked(has_bones, joint.child_body) && is_marked(has_bones, joint.parent_body)) return false;
    const Index lacking = is_marked(has_bones, joint.child_body) ? joint.parent_body : joint.child_body;
    left_out.push_back("joint " + joint.name + ": the subject has no bone of " + body_name(scene, lacking));
    return true;
  });
}

/// Of each body the first one that joints connect it with. Joints stand parents before children.
std::vector<Index> first_of_parts(const Scene& scene) {
  std::vector<Index> first(scene.bodies.size());
  std::iota(first.begin(), first.end(), 0);
  for (const Joint& joint : scene.joints) {
    const Index kept = first[static_cast<std::size_t>(joint.parent_body)],
                joined = first[static_cast<std::size_t>(joint.child_body)];
    std::replace(first.begin(), first.end(), joined, kept);
  }
  return first;
}

/// Bodies of the part in which most muscles end with all of their ends on bones; of parts with as many, the first.
Marks largest_part(const Scene& scene, const Marks& has_bones) {
  const std::vector<Index> first = first_of_parts(scene);
  std::vector<int> muscles(scene.bodies.size(), 0);
  for (const Muscle& muscle : scene.muscles) {
    std::set<Index> parts;
    for (const Attachment& attachment : muscle.attachments)
      if (!muscle_body(scene, attachment.body)) parts.insert(first[static_cast<std::size_t>(attachment.body)]);
    if (parts.size() == 1) ++muscles[static_cast<std::size_t>(*parts.begin())];
  }
  for (std::size_t body = 0; body < has_bones.size(); ++body)
    if (!has_bones[body] && first[body] == static_cast<Index>(body)) muscles[body] = -1;
  const auto most = std::max_element(muscles.begin(), muscles.end()) - muscles.begin();
  Marks part(has_bones.size(), 0);
  for (std::size_t body = 0; body < part.size(); ++body) part[body] = has_bones[body] && first[body] == most;
  return part;
}

void leave_out_bones(Scene& scene, const Marks& part, const std::string& other, std::vector<std::string>& left_out) {
  std::erase_if(scene.bones, [&](const Bone& bone) {
    if (is_marked(part, bone.body)) return false;
    left_out.push_back("bone " + bone.name + ": no joint is left between " + body_name(scene, bone.body) + " and " +
                       other);
    return true;
  });
}

/// Why a muscle cannot be carried; nothing where it can.
std::string hindrance(const Scene& scene, const Muscle& muscle, const Marks& has_bones, const Marks& part,
                      const std::string& other, const std::set<std::string>& without) {
  for (const Attachment& attachment : muscle.attachments) {
    if (const MuscleBody* on = muscle_body(scene, attachment.body)) {
      const std::string lower = scene.muscles[static_cast<std::size_t>(on->muscle)].name;
      if (without.count(lower)) return "it lies on " + lower;
    } else if (!is_marked(has_bones, attachment.body)) {
      return "the subject has no bone of " + body_name(scene, attachment.body);
    } else if (!is_marked(part, attachment.body)) {
      return "no joint is left between " + body_name(scene, attachment.body) + " and " + other;
    }
  }
  return {};
}

/// With the bodies that they carry; the others' carriers are numbered anew.
void leave_out_muscles(Scene& scene, const std::set<std::string>& without) {
  std::vector<Index> numbers;
  std::vector<Muscle> kept;
  for (Muscle& muscle : scene.muscles) {
    const bool goes = without.count(muscle.name) > 0;
    numbers.push_back(goes ? -1 : static_cast<Index>(kept.size()));
    if (!goes) kept.push_back(std::move(muscle));
  }
  scene.muscles = std::move(kept);
  for (MuscleBody& body : scene.muscle_bodies) body.muscle = numbers[static_cast<std::size_t>(body.muscle)];
  std::erase_if(scene.muscle_bodies, [](const MuscleBody& body) { return body.muscle < 0; });
}

}  // namespace

void keep_connected_part(Scene& scene, const Marks& has_bones, std::vector<std::string>& left_out) {
  leave_out_joints(scene, has_bones, left_out);
  const Marks part = largest_part(scene, has_bones);
  std::erase_if(scene.joints, [&](const Joint& joint) { return !is_marked(part, joint.child_body); });
  const auto other = std::find(part.begin(), part.end(), 1) - part.begin();
  const std::string name = body_name(scene, other);
  leave_out_bones(scene, part, name, left_out);
  std::set<std::string> without;
  // Again as long as any goes, for muscles that lie on others.
  for (bool any = true; any;) {
    any = false;
    for (const Muscle& muscle : scene.muscles) {
      if (without.count(muscle.name)) continue;
      const std::string why = hindrance(scene, muscle, has_bones, part, name, without);
      if (why.empty()) continue;
      left_out.push_back("muscle " + muscle.name + ": " + why);
      without.insert(muscle.name);
      any = true;
    }
  }
  leave_out_muscles(scene, without);
}

}  // namespace gracilis
