#include <gracilis/io/scene/prepared_cache.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <cstring>

namespace gracilis {

namespace fs = std::filesystem;

// Stands first in every file and in what is hashed.
static constexpr std::string_view muscles_format = "gracilis muscles 2";

static std::string bytes_of(const TriangleMesh& mesh) {
  const Index counts[2] = {mesh.vertex_count(), mesh.face_count()};
  return bytes_of(counts, sizeof counts) +
         bytes_of(mesh.vertices.data(), sizeof(Real) * static_cast<std::size_t>(mesh.vertices.size())) +
         bytes_of(mesh.faces.data(), sizeof(Index) * static_cast<std::size_t>(mesh.faces.size()));
}

static fs::path file_of(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                        const PrepareSettings& settings, const fs::path& folder) {
  std::string bytes = std::string(muscles_format) + std::to_string(preparation_version) + "\n";
  for (const auto& [key, value] : list_settings(settings)) bytes += key + "=" + to_text(value) + "\n";
  for (const NamedSurface& muscle : muscles) {
    bytes += (muscle.largest_piece ? "largest of muscle " : "muscle ") + bytes_of(muscle.mesh);
    if (!muscle.apart_from) continue;
    bytes += "apart from";
    for (const std::string& name : *muscle.apart_from)
      for (std::size_t m = 0; m < muscles.size(); ++m)
        if (muscles[m].name == name) bytes += " " + std::to_string(m);
  }
  for (const NamedSurface& bone : bones) bytes += "bone " + bytes_of(bone.mesh);
  return folder / (content_hash_of(bytes) + ".muscles");
}

/// Takes the bytes of a mesh from the front of `content`.
static bool take_mesh(std::string_view& content, TriangleMesh& mesh) {
  const auto take = [&](void* data, std::size_t size) {
    if (content.size() < size) return false;
    if (size > 0) std::memcpy(data, content.data(), size);
    content.remove_prefix(size);
    return true;
  };
  Index counts[2];
  if (!take(counts, sizeof counts)) return false;
  for (const Index count : counts)
    if (count < 0 || static_cast<std::size_t>(count) > content.size() / (3 * sizeof(Index))) return false;
  mesh.vertices.resize(3, counts[0]);
  mesh.faces.resize(3, counts[1]);
  return take(mesh.vertices.data(), sizeof(Real) * static_cast<std::size_t>(mesh.vertices.size())) &&
         take(mesh.faces.data(), sizeof(Index) * static_cast<std::size_t>(mesh.faces.size())) &&
         mesh.vertices.allFinite() &&
         (counts[1] == 0 || (mesh.faces.minCoeff() >= 0 && mesh.faces.maxCoeff() < counts[0]));
}

std::optional<std::vector<TriangleMesh>> parse_prepared(std::string_view content, std::size_t count) {
  std::vector<TriangleMesh> meshes(count);
  for (TriangleMesh& mesh : meshes)
    if (!take_mesh(content, mesh)) return std::nullopt;
  if (!content.empty()) return std::nullopt;
  return meshes;
}

static std::optional<std::vector<TriangleMesh>> read_meshes(const fs::path& file, std::size_t count,
                                                            const WarnFunction& warn) {
  const std::optional<std::string> content = read_cache_file(file, muscles_format, warn);
  if (!content) return std::nullopt;
  std::optional<std::vector<TriangleMesh>> meshes = parse_prepared(*content, count);
  if (!meshes) warn_of_cache_file(file, "does not hold the muscles", warn);
  return meshes;
}

std::vector<TriangleMesh> cached_preparation(const std::vector<NamedSurface>& muscles,
                                             const std::vector<NamedSurface>& bones, const PrepareSettings& settings,
                                             const PrepareFunction& prepare,
                                             const std::function<void(const std::string&)>& say, const fs::path& folder,
                                             const WarnFunction& warn) {
  const fs::path file = folder.empty() ? fs::path() : file_of(muscles, bones, settings, folder);
  if (!folder.empty()) {
    if (std::optional<std::vector<TriangleMesh>> kept = read_meshes(file, muscles.size(), warn)) {
      say("prepared muscles: " + file.string());
      return *std::move(kept);
    }
  }
  if (!prepare) {
    throw ConfigurationError(
        {"", "[prepare]", "the scene's muscles must be prepared, which this program cannot do",
         "it was built without CGAL: install libcgal-dev and build with GRACILIS_WITH_PREPARE=ON"});
  }
  say("preparing " + std::to_string(muscles.size()) + " muscles; this is done once");
  PreparedSurfaces prepared = prepare(muscles, bones, settings, say);
  say(to_text(prepared.report));
  // What failed is tried again, and never taken for what was asked for.
  if (folder.empty() || !prepared.report.pulled_apart) return prepared.muscles;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return prepared.muscles;
  try {
    std::string bytes;
    for (const TriangleMesh& mesh : prepared.muscles) bytes += bytes_of(mesh);
    write_text_atomically(fs::path(file).replace_extension(".json"), json_text(to_json(prepared.report)));
    write_cache_file(file, muscles_format, bytes);
    say("kept in " + file.string());
  } catch (const Error&) {
    // No room or no right to write: the surfaces are as good without the file.
  }
  return prepared.muscles;
}

}  // namespace gracilis
