#include <gracilis/io/scene/field_cache.hpp>

#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace gracilis {

namespace fs = std::filesystem;

// Stands first in every file and in what is hashed: change it when fields are built or stored in another way.
static constexpr std::string_view field_format = "gracilis field 6";

static fs::path file_of(const Bone& bone, const DistanceFieldSettings& settings, const fs::path& folder) {
  const TriangleMesh& surface = bone.surface;
  std::string bytes = std::string(field_format);
  bytes += bytes_of(surface.vertices.data(), sizeof(Real) * static_cast<std::size_t>(surface.vertices.size()));
  bytes += bytes_of(surface.faces.data(), sizeof(int) * static_cast<std::size_t>(surface.faces.size()));
  for (const auto& [key, value] : list_settings(settings)) bytes += key + "=" + to_text(value) + "\n";
  return folder / (content_hash_of(bytes) + ".field");
}

fs::path default_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return fs::path(cache) / "gracilis";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "gracilis";
  return {};
}

/// The numbers of a field before its values.
struct FieldHeader {
  Real origin[3], cell_size[3];
  Index nodes[3];
  Index unused = 0;
};
static_assert(sizeof(FieldHeader) == 6 * sizeof(Real) + 4 * sizeof(Index), "no byte of it is left to chance");

static std::string content_of(const DistanceField& field) {
  FieldHeader header{};
  for (int axis = 0; axis < 3; ++axis) {
    header.origin[axis] = field.origin[axis];
    header.cell_size[axis] = field.cell_size[axis];
    header.nodes[axis] = field.nodes[static_cast<std::size_t>(axis)];
  }
  return bytes_of(&header, sizeof header) + bytes_of(field.values.data(), sizeof(float) * field.values.size());
}

/// What is kept is believed only within bounds: a checksum tells that it is what was written, not that this was sound.
std::optional<DistanceField> parse_field(std::string_view content) {
  FieldHeader header{};
  DistanceField field;
  if (content.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, content.data(), sizeof header);
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (header.nodes[axis] < 2 || header.nodes[axis] > 100000) return std::nullopt;
    if (!std::isfinite(header.origin[axis]) || !(header.cell_size[axis] > 0) || !std::isfinite(header.cell_size[axis]))
      return std::nullopt;
    field.nodes[static_cast<std::size_t>(axis)] = header.nodes[axis];
    count *= static_cast<std::size_t>(header.nodes[axis]);
  }
  if (content.size() - sizeof header != sizeof(float) * count) return std::nullopt;
  field.origin = Vec3(header.origin);
  field.cell_size = Vec3(header.cell_size);
  field.values.resize(count);
  std::memcpy(field.values.data(), content.data() + sizeof header, sizeof(float) * count);
  if (!std::all_of(field.values.begin(), field.values.end(), [](float value) { return std::isfinite(value); }))
    return std::nullopt;
  return field;
}

static std::optional<DistanceField> read_field(const fs::path& file, const WarnFunction& warn) {
  const std::optional<std::string> content = read_cache_file(file, field_format, warn);
  if (!content) return std::nullopt;
  std::optional<DistanceField> field = parse_field(*content);
  if (!field) warn_of_cache_file(file, "holds no distance field", warn);
  return field;
}

DistanceField cached_bone_field(const Bone& bone, const DistanceFieldSettings& settings, const fs::path& folder,
                                const WarnFunction& warn) {
  if (folder.empty()) return build_bone_field(bone, settings);
  const fs::path file = file_of(bone, settings, folder);
  if (std::optional<DistanceField> kept = read_field(file, warn)) return *std::move(kept);
  DistanceField field = build_bone_field(bone, settings);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return field;
  try {
    write_cache_file(file, field_format, content_of(field));
  } catch (const Error&) {
    // No room or no right to write: the field is as good without the file.
  }
  return field;
}

std::vector<DistanceField> cached_bone_fields(const Scene& scene) {
  return cached_bone_fields(scene, scene.distance_fields);
}

std::vector<DistanceField> cached_bone_fields(const Scene& scene, const DistanceFieldSettings& settings,
                                              const WarnFunction& warn) {
  const fs::path folder = default_cache_folder();
  std::vector<DistanceField> fields(scene.bones.size());
  std::vector<std::string> warnings(scene.bones.size());
  parallel_for_each(fields.size(), [&](std::size_t b) {
    fields[b] =
        cached_bone_field(scene.bones[b], settings, folder, [&](const std::string& warning) { warnings[b] = warning; });
  });
  for (const std::string& warning : warnings)
    if (warn && !warning.empty()) warn(warning);
  return fields;
}

}  // namespace gracilis
