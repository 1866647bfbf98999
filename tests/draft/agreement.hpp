#pragma once

#include <gracilis/scene/scene.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace gracilis {

/// How nearly an end of a drafted muscle is that of a scene written by hand.
struct EndAgreement {
  std::string muscle;
  AttachmentEnd end = AttachmentEnd::origin;
  std::size_t by_hand = 0, drafted = 0, common = 0;  ///< vertices
  Real apart = 0;                                    ///< m, between the middles
  bool same_body = false;

  Real share() const { return by_hand + drafted == 0 ? 0 : Real(common) / Real(by_hand + drafted - common); }
};

struct JointAgreement {
  std::string joint;
  Real apart = 0;            ///< m, between the centers
  Real from_axis = 0;        ///< m, of the drafted center from the other's first axis
  std::vector<Real> angles;  ///< rad, between the axes in their order
};

inline std::vector<Index> held_at(const Muscle& muscle, AttachmentEnd end) {
  std::vector<Index> all;
  for (const Attachment& each : muscle.attachments)
    if (each.end == end) all.insert(all.end(), each.vertices.begin(), each.vertices.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

inline Vec3 middle_of(const Muscle& muscle, const std::vector<Index>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const Index v : vertices) sum += muscle.surface.vertices.col(v);
  return sum / static_cast<Real>(std::max<std::size_t>(vertices.size(), 1));
}

/// Bodies are the same where they carry bones at the same place.
inline bool same_body(const Scene& a, Index of_a, const Scene& b, Index of_b) {
  for (const Bone& bone : a.bones) {
    if (bone.body != of_a) continue;
    for (const Bone& other : b.bones)
      if (other.body == of_b && (bone.surface.vertices.col(0) - other.surface.vertices.col(0)).norm() < 1e-6)
        return true;
  }
  return false;
}

inline Index body_at(const Muscle& muscle, AttachmentEnd end) {
  for (const Attachment& each : muscle.attachments)
    if (each.end == end) return each.body;
  return -1;
}

/// Of the muscles that both scenes have, told by their surfaces.
inline std::vector<EndAgreement> ends_compared(const Scene& by_hand, const Scene& drafted) {
  std::vector<EndAgreement> all;
  for (const Muscle& known : by_hand.muscles)
    for (const Muscle& other : drafted.muscles) {
      if (known.surface.vertex_count() != other.surface.vertex_count()) continue;
      if ((known.surface.vertices - other.surface.vertices).norm() > 1e-6) continue;
      for (const AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion}) {
        const std::vector<Index> a = held_at(known, end), b = held_at(other, end);
        std::vector<Index> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        all.push_back({other.name, end, a.size(), b.size(), common.size(),
                       (middle_of(known, a) - middle_of(other, b)).norm(),
                       same_body(by_hand, body_at(known, end), drafted, body_at(other, end))});
      }
    }
  return all;
}

/// Of the joints within 5 cm of each other.
inline std::vector<JointAgreement> joints_compared(const Scene& by_hand, const Scene& drafted) {
  std::vector<JointAgreement> all;
  for (const Joint& known : by_hand.joints)
    for (const Joint& other : drafted.joints) {
      const Vec3 apart = other.frame.translation() - known.frame.translation();
      if (apart.norm() > 0.05) continue;
      JointAgreement agreement{
          other.name, apart.norm(), (known.frame.linear() * known.axes[0].axis).cross(apart).norm(), {}};
      for (std::size_t i = 0; i < std::min(known.axes.size(), other.axes.size()); ++i)
        agreement.angles.push_back(std::acos(std::clamp(
            (known.frame.linear() * known.axes[i].axis).dot(other.frame.linear() * other.axes[i].axis), -1.0, 1.0)));
      all.push_back(agreement);
    }
  return all;
}

}  // namespace gracilis
