#include <gracilis/io/scene/scene_bytes.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>

#include <concepts>
#include <sstream>

namespace cereal {

template <class Archive, class Number, int rows, int columns, int options, int most_rows, int most_columns>
void save(Archive& archive, const Eigen::Matrix<Number, rows, columns, options, most_rows, most_columns>& matrix) {
  archive(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()));
  archive(binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Number)));
}

template <class Archive, class Number, int rows, int columns, int options, int most_rows, int most_columns>
void load(Archive& archive, Eigen::Matrix<Number, rows, columns, options, most_rows, most_columns>& matrix) {
  std::int64_t height = 0, width = 0;
  archive(height, width);
  matrix.resize(static_cast<Eigen::Index>(height), static_cast<Eigen::Index>(width));
  archive(binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Number)));
}

template <class Archive>
void serialize(Archive& archive, gracilis::RigidTransform& transform) {
  archive(transform.matrix());
}

}  // namespace cereal

namespace gracilis {

template <class T>
concept Settings = std::same_as<T, FiberSettings> || std::same_as<T, ContractionSettings> ||
    std::same_as<T, DistanceFieldSettings> || std::same_as<T, Sequence>;

/// What of settings is not as it is by default.
template <class Archive, Settings T>
void save(Archive& archive, const T& settings) {
  archive(changed_values(settings));
}

template <class Archive, Settings T>
void load(Archive& archive, T& settings) {
  SettingValues values;
  archive(values);
  settings = with_values(T(), values);
}

// One function for writing and reading each: cereal calls it with what it finds. In the order of scene.hpp.

template <class Archive>
void serialize(Archive& archive, TriangleMesh& mesh) {
  archive(mesh.vertices, mesh.faces);
}

template <class Archive>
void serialize(Archive& archive, Polylines& lines) {
  archive(lines.points, lines.offsets);
}

template <class Archive>
void serialize(Archive& archive, HermiteCurve& curve) {
  archive(curve.knots, curve.values, curve.slopes);
}

template <class Archive>
void serialize(Archive& archive, WrapSurface& surface) {
  archive(surface.kind, surface.radius, surface.length, surface.radii, surface.ring_radius, surface.hand,
          surface.side_axis, surface.side_sign);
}

template <class Archive>
void serialize(Archive& archive, PlacedWrap& wrap) {
  archive(wrap.surface, wrap.frame, wrap.body, wrap.first_point, wrap.last_point, wrap.plane);
}

template <class Archive>
void serialize(Archive& archive, Bone& bone) {
  archive(bone.name, bone.body, bone.surface);
}

template <class Archive>
void serialize(Archive& archive, JointAxis& axis) {
  archive(axis.coordinate, axis.axis, axis.capture_value, axis.range_min, axis.range_max, axis.translation);
}

template <class Archive>
void serialize(Archive& archive, Joint& joint) {
  archive(joint.name, joint.parent_body, joint.child_body, joint.frame, joint.axes);
}

template <class Archive>
void serialize(Archive& archive, Attachment& attachment) {
  archive(attachment.name, attachment.end, attachment.body, attachment.vertices, attachment.guessed, attachment.listed);
}

template <class Archive>
void serialize(Archive& archive, MuscleBody& body) {
  archive(body.body, body.muscle, body.patch, body.bodies, body.shares, body.center);
}

template <class Archive>
void serialize(Archive& archive, LineCoordinate& coordinate) {
  archive(coordinate.index, coordinate.capture);
}

template <class Archive>
void serialize(Archive& archive, LinePoint& point) {
  archive(point.body, point.place, point.condition, point.range_min, point.range_max, point.moving, point.frame,
          point.moves_with, point.moves_to);
}

template <class Archive>
void serialize(Archive& archive, LinePath& path) {
  archive(path.points, path.wraps);
}

template <class Archive>
void serialize(Archive& archive, ActionLine& line) {
  archive(line.points, line.bodies, line.rays, line.scaling, line.tendon, line.origin_tendon, line.tendon_sections,
          line.centers, line.optimal_fiber, line.pennation, line.path, line.shares, line.heads, line.side, line.name,
          line.max_isometric_force);
}

template <class Archive>
void serialize(Archive& archive, SectionCorner& corner) {
  archive(corner.muscle, corner.section, corner.ray);
}

template <class Archive>
void serialize(Archive& archive, Transversal& transversal) {
  archive(transversal.moved, transversal.other, transversal.bones);
}

template <class Archive>
void serialize(Archive& archive, MethodChoice& method) {
  archive(method.name, method.settings, method.contact);
}

template <class Archive>
void serialize(Archive& archive, Aponeurosis& aponeurosis) {
  archive(aponeurosis.end, aponeurosis.surface);
}

template <class Archive>
void serialize(Archive& archive, Muscle& muscle) {
  archive(muscle.name, muscle.surface, muscle.attachments, muscle.settings, muscle.fibers, muscle.given_fibers,
          muscle.given_are_superficial, muscle.aponeuroses, muscle.tracts, muscle.contraction,
          muscle.given_surface_fibers, muscle.action_line);
}

template <class Archive>
void serialize(Archive& archive, Motion& motion) {
  archive(motion.name, motion.coordinates, motion.times, motion.values);
}

template <class Archive>
void serialize(Archive& archive, AnatomicalAxes& axes) {
  archive(axes.anterior, axes.superior);
}

template <class Archive>
void serialize(Archive& archive, Scene& scene) {
  archive(scene.name, scene.bodies, scene.bones, scene.joints, scene.muscles, scene.muscle_bodies, scene.motion,
          scene.sequence, scene.distance_fields, scene.axes, scene.method, scene.transversals);
}

/// What the bytes begin with.
static const std::string mark = "gracilis scene 2\n";

std::string scene_bytes(const Scene& scene) {
  std::ostringstream bytes(std::ios::binary);
  bytes << mark;
  cereal::PortableBinaryOutputArchive archive(bytes);
  archive(scene);
  return std::move(bytes).str();
}

Scene scene_of_bytes(const std::string& bytes) {
  if (!bytes.starts_with(mark)) throw InputError({"", "", "the bytes are no scene", "make the page again"});
  std::istringstream stream(bytes.substr(mark.size()), std::ios::binary);
  cereal::PortableBinaryInputArchive archive(stream);
  Scene scene;
  archive(scene);
  return scene;
}

}  // namespace gracilis
