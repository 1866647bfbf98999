#include <gracilis/view/export/export_gltf.hpp>

#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <gracilis/io/atomic_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace gracilis {

using Json = nlohmann::ordered_json;

namespace {

// Numbers of the glTF 2.0 specification (Khronos 2021).
constexpr int float_type = 5126, unsigned_type = 5125;
constexpr int array_buffer = 34962, element_array_buffer = 34963;

/// A model as it grows: its JSON and its one buffer.
struct Model {
  Json json;
  std::string bytes;

  Json& list(const char* name) { return json[name]; }

  int add(const char* name, Json element) {
    list(name).push_back(std::move(element));
    return static_cast<int>(list(name).size()) - 1;
  }

  /// Columns of numbers as an accessor, with the bounds that the format asks for. `target` 0: none.
  template <class Number>
  int add_array(const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>& columns, const char* type, int target) {
    const Json view = {{"buffer", 0},
                       {"byteOffset", bytes.size()},
                       {"byteLength", static_cast<std::size_t>(columns.size()) * sizeof(Number)}};
    bytes.append(reinterpret_cast<const char*>(columns.data()),
                 static_cast<std::size_t>(columns.size()) * sizeof(Number));
    const int view_number = add("bufferViews", view);
    if (target != 0) list("bufferViews").back()["target"] = target;
    Json low = Json::array(), high = Json::array();
    for (Eigen::Index row = 0; row < columns.rows(); ++row) {
      low.push_back(columns.row(row).minCoeff());
      high.push_back(columns.row(row).maxCoeff());
    }
    return add("accessors", {{"bufferView", view_number},
                             {"componentType", std::is_same_v<Number, float> ? float_type : unsigned_type},
                             {"count", columns.cols()},
                             {"type", type},
                             {"min", low},
                             {"max", high}});
  }

