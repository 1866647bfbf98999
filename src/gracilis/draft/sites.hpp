#pragma once

#include <gracilis/draft/skeleton.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// The segment that a site's bones belong to.
std::string segment_of(const Site& site);

/// A part of a bone that is here.
struct Zone {
  std::size_t bone = 0;  ///< in FoundFolder::bones
  Site site;
};

/// Where a muscle's end may lie among the bones that are here, by the dictionary.
struct EndSites {
  std::vector<Zone> zones;
  std::vector<std::string> bodies;  ///< those of the zones; where no bone is here, of what the missing ones go with
  std::string wanted;               ///< the dictionary's bones, for messages
};

/// The bones with their nearest points and parts.
class BoneParts {
 public:
  /// Both must outlive it.
  BoneParts(const FoundFolder& found, const Skeleton& skeleton);

  /// What of the sites is here on that side; where no bone is, the bodies that missing ones go with.
  EndSites end_sites(const std::vector<Site>& sites, BodySide side) const;

  /// The distance from p to the bone; infinite beyond `reach` or where the nearest point is outside of the zone.
  Real distance(const Zone& zone, const Vec3& p, Real reach) const;
  /// Of a bone, by its number in FoundFolder::bones.
  const NearestTriangle& tree(std::size_t bone) const { return trees_[bone]; }
  const std::string& body(std::size_t bone) const { return skeleton_.bodies[bone]; }  ///< that the bone goes with
  const FoundBone& bone(std::size_t bone) const { return found_.bones[bone]; }        ///< by its number
  std::size_t count() const { return trees_.size(); }                                 ///< of bones

 private:
  bool matches(const Site& site, const FoundBone& bone, BodySide side) const;
  bool in_zone(const Zone& zone, const Vec3& p) const;
  bool in_hip_part(const std::string& part, const FoundBone& bone, const Vec3& p) const;

  const FoundFolder& found_;
  const Skeleton& skeleton_;
  std::vector<NearestTriangle> trees_;
};

}  // namespace gracilis
