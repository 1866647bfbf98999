#include <gracilis/opensim/import/skeleton_fit.hpp>

#include <gracilis/anatomy/sections/tendon_lengths.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace gracilis::opensim {

namespace {

/// Where a body goes: its points p lie at pose * (scale p).
struct FittedBody {
  Vec3 scale = Vec3::Ones();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();  ///< from the default pose's directions
  RigidTransform pose = RigidTransform::Identity();

  Real size() const { return scale.mean(); }
};

class SkeletonFit {
 public:
  SkeletonFit(const Model& model, const std::vector<BodyFit>& fits) : model_(model), result_(model), fits_(fits) {
    Skeleton skeleton(model);
    const Eigen::VectorXd coordinates = default_coordinates(model);
    skeleton.place(coordinates);
    before_ = skeleton.poses();
    bodies_.resize(model.bodies.size());
    for (const BodyFit& fit : fits)
      if (index_of(model.bodies, fit.body) < 1) fail(fit.body, "is no body of the model", similar(fit.body));
  }

  Model fitted() {
    for (std::size_t j = 0; j < model_.joints.size(); ++j) fit_joint(j);
    for (std::size_t b = 0; b < bodies_.size(); ++b) scale_body(result_.bodies[b], bodies_[b]);
    for (WrapObject& object : result_.wrap_objects) scale_wrap(object, at(object.body));
    for (Muscle& muscle : result_.muscles) scale_path(muscle.path);
    scale_muscles();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& body, const std::string& what, const std::string& remedy) const {
    throw InputError({model_.name, body, what, remedy});
  }

  std::string similar(const std::string& body) const { return suggestion(body, names_of(model_.bodies)); }

  FittedBody& at(Index body) { return bodies_[static_cast<std::size_t>(body)]; }

  /// The body's far end in the default pose.
  Vec3 far_end(const BodyFit& fit, Index body) const {
    for (const Joint& joint : model_.joints) {
      if (joint.parent_body != body) continue;
      if (!fit.toward.empty() && model_.bodies[static_cast<std::size_t>(joint.child_body)].name != fit.toward) continue;
      return before_[static_cast<std::size_t>(joint.child_body)] * joint.child_frame.translation();
    }
    fail(fit.body,
         fit.toward.empty() ? "carries no other body, so that it has no length" : "does not carry " + fit.toward,
         "leave 'end_mm' out, or name a body that it carries in 'toward'");
  }

  void fit_joint(std::size_t j) {
    const Joint& joint = model_.joints[j];
    const std::string& name = model_.bodies[static_cast<std::size_t>(joint.child_body)].name;
    const auto found = std::find_if(fits_.begin(), fits_.end(), [&](const BodyFit& fit) { return fit.body == name; });
    const BodyFit fit = found == fits_.end() ? BodyFit{} : *found;
    const FittedBody parent = at(joint.parent_body);
    const RigidTransform& old_parent = before_[static_cast<std::size_t>(joint.parent_body)];
    const RigidTransform& old_child = before_[static_cast<std::size_t>(joint.child_body)];
    const Vec3 old_start = old_child * joint.child_frame.translation();
    FittedBody& child = at(joint.child_body);
    child.turned = parent.turned;
    // The joint's center follows the parent unless the skeleton says where it is.
    Vec3 start = parent.pose * (parent.scale.asDiagonal() * (old_parent.inverse() * old_start));
    if (fit.start) start = *fit.start;
    if (fit.end) {
      const Vec3 old_way = far_end(fit, joint.child_body) - old_start, way = *fit.end - start;
      if (!(old_way.norm() > 1e-6 && way.norm() > 1e-6))
        fail(fit.body, "has no length", "its start and end must differ, in the model, too");
      child.scale = Vec3::Constant(way.norm() / old_way.norm());
      child.turned = turn_from_to(old_way, way).toRotationMatrix();
    }
    child.scale = child.scale.cwiseProduct(fit.scale);
    child.turned = body_fixed_xyz(fit.turn, Vec3::Zero()).linear() * child.turned;
    child.pose.linear() = child.turned * old_child.linear();
    child.pose.translation() =
        start + fit.shift - child.pose.linear() * (child.scale.asDiagonal() * joint.child_frame.translation());

    // What the joint's coordinates do between its frames stays, but for lengths.
    Joint& placed = result_.joints[j];
    RigidTransform moved = (old_parent * joint.parent_frame).inverse() * old_child * joint.child_frame;
    moved.translation() *= parent.size();
    for (std::size_t axis = 3; axis < 6; ++axis) placed.axes[axis].function.scale *= parent.size();
    placed.child_frame.translation() = child.scale.asDiagonal() * joint.child_frame.translation();
    placed.parent_frame = parent.pose.inverse() * child.pose * placed.child_frame * moved.inverse();
  }

