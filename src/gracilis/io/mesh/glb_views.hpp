#pragma once

#include <filesystem>
#include <string>

namespace gracilis {

/// The name under which a primitive says how Draco compressed it.
inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";

/// The bytes of a .glb file with a view for each accessor of what Draco compressed: such have none, as they should,
/// which TinyGLTF does not take where it was built without Draco. Bytes that are no .glb come back as they are. Throws
/// InputError where its JSON is none.
std::string with_views(const std::filesystem::path& path, std::string bytes);

}  // namespace gracilis
