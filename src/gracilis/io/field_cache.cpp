#include <gracilis/anatomy/bone_field.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/field_cache.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace gracilis {

namespace fs = std::filesystem;

// Stands first in every file and in what is hashed: change it when fields are built or stored in another way.
static constexpr char format_name[16] = "gracilis field4";

static std::string bytes_of(const void* data, std::size_t size) { return {static_cast<const char*>(data), size}; }

static fs::path file_of(const Bone& bone, const DistanceFieldSettings& settings, const fs::path& folder) {
  const TriangleMesh& surface = bone.surface;
  std::string bytes = bytes_of(format_name, sizeof format_name);
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
  char format[16];
  Real origin[3], cell_size[3];
  Index nodes[3];
};

static bool read_field(const fs::path& file, DistanceField& field) {
  std::ifstream stream(file, std::ios::binary);
  FieldHeader header{};
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof header)) return false;
  if (std::string_view(header.format, sizeof header.format) != std::string_view(format_name, sizeof format_name))
    return false;
  std::uintmax_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (header.nodes[axis] < 2 || header.nodes[axis] > 100000) return false;
    field.nodes[static_cast<std::size_t>(axis)] = header.nodes[axis];
    count *= static_cast<std::uintmax_t>(header.nodes[axis]);
  }
  std::error_code ignored;
  if (fs::file_size(file, ignored) != sizeof header + sizeof(float) * count) return false;
  field.origin = Vec3(header.origin);
  field.cell_size = Vec3(header.cell_size);
  field.values.resize(count);
  return static_cast<bool>(
      stream.read(reinterpret_cast<char*>(field.values.data()), static_cast<std::streamsize>(sizeof(float) * count)));
}

static void write_field(const fs::path& file, const DistanceField& field) {
  FieldHeader header{};
  std::copy(std::begin(format_name), std::end(format_name), header.format);
  for (int axis = 0; axis < 3; ++axis) {
    header.origin[axis] = field.origin[axis];
    header.cell_size[axis] = field.cell_size[axis];
    header.nodes[axis] = field.nodes[static_cast<std::size_t>(axis)];
  }
  write_file_atomically(file, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(&header), sizeof header);
    stream.write(reinterpret_cast<const char*>(field.values.data()),
                 static_cast<std::streamsize>(sizeof(float) * field.values.size()));
    stream.close();
    if (!stream) throw InputError({temporary.string(), "", "cannot be written", "check the free space of the disk"});
  });
}

DistanceField cached_bone_field(const Bone& bone, const DistanceFieldSettings& settings, const fs::path& folder) {
  if (folder.empty()) return build_bone_field(bone, settings);
  const fs::path file = file_of(bone, settings, folder);
  DistanceField field;
  if (read_field(file, field)) return field;
  field = build_bone_field(bone, settings);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return field;
  try {
    write_field(file, field);
  } catch (const Error&) {
    // No room or no right to write: the field is as good without the file.
  }
  return field;
}

std::vector<DistanceField> cached_bone_fields(const Scene& scene) {
  return cached_bone_fields(scene, scene.distance_fields);
}

std::vector<DistanceField> cached_bone_fields(const Scene& scene, const DistanceFieldSettings& settings) {
  const fs::path folder = default_cache_folder();
  std::vector<DistanceField> fields(scene.bones.size());
  parallel_for_each(fields.size(),
                    [&](std::size_t b) { fields[b] = cached_bone_field(scene.bones[b], settings, folder); });
  return fields;
}

}  // namespace gracilis
