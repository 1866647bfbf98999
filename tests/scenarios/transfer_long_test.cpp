#include "scenario_runs.hpp"

#include "io/test_files.hpp"

#include <gracilis/geometry/measures.hpp>
#include <gracilis/transfer/transfer_folder.hpp>
#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/separation.hpp>
#endif

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cstdlib>

/// The cadaver's hip and the leg of an atlas, scanned and cut differently, each as the other's template.
namespace gracilis {
namespace {

namespace fs = std::filesystem;

/// An end of a muscle that both have: how far apart the middles of the areas are, and how far from the other's area the
/// vertices of each are on average, m.
struct EndDistance {
  std::string muscle;
  AttachmentEnd end;
  Real middles = 0, nearest = 0;
};

struct EndArea {
  Points points;
  Eigen::VectorXd areas;

  Vec3 middle() const { return points * areas / areas.sum(); }
  Real distance_to(const EndArea& other) const {
    Real sum = 0;
    for (Index i = 0; i < points.cols(); ++i)
      sum += areas[i] * (other.points.colwise() - points.col(i)).colwise().norm().minCoeff();
    return sum / areas.sum();
  }
};

EndArea end_area(const Scene& scene, const Muscle& muscle, AttachmentEnd end) {
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  std::vector<Index> vertices;
  for (const Attachment& attachment : muscle.attachments)
    if (attachment.end == end && !muscle_body(scene, attachment.body))
      vertices.insert(vertices.end(), attachment.vertices.begin(), attachment.vertices.end());
  return {muscle.surface.vertices(Eigen::all, vertices), areas(vertices)};
}

std::vector<EndDistance> compared(const Scene& made, const Scene& own) {
  std::vector<EndDistance> ends;
  for (const Muscle& muscle : made.muscles)
    for (const Muscle& other : own.muscles)
      for (const AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion}) {
        if (muscle.name != other.name) continue;
        const EndArea a = end_area(made, muscle, end), b = end_area(own, other, end);
        if (a.points.cols() == 0 || b.points.cols() == 0) continue;
        ends.push_back({muscle.name, end, (a.middle() - b.middle()).norm(), (a.distance_to(b) + b.distance_to(a)) / 2});
      }
  return ends;
}

void expect_good_fit(const std::string& from, const std::string& to, const fs::path& bones) {
  SceneOptions options;
  options.data = data_folder();
  const TemplateScene origin = read_template(from, options);
  const Scene own = read_scene(to, options).scene;
  TransferOptions transfer_options;
#ifdef GRACILIS_WITH_PREPARE
  transfer_options.separate = [](auto& muscles, const auto& all) { return separate(muscles, all, {}).shortfall; };
#endif
  const Transferred made = transfer(origin.loaded.scene, find_surfaces(bones), transfer_options);
  for (const FittedBone& bone : made.skeleton.bones) {
    EXPECT_LT(bone.registered.fit.to_subject, 0.002);
    EXPECT_LT(bone.registered.fit.to_template, 0.002);
  }
  Real middles = 0, nearest = 0;
  const std::vector<EndDistance> ends = compared(made.scene, own);
  for (const EndDistance& each : ends) {
    middles += each.middles / static_cast<Real>(ends.size());
    nearest += each.nearest / static_cast<Real>(ends.size());
    if (std::getenv("GRACILIS_TELL"))
      fmt::print("{:22} {:9} middles {:5.1f} mm, nearest {:5.1f} mm apart\n", each.muscle,
                 each.end == AttachmentEnd::origin ? "origin" : "insertion", 1000 * each.middles, 1000 * each.nearest);
  }
  if (std::getenv("GRACILIS_TELL"))
    fmt::print("mean of {}: middles {:.1f}, nearest {:.1f} mm\n", ends.size(), 1000 * middles, 1000 * nearest);
  ASSERT_EQ(ends.size(), 10u);
  // The two disagree on where insertions and psoas' origin are (docs/known-shortfalls.md); on these they agree.
  for (const EndDistance& each : ends) {
    const bool agree =
        each.end == AttachmentEnd::origin && (each.muscle == "gluteus_medius_r" || each.muscle == "iliacus_r");
    if (agree) {
      EXPECT_LT(each.middles, 0.010) << each.muscle;
    }
  }
  ASSERT_EQ(made.scene.joints[0].name, own.joints[0].name);
  EXPECT_LT((made.scene.joints[0].frame.translation() - own.joints[0].frame.translation()).norm(), 0.003);
  const TestFolder folder;
  write_transfer_folder(origin, made, {"0", {}, {}}, folder.path() / "made");
  const LoadedScene loaded = read_scene(folder.path() / "made" / "scene.toml");
  EXPECT_EQ(loaded.scene.muscles.size(), made.scene.muscles.size());
}

TEST(TransferOfData, the_cadavers_hip_on_the_legs_bones) {
  SKIP_WITHOUT_DATA();
  const fs::path leg = data_folder() / "leg";
  expect_good_fit(scene_file("flexion").string(), (leg / "leg.toml").string(), leg / "bones");
}

TEST(TransferOfData, the_leg_on_the_cadavers_bones) {
  SKIP_WITHOUT_DATA();
  expect_good_fit((data_folder() / "leg" / "leg.toml").string(), scene_file("flexion").string(),
                  data_folder() / "lhdl-hip" / "clean");
}

}  // namespace
}  // namespace gracilis
