#pragma once

#include "body_folder.hpp"
#include "drafted_scene.hpp"

#include "../shapes.hpp"

#include <gracilis/anatomy/attachments/attachment_patch.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/// Folders of the built-in bodies, under the names that people give to files.
namespace gracilis {

namespace fs = std::filesystem;

inline const Scene& hip() {
  static const Scene scene = demo_scene("hip");
  return scene;
}

inline const Scene& elbow() {
  static const Scene scene = demo_scene("elbow");
  return scene;
}

inline const std::map<std::string, std::string> hip_names = {
    {"hip_bone_r", "bones/Os coxae dextrum.vtp"},
    {"sacrum", "bones/Sacrum.vtp"},
    {"femur_r", "bones/RightFemur.vtp"},
    {"gluteus_maximus_r", "muscles/Musculus gluteus maximus.R.vtp"},
    {"gluteus_medius_r", "muscles/GlutMed_right.vtp"},
    {"iliacus_r", "muscles/iliacus muscle (right).vtp"},
    {"adductor_longus_r", "muscles/addlong_r.vtp"}};

inline const std::map<std::string, std::string> forearm_names = {{"humerus_r", "humerus_r.vtp"},
                                                                 {"ulna_r", "ulna_r.vtp"},
                                                                 {"radius_r", "radius_r.vtp"},
                                                                 {"brachialis_r", "brachialis_r.vtp"}};

inline const Joint& joint_named(const Scene& scene, const std::string& name) {
  for (const Joint& joint : scene.joints)
    if (joint.name == name) return joint;
  throw std::runtime_error("no joint " + name);
}

/// The part of a muscle's surface that is attached.
inline void write_patch(const fs::path& file, const Scene& scene, const std::string& name) {
  for (const Muscle& muscle : scene.muscles) {
    if (muscle.name != name) continue;
    std::vector<char> held(static_cast<std::size_t>(muscle.surface.vertex_count()), 0), keep;
    for (const Attachment& each : muscle.attachments)
      for (const Index v : each.vertices) held[static_cast<std::size_t>(v)] = 1;
    for (const auto& corners : muscle.surface.faces.colwise())
      keep.push_back(
          std::all_of(corners.begin(), corners.end(), [&](Index v) { return held[static_cast<std::size_t>(v)]; }));
    fs::create_directories(file.parent_path());
    const TriangleMesh patch = kept_faces(muscle.surface, keep);
    write_surface(file, patch.vertices, patch.faces);
  }
}

/// How many ends of a drafted muscle a patch gave.
inline std::size_t ends_by_patch(const SceneDraft& draft, const std::string& name) {
  std::size_t count = 0;
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments)
      count += muscle.found->name == name && !each.given_by.empty();
  return count;
}

inline Vec3 direction(const Joint& joint, std::size_t axis) { return joint.frame.linear() * joint.axes[axis].axis; }

}  // namespace gracilis
