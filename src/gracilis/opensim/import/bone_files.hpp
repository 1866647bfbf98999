#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <map>
#include <set>

namespace gracilis::opensim {

/// Which files stand for a surface that a model names, and their unit in m; 0: as the model says by its scale factors.
struct GeometryFiles {
  std::vector<std::filesystem::path> files;
  Real unit = 0;
  std::string like = {};  ///< lies as this surface of the model does; empty: in the ground frame (surfaces of muscles)
};

/// Where a model's surfaces are looked for.
struct GeometryPlaces {
  std::filesystem::path model_folder;
  std::vector<std::filesystem::path> folders;
  std::map<std::string, GeometryFiles> named;  ///< by the name in the model; these win
};

/// A TOML file: "LHDL_pelvis.vtp" = "pelvis.ply" or ["hip_bone_r.vtk", "sacrum.vtk"], or { files = [...], unit = "mm",
/// like = "LHDL_pelvis.vtp" }; files lie beside it or below. Throws InputError.
std::map<std::string, GeometryFiles> read_geometry_map(const std::filesystem::path& path);

struct ModelBone {
  std::string name;
  Index body = 0;
  TriangleMesh surface;  ///< m, in the ground frame
};

struct ModelBones {
  std::vector<ModelBone> bones;
  std::vector<std::string> missing;  ///< a sentence each
};

/// All surfaces of a model's bodies but the ground's, for the bodies at `poses`. A surface is looked for by its path
/// below the geometry folders, the model's folder and its folder Geometry, then by its name alone; never outside of
/// them. Those that are missing or cannot be read are listed.
ModelBones load_bones(const Model& model, const std::vector<RigidTransform>& poses, const GeometryPlaces& places);

/// Surfaces of muscles by their names, in the ground frame, m, for the bodies at `poses`: one file each; without a unit
/// in m. Throws InputError for names that are no muscle's or no surface's.
std::map<std::string, TriangleMesh> load_muscle_surfaces(const Model& model, const std::vector<RigidTransform>& poses,
                                                         const std::map<std::string, GeometryFiles>& files);

}  // namespace gracilis::opensim
