#include <gracilis/transfer/skeleton_fit.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/mesh/load_surface.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>

namespace gracilis {
namespace {

/// How messages name a bone of the subject.
std::string title_of(const FoundBone& bone) { return with_part(bone.file.string(), bone.part); }

constexpr Index coarse_samples = 400, samples = 1500;
/// A turn that nothing but a shape's symmetry speaks for must fit so much better than the one that the body's
/// directions give.
constexpr Real clearly_better = 0.8;
/// Bones of people differ by 0.03 to 0.06 of their size after the best similarity; a bone that is none by more.
constexpr Real doubtful_error = 0.1;

/// Landmarks known on both sides, each with the template's bone that is nearest.
std::vector<NamedPoints> points_by_bone(const NamedLandmarks& landmarks, const std::deque<PairedBone>& bones) {
  std::vector<NamedPoints> result(bones.size());
  for (const auto& [name, from] : landmarks.of_template) {
    const auto to = landmarks.of_subject.find(name);
    if (to == landmarks.of_subject.end()) continue;
    std::size_t nearest = 0;
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t b = 0; b < bones.size(); ++b)
      if (const Real distance = bones[b].from_tree().query(from).distance; distance < least)
        least = distance, nearest = b;
    NamedPoints& points = result[nearest];
    points.from.conservativeResize(3, points.count() + 1);
    points.to.conservativeResize(3, points.from.cols());
    points.from.rightCols(1) = from;
    points.to.rightCols(1) = to->second;
  }
  return result;
}

NamedPoints joined_points(const std::vector<NamedPoints>& all, const std::vector<std::size_t>& which) {
  NamedPoints result;
  for (const std::size_t b : which) {
    const Index before = result.count();
    result.from.conservativeResize(3, before + all[b].count());
    result.to.conservativeResize(3, before + all[b].count());
    result.from.rightCols(all[b].count()) = all[b].from;
    result.to.rightCols(all[b].count()) = all[b].to;
  }
  return result;
}

/// The best of all beginnings, the expected one where none is clearly better.
SimilarityFit best_similarity(const std::vector<const PairedBone*>& bones, const NamedPoints& named,
                              const Eigen::Matrix3d& expected) {
  SimilarityFit best = closest_similarity(bones, named, turned(bones, expected));
  std::vector<Similarity> others;
  if (named.count() >= 3) {
    const Eigen::Matrix4d motion = Eigen::umeyama(named.from, named.to, true);
    const Real scale = std::cbrt(motion.topLeftCorner<3, 3>().determinant());
    if (scale > 0) others.push_back({motion.topLeftCorner<3, 3>() / scale, scale, motion.topRightCorner<3, 1>()});
  }
  for (const Eigen::Matrix3d& turn : principal_turns(bones)) others.push_back(turned(bones, turn));
  std::vector<SimilarityFit> fits(others.size());
  parallel_for_each(others.size(), [&](std::size_t i) { fits[i] = closest_similarity(bones, named, others[i]); });
  const Real bar = clearly_better * best.error;
  for (const SimilarityFit& fit : fits)
    if (fit.error < bar && fit.error < best.error) best = fit;
  return best;
}

/// Where two bones would each fit the other's place clearly better than their own, their names are exchanged.
void require_own_names(const Scene& scene, const FoundFolder& subject, const std::vector<BoneMatch>& matches,
                       const std::vector<Real>& errors, const Eigen::Matrix3d& turn) {
  const auto error_of = [&](std::size_t a, std::size_t b) {
    const PairedBone pair("", scene.bones[static_cast<std::size_t>(matches[a].of_template)].surface,
                          subject.bones[matches[b].of_subject].mesh, coarse_samples);
    return best_similarity({&pair}, {}, turn).error;
  };
  for (std::size_t a = 0; a < matches.size(); ++a)
    for (std::size_t b = a + 1; b < matches.size(); ++b) {
      if (errors[a] < doubtful_error || errors[b] < doubtful_error) continue;
      if (error_of(a, b) > clearly_better * errors[a] || error_of(b, a) > clearly_better * errors[b]) continue;
      const FoundBone &one = subject.bones[matches[a].of_subject], &other = subject.bones[matches[b].of_subject];
      throw InputError({title_of(one), "",
                        fmt::format("looks like {}, and {} like {}: their names seem to be exchanged",
                                    scene.bones[static_cast<std::size_t>(matches[b].of_template)].name, title_of(other),
                                    scene.bones[static_cast<std::size_t>(matches[a].of_template)].name),
                        "rename them"});
    }
}

/// The nearest body towards the root that has bones; the first that has where there is none.
Index body_with_bones(const Scene& scene, Index body, const std::vector<char>& has_bones) {
  for (Index at = body;;) {
    if (has_bones[static_cast<std::size_t>(at)]) return at;
    const auto joint =
        std::find_if(scene.joints.begin(), scene.joints.end(), [&](const Joint& j) { return j.child_body == at; });
    if (joint == scene.joints.end()) break;
    at = joint->parent_body;
  }
  return static_cast<Index>(std::find(has_bones.begin(), has_bones.end(), 1) - has_bones.begin());
}

}  // namespace

