#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include "test_files.hpp"

#include <shapes.hpp>

#include <draco/compression/encode.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <fstream>

namespace gracilis {
namespace {

using testing::HasSubstr;

/// A file of glTF under way.
struct Glb {
  tinygltf::Model model;
  Glb() {
    model.buffers.emplace_back();
    model.scenes.emplace_back();
    model.defaultScene = 0;
    model.asset.version = "2.0";
  }

  int view_of(const void* data, std::size_t size) {
    std::vector<unsigned char>& bytes = model.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0, view.byteOffset = bytes.size(), view.byteLength = size;
    bytes.insert(bytes.end(), static_cast<const unsigned char*>(data), static_cast<const unsigned char*>(data) + size);
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
  }

  int accessor(int view, int component, int type, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view, accessor.componentType = component, accessor.type = type, accessor.count = count;
    accessor.minValues = {-1, -1, -1}, accessor.maxValues = {1, 1, 1};
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  /// A mesh with a vertex of its own for each corner, as where normals break.
  void add(const std::string& name, const TriangleMesh& surface, const std::vector<double>& scale = {}) {
    std::vector<float> positions;
    std::vector<std::uint16_t> corners;
    for (Index f = 0; f < surface.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(surface.vertices(i, surface.faces(k, f))));
        corners.push_back(static_cast<std::uint16_t>(corners.size()));
      }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = accessor(view_of(positions.data(), 4 * positions.size()),
                                                TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, corners.size());
    primitive.indices = accessor(view_of(corners.data(), 2 * corners.size()), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                 TINYGLTF_TYPE_SCALAR, corners.size());
    add_node(name, primitive, scale);
  }

  void add_draco(const std::string& name, const TriangleMesh& surface) {
    draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(surface.vertex_count()));
    draco::GeometryAttribute description;
    description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
    const int at = mesh.AddAttribute(description, true, static_cast<std::uint32_t>(surface.vertex_count()));
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      const Eigen::Vector3f place = surface.vertices.col(v).cast<float>();
      mesh.attribute(at)->SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(v)), place.data());
    }
    for (Index f = 0; f < surface.face_count(); ++f) {
      draco::Mesh::Face face;
      for (int k = 0; k < 3; ++k) face[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(surface.faces(k, f));
      mesh.AddFace(face);
    }
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] =
        accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.num_points());
    primitive.indices = accessor(-1, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, 3 * mesh.num_faces());
    tinygltf::Value::Object attributes, extension;
    attributes["POSITION"] = tinygltf::Value(static_cast<int>(mesh.attribute(at)->unique_id()));
    extension["bufferView"] = tinygltf::Value(view_of(buffer.data(), buffer.size()));
    extension["attributes"] = tinygltf::Value(attributes);
    primitive.extensions["KHR_draco_mesh_compression"] = tinygltf::Value(extension);
    model.extensionsUsed = model.extensionsRequired = {"KHR_draco_mesh_compression"};
    add_node(name, primitive, {});
  }

  void add_node(const std::string& name, const tinygltf::Primitive& primitive, const std::vector<double>& scale) {
    tinygltf::Mesh mesh;
    mesh.primitives = {primitive};
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = name, node.mesh = static_cast<int>(model.meshes.size()) - 1;
    if (!scale.empty()) node.translation = {0.1, 0, 0}, node.rotation = {0, 0, 1, 0}, node.scale = scale;
    model.nodes.push_back(node);
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
  }

  std::filesystem::path written(const TestFolder& folder, const std::string& name) {
    const std::filesystem::path path = folder.path() / name;
    tinygltf::TinyGLTF writer;
    EXPECT_TRUE(writer.WriteGltfSceneToFile(&model, path.string(), true, true, false, true));
    return path;
  }
};

class GlbReader : public testing::Test {
 protected:
  TestFolder folder;
};

TriangleMesh ball() { return shapes::sphere({0, 0, 0}, 0.02, 3); }

/// `tolerance` in m³.
void expect_the_ball(const TriangleMesh& mesh, Real tolerance) {
  EXPECT_EQ(mesh.vertex_count(), ball().vertex_count());
  EXPECT_EQ(mesh.face_count(), ball().face_count());
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), enclosed_volume(ball().vertices, ball().faces), tolerance);
}

TEST_F(GlbReader, corners_at_one_place_become_one_vertex) {
  Glb glb;
  glb.add("muscle", ball());
  expect_the_ball(read_mesh(glb.written(folder, "ball.glb"), 1), 1e-10);
}

TEST_F(GlbReader, a_file_of_several_parts_is_read_from_the_disk_once) {
  Glb glb;
  glb.add("muscle", ball());
  glb.add("bone", shapes::box(Vec3::Zero(), Vec3::Constant(0.01)));
  const std::filesystem::path path = glb.written(folder, "body.glb");
  MeshFiles files;
  expect_the_ball(files.read(path, 1, "muscle"), 1e-10);
  std::ofstream(path) << "something else";
  EXPECT_EQ(files.read(path, 1, "bone").vertex_count(), 8);
  EXPECT_THROW(read_mesh(path, 1, "bone"), InputError);
}