  int add_points(const Points& points, int target) { return add_array<float>(points.cast<float>(), "VEC3", target); }
};

/// glTF's colors are linear, ours are sRGB.
Json linear(const Color& color) {
  Json result = Json::array();
  for (const Real c : color) result.push_back(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  result.push_back(1.0);
  return result;
}

Points normals_of(const Points& points, const Eigen::Matrix3Xi& faces) {
  Points normals = Points::Zero(3, points.cols());
  for (const Eigen::Vector3i face : faces.colwise()) {
    const Vec3 a = points.col(face[0]);
    const Vec3 normal = (Vec3(points.col(face[1])) - a).cross(Vec3(points.col(face[2])) - a);
    for (const int v : face) normals.col(v) += normal;
  }
  for (auto normal : normals.colwise()) {
    const Real length = normal.norm();
    normal = length > 0 ? Vec3(normal / length) : Vec3::UnitY();
  }
  return normals;
}

int add_mesh(Model& model, const std::string& name, const Points& points, const Eigen::Matrix3Xi& faces,
             const Color& color) {
  const int material =
      model.add("materials", {{"name", name},
                              {"pbrMetallicRoughness",
                               {{"baseColorFactor", linear(color)}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}},
                              {"doubleSided", true}});
  Eigen::Matrix<std::uint32_t, Eigen::Dynamic, Eigen::Dynamic> indices =
      faces.reshaped(1, faces.size()).cast<std::uint32_t>();
  const Json primitive = {{"attributes",
                           {{"POSITION", model.add_points(points, array_buffer)},
                            {"NORMAL", model.add_points(normals_of(points, faces), array_buffer)}}},
                          {"indices", model.add_array<std::uint32_t>(indices, "SCALAR", element_array_buffer)},
                          {"material", material}};
  return model.add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
}

void add_channel(Model& model, int node, const char* path, int times, int values) {
  Json& animation = model.list("animations")[0];
  animation["samplers"].push_back({{"input", times}, {"output", values}, {"interpolation", "LINEAR"}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

int add_bone(Model& model, const RecordedRun& run, const std::string& name, const std::vector<int>& frames, int times,
             Index vertices) {
  const AnimatedSurface surface = animated_surface(run, name, vertices);
  const int mesh = add_mesh(model, name, surface.rest, surface.faces, bone_color());
  const int node = model.add("nodes", {{"name", name}, {"mesh", mesh}});
  const std::vector<RigidTransform> motions = bone_motions(run, name, frames);
  Eigen::MatrixXf turns(4, static_cast<Index>(frames.size())), shifts(3, turns.cols());
  Eigen::Quaternionf last = Eigen::Quaternionf::Identity();
  for (Index i = 0; i < turns.cols(); ++i) {
    const RigidTransform& motion = motions[static_cast<std::size_t>(i)];
    Eigen::Quaternionf turn(motion.linear().cast<float>());
    if (turn.dot(last) < 0) turn.coeffs() *= -1;  // the short way round
    last = turn;
    turns.col(i) = turn.coeffs();
    shifts.col(i) = motion.translation().cast<float>();
  }
  add_channel(model, node, "rotation", times, model.add_array<float>(turns, "VEC4", 0));
  add_channel(model, node, "translation", times, model.add_array<float>(shifts, "VEC3", 0));
  return node;
}

int add_muscle(Model& model, const RecordedRun& run, const std::string& name, const std::vector<int>& frames, int times,
               Index vertices) {
  const AnimatedSurface surface = animated_surface(run, name, vertices);
  const int mesh = add_mesh(model, name, surface.rest, surface.faces, muscle_color(name));
  const int node = model.add("nodes", {{"name", name}, {"mesh", mesh}});
  const std::size_t targets = frames.size() - 1;  // frame 0 is the mesh itself
  if (targets == 0) return node;
  Json morphs = Json::array();
  for (std::size_t i = 1; i < frames.size(); ++i)
    morphs.push_back({{"POSITION", model.add_points(points_in(run, surface, frames[i]) - surface.rest, array_buffer)}});
  Json& written = model.list("meshes")[static_cast<std::size_t>(mesh)];
  written["primitives"][0]["targets"] = morphs;
  written["weights"] = std::vector<Real>(targets, 0.0);
  // At the time of frame i target i - 1 has all the weight.
  Eigen::MatrixXf weights = Eigen::MatrixXf::Zero(1, static_cast<Index>(frames.size() * targets));
  for (std::size_t i = 1; i < frames.size(); ++i) weights(0, static_cast<Index>(i * targets + i - 1)) = 1;
  add_channel(model, node, "weights", times, model.add_array<float>(weights, "SCALAR", 0));
  return node;
}

std::string four_bytes(std::size_t number) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 255);
  return bytes;
}

std::string padded(std::string text, char with) {
  while (text.size() % 4 != 0) text += with;
  return text;
}

}  // namespace

void export_gltf(const RecordedRun& run, const std::filesystem::path& path, const AnimationOptions& options) {
  Model model;
  model.json = {{"asset", {{"version", "2.0"}, {"generator", "Gracilis"}}}, {"scene", 0}};
  const std::vector<int> frames = spread_frames(run.frame_count, std::max(2, options.frames));
  Eigen::MatrixXf seconds(1, static_cast<Index>(frames.size()));
  for (Index i = 0; i < seconds.cols(); ++i)
    seconds(0, i) = static_cast<float>(static_cast<Real>(i) / options.frames_per_second);
  const int times = model.add_array<float>(seconds, "SCALAR", 0);
  model.json["animations"] = Json::array(
      {{{"name", run.manifest.value("scene", "run")}, {"samplers", Json::array()}, {"channels", Json::array()}}});
  std::vector<int> children;
  for (const std::string& bone : run.bones)
    children.push_back(add_bone(model, run, bone, frames, times, options.bone_vertices));
  for (const std::string& muscle : run.muscles)
    children.push_back(add_muscle(model, run, muscle, frames, times, options.muscle_vertices));
  const Eigen::Matrix3d turn = upright_turn(run);
  const Eigen::Quaterniond upright(turn);
  Json root_node = {{"name", run.manifest.value("scene", "run")},
                    {"rotation", {upright.x(), upright.y(), upright.z(), upright.w()}},
                    {"children", children}};
  if (const Vec3 place = turn * run.place; !place.isZero())
    root_node["translation"] = {place.x(), place.y(), place.z()};
  const int root = model.add("nodes", root_node);
  model.json["scenes"] = Json::array({{{"nodes", {root}}}});
  model.json["buffers"] = Json::array({{{"byteLength", model.bytes.size()}}});
  const std::string json = padded(model.json.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
  const std::string bytes = padded(model.bytes, '\0');
  write_text_atomically(path, "glTF" + four_bytes(2) + four_bytes(12 + 8 + json.size() + 8 + bytes.size()) +
                                  four_bytes(json.size()) + "JSON" + json + four_bytes(bytes.size()) +
                                  std::string("BIN\0", 4) + bytes);
}

}  // namespace gracilis
