#include <gracilis/draft/sites.hpp>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

const std::set<std::string> hip_parts = {"ilium", "ischium", "pubis"};
const std::set<std::string> hip_wholes = {"hip_bone", "pelvis"};

/// How far beyond a part of a long bone, as shares of its length, its attachments reach in other people.
constexpr Real part_margin = 0.05;

}  // namespace

std::string segment_of(const Site& site) {
  if (site.bone.starts_with("#")) return site.bone.substr(1);
  const bool many = site.bone.ends_with("*");
  const std::string start = many ? site.bone.substr(0, site.bone.size() - 1) : site.bone;
  for (const KnownBone& bone : dictionary().bones)
    if (many ? bone.name.starts_with(start) : bone.name == start) return bone.segment;
  return "";
}

BoneParts::BoneParts(const FoundFolder& found, const Skeleton& skeleton) : found_(found), skeleton_(skeleton) {
  for (const FoundBone& bone : found.bones) trees_.emplace_back(bone.mesh);
}

bool BoneParts::matches(const Site& site, const FoundBone& bone, BodySide side) const {
  if (!bone.known || (bone.side != side && bone.side != BodySide::none && side != BodySide::none)) return false;
  if (site.bone.starts_with("#")) return bone.known->segment == site.bone.substr(1);
  if (site.bone.ends_with("*")) return bone.known->name.starts_with(site.bone.substr(0, site.bone.size() - 1));
  if (hip_parts.contains(site.bone) && hip_wholes.contains(bone.known->name)) return true;
  return bone.known->name == site.bone;
}

EndSites BoneParts::end_sites(const std::vector<Site>& sites, BodySide side) const {
  EndSites result;
  std::set<std::string> bodies;
  const auto add_body = [&](const std::string& body) {
    if (bodies.insert(body).second) result.bodies.push_back(body);
  };
  bool found_before = false;
  for (const Site& site : sites) {
    if (site.or_before && found_before) continue;
    found_before = false;
    result.wanted += (result.wanted.empty() ? "" : ", ") + site.bone;
    for (std::size_t b = 0; b < found_.bones.size(); ++b) {
      if (!matches(site, found_.bones[b], side)) continue;
      found_before = true;
      result.zones.push_back({b, site});
      add_body(body(b));
    }
  }
  if (!result.zones.empty()) return result;
  for (const Site& site : sites)
    if (const std::string segment = segment_of(site); !segment.empty()) add_body(skeleton_.body_of(segment, side));
  return result;
}

/// About the hip joint's center: the ilium above it, the pubis before and the ischium behind, each with a margin that
/// the others share.
bool BoneParts::in_hip_part(const std::string& part, const FoundBone& bone, const Vec3& p) const {
  const DraftJoint* joint = nullptr;
  for (const BodySide side : {BodySide::right, BodySide::left}) {
    if (bone.side != BodySide::none && bone.side != side) continue;
    for (const DraftJoint& each : skeleton_.joints)
      if (each.name == "hip" + side_ending(side) && (!joint || (each.center - p).norm() < (joint->center - p).norm()))
        joint = &each;
  }
  if (!joint) return true;
  const Vec3 from_center = (p - joint->center) / found_.size;
  const Real up = from_center.dot(skeleton_.frame.superior), forward = from_center.dot(skeleton_.frame.anterior);
  if (part == "ilium") return up > -0.005;
  if (part == "pubis") return up < 0.025 && forward > -0.01;
  return up < 0.015 && forward < 0.015;
}

bool BoneParts::in_zone(const Zone& zone, const Vec3& p) const {
  const FoundBone& bone = found_.bones[zone.bone];
  if (hip_parts.contains(zone.site.bone) && hip_wholes.contains(bone.known->name))
    return in_hip_part(zone.site.bone, bone, p);
  if (!zone.site.is_part() || !skeleton_.axes[zone.bone]) return true;
  const Real share = skeleton_.axes[zone.bone]->share(p);
  return share >= zone.site.from - part_margin && share <= zone.site.to + part_margin;
}

Real BoneParts::distance(const Zone& zone, const Vec3& p, Real reach) const {
  const NearestPoint nearest = trees_[zone.bone].query(p, reach);
  return nearest.face >= 0 && in_zone(zone, nearest.point) ? nearest.distance : std::numeric_limits<Real>::infinity();
}

}  // namespace gracilis
