#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/draft/name_words.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

/// What is known of human anatomy by names: read from bones.toml, spine.toml, joints.toml, muscles_*.toml, tendons.toml
/// and words.toml, which are compiled in. Lengths in m, angles in rad.
namespace gracilis {

/// The words of a name, in any order.
using Alias = std::vector<std::string>;

struct KnownBone {
  std::string name, segment;
  std::vector<Alias> aliases;
  bool paired = false;
  Real length = 0;                          ///< largest extent
  Vec3 place = Vec3::Zero();                ///< forward, up, right, of a person who stands upright
  std::optional<std::array<Vec3, 2>> ends;  ///< near, far; likewise
};

/// Where a muscle ends: a part of a bone (shares of its length from the near end), "name*": all whose names begin so,
/// "#segment": all bones of it.
struct Site {
  std::string bone;
  Real from = 0, to = 1;
  bool or_before = false;  ///< only where the bone of the site before is not here

  bool is_part() const { return from > 0 || to < 1; }  ///< not the whole bone
};

struct KnownMuscle {
  std::string name;
  std::vector<Alias> aliases;
  std::vector<Site> origin, insertion;
  Real fiber_length = 0;  ///< m, of a grown person, of a muscle whose fibers run from one aponeurosis to another
};

/// A tendon of several muscles.
struct KnownTendon {
  std::string name;
  bool at_origin = false;            ///< of each of them; else at the insertion
  std::vector<std::string> muscles;  ///< names in the dictionary; the first is taken where several would do

  bool joins(const KnownMuscle& muscle) const;  ///< whether the muscle is one of them
};

struct KnownSegment {
  std::string name, parent, body;
  bool paired = false;
};

struct KnownCoordinate {
  std::string name;
  std::string about;  ///< "right", "anterior" or "superior", perhaps with "-"
  Real range_min = -pi, range_max = pi;
  std::optional<Real> shown;  ///< how far a default motion goes
};

enum class JointKind { ball, condyles, roller, pivot, saddle, disc, masses };

struct KnownJoint {
  std::string name, parent, child;  ///< segments
  JointKind kind = JointKind::ball;
  std::vector<std::string> convex, concave;  ///< bones
  Real radius_min = 0, radius_max = 0;
  std::vector<std::string> only_with;  ///< muscles
  std::vector<KnownCoordinate> coordinates;
  std::vector<std::string> not_with = {};  ///< bones; "name*": all whose names begin so

  bool is_of_spine() const { return kind == JointKind::disc || kind == JointKind::masses; }  ///< between vertebrae
};

struct Dictionary {
  WordTables words;
  std::vector<KnownBone> bones;
  std::vector<KnownMuscle> muscles;
  std::vector<KnownTendon> tendons;
  std::vector<KnownSegment> segments;  ///< parents before children
  std::vector<KnownJoint> joints;

  /// By its name. Throws std::logic_error where there is none.
  const KnownSegment& segment(const std::string& name) const;
};

/// Everything that is compiled in; read once, at the first call.
const Dictionary& dictionary();

/// `name` with {s} as the ending of the side, and, where there is no {s}, as it is.
std::string with_side(std::string name, BodySide side);

}  // namespace gracilis
