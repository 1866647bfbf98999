#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// Writes a .glb whose nodes are called this, with a mesh each; returns its path.
inline std::string write_parts(const std::filesystem::path& file,
                               const std::vector<std::pair<std::string, TriangleMesh>>& parts) {
  std::string data, views, accessors, meshes, nodes, roots;
  const auto view = [&](const auto& numbers, int component, const char* type, std::size_t count) {
    const std::size_t size = numbers.size() * sizeof numbers[0], begin = data.size();
    data.append(reinterpret_cast<const char*>(numbers.data()), size);
    const std::string comma = views.empty() ? "" : ",";
    const auto number = std::to_string(std::count(views.begin(), views.end(), '{'));
    views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
             std::to_string(size) + "}";
    accessors += comma + R"({"bufferView":)" + number + R"(,"componentType":)" + std::to_string(component) +
                 R"(,"type":")" + type + R"(","count":)" + std::to_string(count) +
                 (component == 5126 ? R"(,"min":[-9,-9,-9],"max":[9,9,9]})" : "}");
    return number;
  };
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const TriangleMesh& mesh = parts[p].second;
    std::vector<float> places;
    for (const auto v : mesh.vertices.colwise())
      for (int i = 0; i < 3; ++i) places.push_back(static_cast<float>(v[i]));
    std::vector<std::uint32_t> corners;
    for (const auto f : mesh.faces.colwise())
      for (int i = 0; i < 3; ++i) corners.push_back(static_cast<std::uint32_t>(f[i]));
    const std::string positions = view(places, 5126, "VEC3", places.size() / 3),
                      indices = view(corners, 5125, "SCALAR", corners.size()), comma = p == 0 ? "" : ",";
    meshes += comma + R"({"primitives":[{"attributes":{"POSITION":)" + positions + R"(},"indices":)" + indices + "}]}";
    nodes += comma + R"({"name":")" + parts[p].first + R"(","mesh":)" + std::to_string(p) + "}";
    roots += comma + std::to_string(p);
  }
  std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" +
                     nodes + R"(],"meshes":[)" + meshes + R"(],"accessors":[)" + accessors + R"(],"bufferViews":[)" +
                     views + R"(],"buffers":[{"byteLength":)" + std::to_string(data.size()) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&word), 4);
  };
  put(0x46546C67), put(2), put(28 + json.size() + data.size());
  put(json.size()), put(0x4E4F534A);
  out << json;
  put(data.size()), put(0x004E4942);
  out << data;
  return file.string();
}

}  // namespace gracilis
