#include <gracilis/transfer/bone_match.hpp>

#include <gracilis/draft/name_search.hpp>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

/// What a bone's name says, in comparable form.
struct BoneName {
  std::string bone;                 ///< of the dictionary; or all words, sorted
  std::multiset<std::string> rest;  ///< what else is said
  BodySide side = BodySide::none;
};

BoneName name_of(const std::string& text) {
  const NameWords words = read_name(text, dictionary().words);
  const NameMatch<KnownBone> match = find_bone(words);
  if (match.known) return {match.known->name, {match.rest.begin(), match.rest.end()}, words.side};
  BoneName name{"", {words.words.begin(), words.words.end()}, words.side};
  for (const std::string& word : name.rest) name.bone += word + " ";
  return name;
}

}  // namespace

BodySide side_of(const Scene& scene) {
  int right = 0, left = 0;
  for (const Bone& bone : scene.bones) {
    const BodySide side = name_of(bone.name).side;
    right += side == BodySide::right;
    left += side == BodySide::left;
  }
  return left > right ? BodySide::left : right > 0 ? BodySide::right : BodySide::none;
}

FoundFolder found_bones(const Scene& scene, Real size) {
  FoundFolder found;
  found.size = size;
  for (const Bone& bone : scene.bones) {
    const NameWords words = read_name(bone.name, dictionary().words);
    const NameMatch<KnownBone> match = find_bone(words);
    found.bones.push_back({bone.name, bone.name, "", match.known, words.side, match.certainty, bone.surface});
  }
  return found;
}

BoneMatches match_bones(const Scene& scene, const FoundFolder& subject) {
  std::vector<BoneName> names;
  for (const FoundBone& bone : subject.bones) {
    names.push_back(name_of(name_in_folder(bone)));
    names.back().side = bone.side;
  }
  BoneMatches matches;
  std::vector<char> used(subject.bones.size(), 0);
  for (std::size_t t = 0; t < scene.bones.size(); ++t) {
    const BoneName wanted = name_of(scene.bones[t].name);
    std::vector<std::size_t> same;
    for (std::size_t s = 0; s < names.size(); ++s)
      if (!used[s] && names[s].bone == wanted.bone && names[s].side == wanted.side) same.push_back(s);
    // Of several parts of one bone the one whose name says the same.
    const auto best =
        std::find_if(same.begin(), same.end(), [&](std::size_t s) { return names[s].rest == wanted.rest; });
    if (best == same.end() && same.size() != 1) {
      matches.missing.push_back(scene.bones[t].name);
      continue;
    }
    const std::size_t chosen = best == same.end() ? same.front() : *best;
    used[chosen] = 1;
    matches.pairs.push_back({static_cast<Index>(t), chosen});
  }
  for (std::size_t s = 0; s < used.size(); ++s)
    if (!used[s]) matches.not_needed.push_back(subject.bones[s].name);
  return matches;
}

}  // namespace gracilis
