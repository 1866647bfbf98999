#include <gracilis/anatomy/builtin/builtin_parts.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/surface_remeshing.hpp>

#include <cmath>
#include <utility>

namespace gracilis::builtin_shapes {

namespace {

constexpr Real attachment_reach = 0.0042;  ///< m; what is closer to the bone grows on it

/// Marks the vertices of the muscle that grow on bone: near a bone of the body, and in the part of the sheet that is
/// this end.
void attach(const MusclePlan& plan, const std::vector<Bone>& bones, const std::vector<NearestTriangle>& nearest,
            Muscle& muscle) {
  const TriangleMesh& surface = muscle.surface;
  const ThickSheet sheet(plan.net);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 point = surface.vertices.col(v);
    const Real along = sheet.nearest(point).along;
    if (along > plan.origin_until && along < plan.insertion_from) continue;
    Attachment& attachment = muscle.attachments[along > plan.origin_until ? 1 : 0];
    for (std::size_t b = 0; b < bones.size(); ++b)
      if (bones[b].body == attachment.body && nearest[b].query(point, attachment_reach).face >= 0) {
        attachment.vertices.push_back(v);
        break;
      }
  }
}

}  // namespace

void add_bone(Skeleton& skeleton, const std::string& name, Index body, const ImplicitSolid& solid) {
  constexpr Real step = 0.002, edge = 0.0033;
  SampledSolid sampled = sample(solid, step);
  skeleton.bones.push_back({name, body, remesh(largest_component(extract_surface(sampled)), sampled, edge)});
  skeleton.solids.push_back(as_solid(std::move(sampled)));
}

std::vector<Muscle> make_muscles(const std::vector<MusclePlan>& plans, const Skeleton& skeleton, const Gaps& gaps) {
  std::vector<Obstacle> obstacles;
  for (const ImplicitSolid& solid : skeleton.solids) obstacles.push_back({solid, gaps.bone});
  std::vector<NearestTriangle> nearest;
  for (const Bone& bone : skeleton.bones) nearest.emplace_back(bone.surface);

  std::vector<Muscle> muscles = outlined_muscles(plans);
  for (std::size_t m = 0; m < plans.size(); ++m) {
    ShapedMuscle shaped = shape_muscle(plans[m], obstacles);
    obstacles.push_back({as_solid(std::move(shaped.shape)), gaps.muscle});
    muscles[m].surface = std::move(shaped.surface);
    attach(plans[m], skeleton.bones, nearest, muscles[m]);
  }
  return muscles;
}

std::vector<Muscle> outlined_muscles(const std::vector<MusclePlan>& plans) {
  std::vector<Muscle> muscles;
  for (const MusclePlan& plan : plans) {
    Muscle muscle;
    muscle.name = plan.name;
    muscle.settings["iterations"] = plan.iterations;
    muscle.attachments = {{"origin", AttachmentEnd::origin, plan.origin_body, {}, false},
                          {"insertion", AttachmentEnd::insertion, plan.insertion_body, {}, false}};
    muscles.push_back(std::move(muscle));
  }
  return muscles;
}

Motion ramp_from_zero(const std::string& name, const std::string& coordinate, Real last, Real step, Real time_step) {
  const Index rows = static_cast<Index>(std::floor(last / step + 1e-9)) + 1;
  Motion motion{name, {coordinate}, {}, Eigen::MatrixXd(rows, 1)};
  for (Index row = 0; row < rows; ++row) {
    motion.times.push_back(row * time_step);
    motion.values(row, 0) = row * step;
  }
  return motion;
}

}  // namespace gracilis::builtin_shapes
