#include <gracilis/io/mesh/mesh_reader_glb.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/draco_mesh.hpp>
#include <gracilis/io/mesh/glb_views.hpp>
#include <gracilis/io/mesh/vtp_arrays.hpp>
#include <gracilis/io/suggestions.hpp>

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

namespace gracilis {

namespace {

constexpr int deepest_node = 256;

/// Draco takes an eighth of a byte and more for each. What a file takes beyond that it places many times.
constexpr std::size_t corners_per_byte = 8;

/// Pictures say nothing about a surface.
bool no_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

[[noreturn]] void fail_at(const std::filesystem::path& path, const std::string& what, const std::string& remedy) {
  throw InputError({path.string(), "", what, remedy});
}

/// Everything is in the file: what a foreign file names elsewhere is not looked for. `size`: of the file, bytes.
tinygltf::Model load_model(const std::filesystem::path& path, std::size_t& size) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(no_image, nullptr);
  reader.SetFsCallbacks(
      {[](const std::string&, void*) { return false; }, [](const std::string& name, void*) { return name; },
       [](std::vector<unsigned char>*, std::string* error, const std::string& name, void*) {
         *error += "'" + name + "' lies outside of the file";
         return false;
       },
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, nullptr});
  const std::string bytes = with_views(path, read_text(path));
  size = bytes.size();
  std::string error, warning;
  tinygltf::Model model;
  if (bytes.size() > std::numeric_limits<unsigned>::max())
    fail_at(path, "is larger than a .glb file can be", "export the surface again");
  if (!reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<unsigned>(bytes.size())))
    fail_at(path, "is damaged or no .glb file: " + error.substr(0, error.find('\n')), "export the surface again");
  return model;
}

/// Collects the triangles of a part.
class GlbReader {
 public:
  GlbReader(const std::filesystem::path& path, const tinygltf::Model& model, std::size_t file_bytes, std::string part)
      : path_(path),
        part_(std::move(part)),
        model_(model),
        visited_(model.nodes.size(), false),
        budget_(corners_per_byte * file_bytes) {}

  PolygonMesh read() {
    for (const int root : roots()) add_node(root, Eigen::Affine3d::Identity(), part_.empty(), 0);
    if (!part_.empty() && !found_) fail("has no node or mesh '" + part_ + "'", suggestion(part_, names()));
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = "export the surface again") const {
    fail_at(path_, what, remedy);
  }

  template <class Element>
  const Element& element(const std::vector<Element>& list, int index, const char* kind) const {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
      fail(fmt::format("refers to {} {}, which does not exist", kind, index));
    return list[static_cast<std::size_t>(index)];
  }

  std::vector<std::string> names() const {
    std::vector<std::string> known;
    for (const tinygltf::Node& node : model_.nodes) known.push_back(node.name);
    for (const tinygltf::Mesh& each : model_.meshes) known.push_back(each.name);
    return known;
  }