SkeletonFit fit_skeleton(const Scene& scene, const FoundFolder& subject, const std::vector<BoneMatch>& matches,
                         const Eigen::Matrix3d& turn, const NamedLandmarks& landmarks,
                         const std::function<void(const std::string&)>& say) {
  std::deque<PairedBone> coarse, fine;
  for (const BoneMatch& match : matches) {
    const Bone& bone = scene.bones[static_cast<std::size_t>(match.of_template)];
    coarse.emplace_back(bone.name, bone.surface, subject.bones[match.of_subject].mesh, coarse_samples);
    fine.emplace_back(bone.name, bone.surface, subject.bones[match.of_subject].mesh, samples);
  }
  const std::vector<NamedPoints> named = points_by_bone(landmarks, coarse);
  SkeletonFit fit;
  fit.bodies.resize(scene.bodies.size());
  fit.has_bones.assign(scene.bodies.size(), 0);
  std::vector<Similarity> starts(matches.size());
  std::vector<Real> errors(matches.size());
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    std::vector<const PairedBone*> bones;
    std::vector<std::size_t> which;
    for (std::size_t m = 0; m < matches.size(); ++m)
      if (scene.bones[static_cast<std::size_t>(matches[m].of_template)].body == static_cast<Index>(body)) {
        bones.push_back(&coarse[m]);
        which.push_back(m);
      }
    if (bones.empty()) continue;
    fit.has_bones[body] = 1;
    fit.bodies[body] = best_similarity(bones, joined_points(named, which), turn).similarity;
    for (const std::size_t m : which) {
      SimilarityFit own = closest_similarity({&coarse[m]}, named[m], fit.bodies[body]);
      const SimilarityFit alone = best_similarity({&coarse[m]}, named[m], fit.bodies[body].rotation);
      if (alone.error < clearly_better * own.error) own = alone;
      starts[m] = own.similarity;
      errors[m] = own.error;
    }
  }
  require_own_names(scene, subject, matches, errors, turn);
  for (std::size_t m = 0; m < matches.size(); ++m)
    if (errors[m] > doubtful_error)
      fit.doubtful.push_back(
          fmt::format("{} and {} differ by {:.0f} % of their size before they are deformed: is it "
                      "the same bone, and whole?",
                      fine[m].name(), title_of(subject.bones[matches[m].of_subject]), 100 * errors[m]));
  fit.bones.resize(matches.size());
  parallel_for_each(matches.size(), [&](std::size_t m) {
    fit.bones[m] = {matches[m], register_bone(fine[m], named[m], starts[m])};
  });
  if (say) say(fmt::format("{} bones registered", matches.size()));
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    if (!fit.has_bones[body])
      fit.bodies[body] =
          fit.bodies[static_cast<std::size_t>(body_with_bones(scene, static_cast<Index>(body), fit.has_bones))];
  return fit;
}

}  // namespace gracilis
