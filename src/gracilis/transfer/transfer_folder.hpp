#pragma once

#include <gracilis/transfer/template_scene.hpp>
#include <gracilis/transfer/transfer.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// How far each vertex of the subject's bone lies from the template's as it was laid on it, m.
Eigen::VectorXd fit_distances(const Transferred& transferred, const FittedBone& bone);

/// The template's bone as it was laid on the subject's.
TriangleMesh laid_bone(const Transferred& transferred, const FittedBone& bone);

/// What is written into the manifest beside what was found.
struct TransferRecord {
  std::string version;
  std::vector<std::string> command;
  std::vector<std::filesystem::path> inputs;  ///< read beside the template's and the subject's surfaces
};

/// Writes a folder that `gracilis run` takes: scene.toml with bones/, muscles/, fibers/ and tables/; fit/, the
/// template's bones as they were laid on the subject's; fit.csv, every error and distance, a row each; transfer.json,
/// the manifest with the hash of every input. Returns what was left out. Throws InputError.
std::vector<std::string> write_transfer_folder(const TemplateScene& origin, const Transferred& transferred,
                                               const TransferRecord& record, const std::filesystem::path& folder);

}  // namespace gracilis
