#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/outline_curves.hpp>
#include <gracilis/geometry/surface_region.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene/landmarks.hpp>

#include "scenario_runs.hpp"

#include <algorithm>
#include <random>

/// Outlines of attachments that were measured in order, given in another.
namespace gracilis {

namespace {

struct MeasuredOutline {
  std::string cloud, bone;
};

const std::vector<MeasuredOutline> outlines = {{"LC_SET_Ori_1_R_M081_Glut_Max", "hip_bone_r"},
                                               {"LC_SET_Ori_1_R_M082_Glut_Med", "hip_bone_r"},
                                               {"LC_SET_Ins_1_R_M082_Glut_Med", "femur_r"},
                                               {"LC_SET_Ori_1_R_M091_Iliacus", "hip_bone_r"}};

Points shuffled(Points points) {
  std::mt19937 generator(7);
  for (Index i = static_cast<Index>(points.cols()) - 1; i > 0; --i)
    points.col(i).swap(points.col(static_cast<Index>(generator() % static_cast<unsigned>(i + 1))));
  return points;
}

/// Areas over that of the ordered outline's inside: found, and found beside it.
struct Shares {
  Real found = 0, beside = 0;
};

Shares shares_of(OutlineCurve curve, const TriangleMesh& bone, const Points& in_order) {
  const std::vector<char> wanted = faces_inside(bone, in_order);
  std::vector<char> found = faces_inside(bone, ordered_outline(curve, shuffled(in_order))), beside = found;
  for (std::size_t f = 0; f < wanted.size(); ++f) beside[f] &= !wanted[f], found[f] &= wanted[f];
  const Real area = marked_area(bone, wanted);
  return {marked_area(bone, found) / area, marked_area(bone, beside) / area};
}

}  // namespace

TEST(Outlines, the_shortest_tour_finds_the_areas_of_the_cadavers_attachments) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion");
  const auto clouds = read_landmarks(data_folder() / "lhdl-hip" / "attachment_landmarks.csv", 0.001);
  for (const MeasuredOutline& outline : outlines) {
    const auto cloud =
        std::find_if(clouds.begin(), clouds.end(), [&](const auto& c) { return c.name == outline.cloud; });
    const auto bone =
        std::find_if(scene.bones.begin(), scene.bones.end(), [&](const auto& b) { return b.name == outline.bone; });
    ASSERT_TRUE(cloud != clouds.end() && bone != scene.bones.end());
    for (int curve = 0; curve < 8; ++curve) {
      const Shares shares = shares_of(static_cast<OutlineCurve>(curve), bone->surface, cloud->points);
      const std::string name(choices_of(OutlineCurve{})[static_cast<std::size_t>(curve)]);
      RecordProperty(outline.cloud + " " + name, std::to_string(shares.found) + " + " + std::to_string(shares.beside));
      EXPECT_GT(shares.found, 0.7) << outline.cloud << " by " << name;
      if (static_cast<OutlineCurve>(curve) != OutlineCurve::shortest_tour) continue;
      EXPECT_GT(shares.found, 0.99) << outline.cloud;
      EXPECT_LT(shares.beside, 0.01) << outline.cloud;
    }
  }
}

TEST(Outlines, scenes_can_give_them_in_any_order) {
  SKIP_WITHOUT_DATA();
  const auto attachment = [](const std::string& line) {
    Scene scene;
    SceneOptions options;
    options.data = data_folder();
    options.only = {"gluteus_medius_r"};
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("gracilis_outline_" + line);
    std::filesystem::create_directories(folder);
    std::string text = read_text(scene_file("hip"));
    const std::string cloud = "cloud = \"LC_SET_Ori_1_R_M082_Glut_Med\"\nline = \"closed\"";
    const std::size_t at = text.find(cloud);
    if (at == std::string::npos) throw std::runtime_error("the scene has changed");
    text.replace(at, cloud.size(), "cloud = \"LC_SET_Ori_1_R_M082_Glut_Med\"\nline = \"" + line + "\"");
    text += "\n[motion]\ncoordinates = [\"hip_flexion_r\"]\nkey_poses_deg = [[0], [5]]\n";
    write_text_atomically(folder / "scene.toml", text);
    scene = read_scene(folder / "scene.toml", options).scene;
    std::filesystem::remove_all(folder);
    return scene.muscles.at(0).attachments.at(0).vertices;
  };
  const std::vector<Index> by_plane = attachment("closed"), on_bone = attachment("outline");
  std::vector<Index> both;
  std::set_intersection(by_plane.begin(), by_plane.end(), on_bone.begin(), on_bone.end(), std::back_inserter(both));
  EXPECT_GT(both.size(), 0.9 * static_cast<Real>(by_plane.size()));
  EXPECT_GT(both.size(), 0.9 * static_cast<Real>(on_bone.size()));
}

}  // namespace gracilis
