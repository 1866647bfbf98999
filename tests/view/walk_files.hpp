#pragma once

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include "opensim/model_texts.hpp"
#include "shapes.hpp"

#include <build_paths.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace gracilis {

/// The first block of TOML of the page on own data: a scene of three of the demo's surfaces.
inline std::string scene_of_guide() {
  const std::string text = read_text(std::filesystem::path(build_paths::source_folder) / "docs/guide/your-own-data.md");
  const std::size_t begin = text.find("```toml\n") + 8;
  return text.substr(begin, text.find("```", begin) - begin);
}

/// A leg of three of the demo's surfaces, named after what they are, and a shank below the femur, with landmarks at the
/// hip's center and at both ends of the knee's axis.
inline void write_leg(const std::filesystem::path& folder, const std::filesystem::path& frames) {
  std::filesystem::create_directories(folder);
  for (const std::string name : {"hip_bone_r", "femur_r", "adductor_longus_r"})
    std::filesystem::copy_file(frames / (name + "_0000.vtp"), folder / (name + ".vtp"));
  const Points femur = load_surface(folder / "femur_r.vtp", 1, SurfaceRole::bone).mesh.vertices;
  Index lowest = 0;
  femur.row(1).minCoeff(&lowest);
  const Vec3 knee = femur.col(lowest) + Vec3(0, 0.02, 0);
  TriangleMesh shank = shapes::cylinder(0.015, 0.35, 12, 40);
  const Eigen::Matrix3d down = Eigen::AngleAxis<Real>(pi / 2, Vec3::UnitX()).toRotationMatrix();
  shank.vertices = down * shank.vertices;
  const Vec3 top(knee.x(), femur(1, lowest) - 0.005 - shank.vertices.row(1).maxCoeff(), knee.z());
  shank.vertices.colwise() += top;
  write_surface(folder / "tibia_r.vtp", shank.vertices, shank.faces);
  std::ofstream landmarks(folder / "my_leg_points.csv");
  landmarks << "cloud,index,x_mm,y_mm,z_mm\nhip,HJC,0,0,0\n";
  for (const auto& [name, side] : {std::pair("R_Med_Epi", -0.03), std::pair("R_Lat_Epi", 0.03)})
    landmarks << "knee," << name << "," << 1000 * knee.x() << "," << 1000 * knee.y() << "," << 1000 * (knee.z() + side)
              << "\n";
}

/// What commands of the manual are given, small, in a folder in which out/demo is a run of the built-in hip: the scene
/// out/my_hip.toml, a folder of surfaces, tables, a model, a study and what calibration aims at.
inline void write_walk_files(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("out/my_hip.toml", scene_of_guide());
  write("published.csv",
        "muscle,source,angle_deg,moment_arm_mm\nadductor_longus_r,a book,0,40\nadductor_longus_r,a book,60,10\n");
  write("tiny.osim", opensim::pendulum(opensim::muscle(
                         "m", opensim::point("/ground", "0.3 0 0") + opensim::point("/bodyset/rod", "0 -0.4 0"))));
  std::string swing = "x\nversion=1\nnRows=13\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n";
  std::string activation = "x\nversion=1\nnRows=13\nnColumns=2\nendheader\ntime\tm\n";
  for (int i = 0; i < 13; ++i) {
    swing += std::to_string(0.1 * i) + "\t" + std::to_string(3 * i) + "\n";
    activation += std::to_string(0.1 * i) + "\t" + std::to_string(0.05 * i) + "\n";
  }
  for (const char* part : {"motions", "results"}) fs::create_directories(folder / part);
  for (const char* file : {"walk.mot", "motions/walk.mot"}) write(file, swing);
  write("results/walk.sto", activation);
  write("setup.xml",
        "<OpenSimDocument Version=\"40000\"><AnalyzeTool name=\"t\"><model_file>tiny.osim</model_file>"
        "<coordinates_file>walk.mot</coordinates_file><AnalysisSet><objects><StaticOptimization name=\"s\"/></objects>"
        "</AnalysisSet></AnalyzeTool></OpenSimDocument>");
  write("study.toml",
        "scene = \"out/my_hip.toml\"\nset = [\"method=skinning\"]\n"
        "[[parameters]]\nkey = \"tendon_length\"\nvalues = [0.005, 0.01]\n");
  write("targets.toml",
        "[[targets]]\nkind = \"volumes\"\nvolumes_cm3 = { adductor_longus_r = 150 }\n"
        "[[parameters]]\nkey = \"tendon_length\"\nbounds = [0.005, 0.05]\n[search]\nevaluations = 1\n");
  write_leg(folder / "my_leg", folder / "out/demo/frames");
  fs::create_directories(folder / "scans");
  for (const std::string name : {"hip_bone_r", "femur_r", "adductor_longus_r"})
    fs::copy_file(folder / "my_leg" / (name + ".vtp"), folder / "scans" / (name + ".vtp"));
}

}  // namespace gracilis