TEST_F(GlbReader, a_node_places_its_mesh_and_a_mirror_keeps_it_turned_outwards) {
  for (const std::vector<double>& scale : {std::vector<double>{2, 1, 1}, std::vector<double>{-2, 1, 1}}) {
    Glb glb;
    glb.add("muscle", ball(), scale);
    const TriangleMesh mesh = read_mesh(glb.written(folder, "placed.glb"), 1);
    EXPECT_NEAR(mesh.vertices.row(0).mean(), 0.1, 1e-7);
    EXPECT_NEAR(mesh.vertices.row(0).maxCoeff(), 0.14, 1e-7);
    EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), 2 * enclosed_volume(ball().vertices, ball().faces), 1e-10);
  }
}

TEST_F(GlbReader, a_part_is_chosen_by_its_name) {
  Glb glb;
  glb.add("bone", shapes::box({0, 0, 0}, {0.1, 0.1, 0.1}));
  glb.add("muscle", ball());
  const std::filesystem::path path = glb.written(folder, "two.glb");
  EXPECT_EQ(read_mesh(path, 1).face_count(), 12 + ball().face_count());
  EXPECT_EQ(read_mesh(path, 1, "bone").face_count(), 12);
  try {
    read_mesh(path, 1, "muscel");
    FAIL() << "took a part that is not there";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no node or mesh 'muscel'"));
    EXPECT_THAT(error.what(), HasSubstr("'muscle'"));
  }
}

TEST_F(GlbReader, what_draco_compressed_is_read_to_its_own_precision) {
  Glb glb;
  glb.add_draco("muscle", ball());
  expect_the_ball(read_mesh(glb.written(folder, "draco.glb"), 1), 1e-8);
}

TEST_F(GlbReader, a_file_cut_short_or_changed_anywhere_is_refused_or_read_but_never_more) {
  Glb glb;
  glb.add("muscle", shapes::box({0, 0, 0}, {0.1, 0.1, 0.1}));
  glb.add_draco("other", shapes::box({0, 0, 0}, {0.1, 0.1, 0.1}));
  const std::filesystem::path path = glb.written(folder, "whole.glb"), broken = folder.path() / "broken.glb";
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  int refused = 0, tries = 0;
  const auto try_to_read = [&](const std::string& text) {
    std::ofstream(broken, std::ios::binary) << text;
    ++tries;
    try {
      read_mesh(broken, 1);
    } catch (const InputError&) {
      ++refused;
    }
  };
  for (std::size_t length = 1; length < bytes.size(); length += 7) try_to_read(bytes.substr(0, length));
  EXPECT_EQ(refused, tries);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x15);
    try_to_read(changed);
  }
  EXPECT_GT(refused, tries / 4);
}

TEST_F(GlbReader, nodes_that_are_no_trees_are_refused_however_often_they_branch) {
  Glb glb;
  glb.add("muscle", shapes::box({0, 0, 0}, {0.1, 0.1, 0.1}));
  for (int i = 0; i < 60; ++i) {
    tinygltf::Node node;
    node.children = {i, i};
    glb.model.nodes.push_back(node);
  }
  glb.model.scenes[0].nodes = {60};
  EXPECT_THAT(message_of_input_error([&] { read_mesh(glb.written(folder, "branches.glb"), 1); }),
              HasSubstr("branches.glb: comes to node 0 twice"));
  glb.model.nodes[1].children = {1};
  glb.model.scenes[0].nodes = {1};
  EXPECT_THAT(message_of_input_error([&] { read_mesh(glb.written(folder, "cycle.glb"), 1); }),
              HasSubstr("cycle.glb: comes to node 1 twice"));
}

TEST_F(GlbReader, without_a_scene_each_node_is_placed_once) {
  Glb glb;
  glb.add("muscle", shapes::box({0, 0, 0}, {0.1, 0.1, 0.1}));
  tinygltf::Node above;
  above.children = {0};
  above.translation = {1, 0, 0};
  glb.model.nodes.push_back(above);
  glb.model.scenes.clear();
  glb.model.defaultScene = -1;
  const TriangleMesh mesh = read_mesh(glb.written(folder, "bare.glb"), 1);
  EXPECT_EQ(mesh.vertex_count(), 8);
  EXPECT_GT(mesh.vertices.row(0).minCoeff(), 0.9);
}

TEST_F(GlbReader, a_mesh_may_be_placed_a_few_times_but_not_without_end) {
  const auto placed = [&](int times) {
    Glb glb;
    glb.add("muscle", ball());
    for (int i = 1; i < times; ++i) {
      tinygltf::Node node;
      node.mesh = 0;
      glb.model.nodes.push_back(node);
      glb.model.scenes[0].nodes.push_back(i);
    }
    return glb.written(folder, "placed.glb");
  };
  EXPECT_EQ(read_mesh(placed(20), 1).face_count(), 20 * ball().face_count());
  const std::filesystem::path bomb = placed(3000);
  EXPECT_THAT(message_of_input_error([&] { read_mesh(bomb, 1); }), HasSubstr("places more corners than a file"));
}

TEST_F(GlbReader, files_beside_it_are_not_looked_for) {
  // A .glb whose buffer is named by an address.
  std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"uri":"secret.bin","byteLength":4}]})";
  while (json.size() % 4) json += ' ';
  std::string text = "glTF";
  const auto number = [&](std::uint32_t n) { text.append(reinterpret_cast<const char*>(&n), 4); };
  number(2), number(static_cast<std::uint32_t>(20 + json.size())), number(static_cast<std::uint32_t>(json.size()));
  folder.write("secret.bin", "1234");
  EXPECT_THROW(read_mesh(folder.write("apart.glb", text + "JSON" + json), 1), InputError);
}

}  // namespace
}  // namespace gracilis
