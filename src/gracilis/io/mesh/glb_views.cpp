#include <gracilis/io/mesh/glb_views.hpp>

#include <gracilis/io/json_file.hpp>

#include <cstdint>
#include <cstring>

namespace gracilis {

using Json = nlohmann::ordered_json;

/// File: "glTF", version, length; then chunks of length, kind and data, JSON first.
static constexpr std::size_t header = 12, chunk_header = 8;

static std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

static void put_number(std::string& bytes, std::size_t at, std::size_t number) {
  const auto value = static_cast<std::uint32_t>(number);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// The list under a key; an empty one where there is none.
static Json list_of(const Json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return json.is_object() && found != json.end() && found->is_array() ? *found : Json::array();
}

static void give_view(Json& json, const Json& accessor, const Json& view) {
  if (!accessor.is_number_unsigned() || !json["accessors"].is_array()) return;
  const auto number = accessor.get<std::size_t>();
  if (number >= json["accessors"].size()) return;
  Json& found = json["accessors"][number];
  if (found.is_object() && !found.contains("bufferView")) found["bufferView"] = view;
}

std::string with_views(const std::filesystem::path& path, std::string bytes) {
  if (bytes.size() < header + chunk_header || !bytes.starts_with("glTF")) return bytes;
  const std::size_t length = number_at(bytes, header), begin = header + chunk_header;
  if (bytes.compare(header + 4, 4, "JSON") != 0 || length > bytes.size() - begin) return bytes;
  Json json = parse_json(path, bytes.substr(begin, length));
  bool any = false;
  for (const Json& mesh : list_of(json, "meshes"))
    for (const Json& primitive : list_of(mesh, "primitives")) {
      const Json::json_pointer compressed(std::string("/extensions/") + draco_extension + "/bufferView");
      if (!primitive.is_object() || !primitive.contains(compressed)) continue;
      any = true;
      give_view(json, primitive.value("indices", Json()), primitive[compressed]);
      const Json attributes = primitive.value("attributes", Json::object());
      for (const auto& [_, accessor] : attributes.items()) give_view(json, accessor, primitive[compressed]);
    }
  if (!any) return bytes;
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string result = bytes.substr(0, begin) + text + bytes.substr(begin + length);
  put_number(result, 8, result.size());
  put_number(result, header, text.size());
  return result;
}

}  // namespace gracilis