  static void scale_body(Body& body, const FittedBody& fit) {
    body.mass_center = fit.scale.asDiagonal() * body.mass_center;
    body.inertia *= fit.size() * fit.size();
    for (Geometry& geometry : body.geometry) {
      geometry.frame.translation() = fit.scale.asDiagonal() * geometry.frame.translation();
      geometry.scale = geometry.scale.cwiseProduct(fit.scale);
    }
  }

  static void scale_wrap(WrapObject& object, const FittedBody& fit) {
    object.frame.translation() = fit.scale.asDiagonal() * object.frame.translation();
    object.surface.radius *= fit.size();
    object.surface.length *= fit.size();
    object.surface.radii *= fit.size();
    object.surface.ring_radius *= fit.size();
  }

  void scale_path(Path& path) {
    for (PathPoint& point : path.points) {
      const Vec3& scale = at(point.body).scale;
      point.location = scale.asDiagonal() * point.location;
      for (std::size_t i = 0; i < 3; ++i) point.moves_to[i].scale *= scale[static_cast<Eigen::Index>(i)];
    }
  }

  void scale_muscles() {
    const Eigen::VectorXd coordinates = default_coordinates(model_);
    Skeleton before(model_), after(result_);
    before.place(coordinates);
    after.place(coordinates);
    for (std::size_t m = 0; m < model_.muscles.size(); ++m) {
      Muscle& muscle = result_.muscles[m];
      if (!muscle.path.function_coordinates.empty()) continue;
      const Real old_length = measure_path(before, model_.muscles[m].path, coordinates).length;
      const Real ratio = old_length > 0 ? measure_path(after, muscle.path, coordinates).length / old_length : 1;
      const Real slack = muscle.tendon_slack_length;
      muscle.tendon_slack_length =
          tendon_lengths(muscle.optimal_fiber_length, muscle.pennation_angle_at_optimal, slack, 1, ratio).scaled_tendon;
      muscle.optimal_fiber_length *= ratio;
    }
  }

  const Model& model_;
  Model result_;
  const std::vector<BodyFit>& fits_;
  std::vector<RigidTransform> before_;
  std::vector<FittedBody> bodies_;
};

}  // namespace

Model fit_to_skeleton(const Model& model, const std::vector<BodyFit>& fits) {
  return SkeletonFit(model, fits).fitted();
}

static std::optional<Vec3> three_numbers(const std::filesystem::path& path, const std::string& body,
                                         const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  Vec3 values;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> value = array && array->size() == 3 ? (*array)[i].value<double>() : std::nullopt;
    if (!value)
      throw InputError({path.string(), body, fmt::format("'{}' is not three numbers", key), "as in [1, 2, 3]"});
    values[static_cast<Eigen::Index>(i)] = *value;
  }
  return values;
}

static BodyFit read_body_fit(const std::filesystem::path& path, const std::string& name, const toml::table& table) {
  const std::vector<std::string> keys = {"start_mm", "end_mm", "toward", "scale", "turn_deg", "shift_mm"};
  for (const auto& [key, node] : table)
    if (std::find(keys.begin(), keys.end(), std::string(key.str())) == keys.end())
      throw InputError(
          {path.string(), name, fmt::format("unknown key '{}'", key.str()), suggestion(std::string(key.str()), keys)});
  BodyFit fit;
  fit.body = name;
  const auto numbers = [&](const char* key) { return three_numbers(path, name, table, key); };
  if (const auto start = numbers("start_mm")) fit.start = *start / 1000;
  if (const auto end = numbers("end_mm")) fit.end = *end / 1000;
  fit.toward = table["toward"].value_or(std::string());
  fit.scale = numbers("scale").value_or(fit.scale);
  fit.turn = numbers("turn_deg").value_or(Vec3::Zero()) * radians(1);
  fit.shift = numbers("shift_mm").value_or(Vec3::Zero()) / 1000;
  if (!(fit.scale.minCoeff() > 0)) throw InputError({path.string(), name, "has a scale of zero or less", ""});
  return fit;
}

std::vector<BodyFit> read_skeleton_fit(const std::filesystem::path& path) {
  require_readable_file(path);
  try {
    const toml::table table = parse_toml(read_text(path), path.string());
    const toml::table* bodies = table["bodies"].as_table();
    if (!bodies) throw InputError({path.string(), "", "names no bodies", "give tables such as [bodies.femur_r]"});
    std::vector<BodyFit> fits;
    for (const auto& [key, node] : *bodies) {
      const toml::table* body = node.as_table();
      if (!body) throw InputError({path.string(), std::string(key.str()), "is no table", "as in [bodies.femur_r]"});
      fits.push_back(read_body_fit(path, std::string(key.str()), *body));
    }
    return fits;
  } catch (const toml::parse_error& error) {
    throw InputError({path.string(), std::to_string(error.source().begin.line), std::string(error.description()), ""});
  }
}

}  // namespace gracilis::opensim