  /// Nodes of the scene; without one, those that are below no other.
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int scene = model_.defaultScene >= 0 ? model_.defaultScene : 0;
      return element(model_.scenes, scene, "scene").nodes;
    }
    std::vector<bool> is_below(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children) {
        element(model_.nodes, child, "node");
        is_below[static_cast<std::size_t>(child)] = true;
      }
    std::vector<int> found;
    for (std::size_t n = 0; n < is_below.size(); ++n)
      if (!is_below[n]) found.push_back(static_cast<int>(n));
    return found;
  }

  static Eigen::Affine3d placement(const tinygltf::Node& node) {
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
      place.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      return place;
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    if (t.size() == 3) place.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    if (r.size() == 4) place.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    if (s.size() == 3) place.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    return place;
  }

  void add_node(int number, const Eigen::Affine3d& above, bool wanted, int depth) {
    if (depth > deepest_node) fail(fmt::format("has nodes more than {} deep", deepest_node));
    const tinygltf::Node& node = element(model_.nodes, number, "node");
    if (visited_[static_cast<std::size_t>(number)])
      fail(fmt::format("comes to node {} twice, but the nodes of glTF are trees", number));
    visited_[static_cast<std::size_t>(number)] = true;
    const Eigen::Affine3d place = above * placement(node);
    wanted = wanted || node.name == part_;
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = element(model_.meshes, node.mesh, "mesh");
      if (wanted || mesh.name == part_) {
        found_ = true;
        for (const tinygltf::Primitive& primitive : mesh.primitives) add_primitive(primitive, place);
      }
    }
    for (const int child : node.children) add_node(child, place, wanted, depth + 1);
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& place) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN)
      return;
    std::vector<double> positions;
    std::vector<std::int64_t> corners;
    if (const auto draco = primitive.extensions.find(draco_extension); draco != primitive.extensions.end()) {
      read_draco(draco->second, positions, corners);
    } else {
      const auto at = primitive.attributes.find("POSITION");
      if (at == primitive.attributes.end()) return;
      positions = numbers(at->second, 3);
      if (primitive.indices >= 0) {
        for (const double index : numbers(primitive.indices, 1)) corners.push_back(static_cast<std::int64_t>(index));
      } else {
        for (std::size_t i = 0; i < positions.size() / 3; ++i) corners.push_back(static_cast<std::int64_t>(i));
      }
    }
    spend(positions.size() / 3 + corners.size());
    add_triangles(vertices_at(positions, place), corners, mode, place.linear().determinant() < 0);
  }

  void spend(std::size_t corners) {
    if (corners > budget_.left) fail("places more corners than a file of its size can honestly hold");
    budget_.left -= corners;
  }

  void read_draco(const tinygltf::Value& extension, std::vector<double>& positions,
                  std::vector<std::int64_t>& corners) const {
    const tinygltf::BufferView& view =
        element(model_.bufferViews, extension.Get("bufferView").GetNumberAsInt(), "view");
    const int position = extension.Get("attributes").Get("POSITION").GetNumberAsInt();
    const auto [begin, size] = bytes_of(view);
    DracoMesh mesh = decode_draco(begin, size, position);
    if (!mesh.error.empty()) fail("has a mesh that Draco cannot read: " + mesh.error);
    positions = std::move(mesh.positions), corners = std::move(mesh.corners);
  }

  std::pair<const unsigned char*, std::size_t> bytes_of(const tinygltf::BufferView& view) const {
    const tinygltf::Buffer& buffer = element(model_.buffers, view.buffer, "buffer");
    if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
      fail("announces more data than it has");
    return {buffer.data.data() + view.byteOffset, view.byteLength};
  }

  /// All numbers of an accessor, one element after the other.
  std::vector<double> numbers(int number, int components) const {
    const tinygltf::Accessor& accessor = element(model_.accessors, number, "accessor");
    if (accessor.sparse.isSparse) fail("has sparse data, which cannot be read");
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
      fail("has positions or indices of an unknown kind");
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const tinygltf::BufferView& view = element(model_.bufferViews, accessor.bufferView, "view");
    const int stride = accessor.ByteStride(view);
    if (size <= 0 || stride < size * components) fail("has positions or indices of an unknown kind");
    const auto [begin, length] = bytes_of(view);
    const std::size_t count = accessor.count, step = static_cast<std::size_t>(stride),
                      element_size = static_cast<std::size_t>(size * components);
    if (count > 0 && (accessor.byteOffset > length || element_size > length - accessor.byteOffset ||
                      (count - 1) > (length - accessor.byteOffset - element_size) / step))
      fail("announces more data than it has");
    std::vector<double> result;
    result.reserve(count * static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < components; ++k)
        result.push_back(number_at(begin + accessor.byteOffset + i * step + static_cast<std::size_t>(k * size),
                                   accessor.componentType, accessor.normalized));
    return result;
  }

  template <class Number>
  static double value_of(const unsigned char* at, bool normalized) {
    Number value;
    std::memcpy(&value, at, sizeof value);
    if (!normalized || std::is_floating_point_v<Number>) return static_cast<double>(value);
    return std::max(-1.0, static_cast<double>(value) / static_cast<double>(std::numeric_limits<Number>::max()));
  }

  double number_at(const unsigned char* at, int type, bool normalized) const {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return value_of<std::int8_t>(at, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return value_of<std::uint8_t>(at, normalized);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return value_of<std::int16_t>(at, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return value_of<std::uint16_t>(at, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return value_of<std::uint32_t>(at, normalized);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return value_of<float>(at, normalized);
      default:
        fail("has positions or indices of an unknown kind");
    }
  }

  /// The mesh's vertices at these positions, new ones where nothing lies yet.
  std::vector<std::int64_t> vertices_at(const std::vector<double>& positions, const Eigen::Affine3d& place) {
    std::vector<std::int64_t> vertices;
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
      const Eigen::Vector3d at = place * Eigen::Vector3d(positions[i], positions[i + 1], positions[i + 2]);
      if (!at.allFinite()) fail("has a position that is not finite");
      const auto [found, is_new] =
          vertex_at_.try_emplace({at.x(), at.y(), at.z()}, static_cast<std::int64_t>(mesh_.coordinates.size() / 3));
      if (is_new) mesh_.coordinates.insert(mesh_.coordinates.end(), at.begin(), at.end());
      vertices.push_back(found->second);
    }
    return vertices;
  }

  void add_triangles(const std::vector<std::int64_t>& vertices, const std::vector<std::int64_t>& corners, int mode,
                     bool is_mirrored) {
    const auto vertex = [&](std::size_t i) {
      if (corners[i] < 0 || static_cast<std::size_t>(corners[i]) >= vertices.size())
        fail(fmt::format("has a triangle with vertex {}, which does not exist", corners[i]));
      return vertices[static_cast<std::size_t>(corners[i])];
    };
    const bool separate = mode == TINYGLTF_MODE_TRIANGLES;
    for (std::size_t i = 0; i + 2 < corners.size(); i += separate ? 3 : 1) {
      const std::size_t first = mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i;
      std::array<std::int64_t, 3> triangle = {vertex(first), vertex(i + 1), vertex(i + 2)};
      if (is_mirrored != (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1)) std::swap(triangle[1], triangle[2]);
      // A triangle without area, as strips have them and as corners at one place leave them.
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
      mesh_.corners.insert(mesh_.corners.end(), triangle.begin(), triangle.end());
      mesh_.end_polygon();
    }
  }

  const std::filesystem::path& path_;
  std::string part_;
  const tinygltf::Model& model_;
  std::vector<bool> visited_;  ///< per node
  NumberBudget budget_;        ///< of vertices and corners
  PolygonMesh mesh_;
  std::map<std::array<double, 3>, std::int64_t> vertex_at_;
  bool found_ = false;
};

}  // namespace

struct GlbFile::Model {
  tinygltf::Model model;
  std::size_t file_bytes = 0;
};

GlbFile::GlbFile(const std::filesystem::path& path) : path_(path) {
  auto model = std::make_unique<Model>();
  model->model = load_model(path, model->file_bytes);
  model_ = std::move(model);
}
GlbFile::~GlbFile() = default;

std::vector<std::string> GlbFile::parts() const {
  const tinygltf::Model& model = model_->model;
  std::vector<std::string> names;
  for (const tinygltf::Node& node : model.nodes) {
    if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= model.meshes.size()) continue;
    const std::string& of_mesh = model.meshes[static_cast<std::size_t>(node.mesh)].name;
    const std::string& name = node.name.empty() || (!node.children.empty() && !of_mesh.empty()) ? of_mesh : node.name;
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

PolygonMesh GlbFile::read(const std::string& part) const {
  return GlbReader(path_, model_->model, model_->file_bytes, part).read();
}

}  // namespace gracilis
