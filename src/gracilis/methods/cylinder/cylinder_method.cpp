#include <gracilis/methods/cylinder/cylinder_method.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/methods/cylinder/action_line.hpp>
#include <gracilis/methods/cylinder/cylinder_surface.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gracilis {

namespace {

/// What stays the same of one muscle.
struct CylinderMuscle {
  std::string name;
  const ActionLine* line = nullptr;
  Index rays = 0;
  Real length = 0;                 ///< m, of the line in the capture pose
  std::vector<Real> places;        ///< m along the line in the capture pose, of each section
  Eigen::VectorXd spacing;         ///< m, what belongs to each section of the line, in the capture pose
  Points shape;                    ///< each vertex from its section's center, in its section's axes
  Vec3 first_ray = Vec3::UnitX();  ///< of the first section, in the capture pose
};

}  // namespace

/// Where sections are, and their axes: first ray, the direction across it in the plane, the normal.
struct Sections {
  Points centers;
  SectionFrames frames;

  Eigen::Matrix3d axes(Eigen::Index k) const {
    Eigen::Matrix3d axes;
    axes << frames.first_rays.col(k), frames.normals.col(k).cross(frames.first_rays.col(k)), frames.normals.col(k);
    return axes;
  }
};

/// Half of the way to each neighbor.
static Eigen::VectorXd spacing_of(const Points& centers) {
  const Eigen::Index n = centers.cols();
  Eigen::VectorXd spacing = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 1; k < n; ++k) {
    const Real half = (centers.col(k) - centers.col(k - 1)).norm() / 2;
    spacing[k - 1] += half;
    spacing[k] += half;
  }
  return spacing;
}

/// Places of the sections on a line of this length: the tendon's keep their distance from its end.
static std::vector<Real> places_on(const CylinderMuscle& muscle, Real length) {
  const Real tendon = muscle.line->tendon, belly = muscle.length - tendon;
  std::vector<Real> places;
  // A line hardly longer than the tendon leaves no room for a belly: then all shrink alike.
  const bool stiff = tendon > 0 && belly > 0 && length - tendon > 0.2 * belly;
  for (const Real place : muscle.places) {
    if (!stiff)
      places.push_back(place * length / muscle.length);
    else
      places.push_back(place <= belly ? place * (length - tendon) / belly : length - (muscle.length - place));
  }
  return places;
}

static Sections sections_at(const CylinderMuscle& muscle, const Pose& pose) {
  const ActionLine& line = *muscle.line;
  Points points(3, line.points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) =
        pose.bodies[static_cast<std::size_t>(line.bodies[static_cast<std::size_t>(i)])] * line.points.col(i);
  const Points centers = points_along(points, places_on(muscle, polyline_length(points)));
  const Vec3 ray = pose.bodies[static_cast<std::size_t>(line.bodies[0])].linear() * muscle.first_ray;
  return {centers, section_frames(centers, ray)};
}

static Points surface_at(const CylinderMuscle& muscle, const Pose& pose) {
  const Sections sections = sections_at(muscle, pose);
  const Eigen::VectorXd spacing = spacing_of(sections.centers);
  const Eigen::Index count = sections.centers.cols();
  Points points(3, muscle.shape.cols());
  const auto place = [&](Eigen::Index k, Eigen::Index first, Eigen::Index vertices) {
    Real growth = spacing[k] > 0 ? std::sqrt(muscle.spacing[k] / spacing[k]) : 1;
    if (muscle.places[static_cast<std::size_t>(k)] > muscle.length - muscle.line->tendon) growth = 1;
    const Eigen::Matrix3d axes = sections.axes(k) * Eigen::DiagonalMatrix<Real, 3>(growth, growth, 1);
    points.middleCols(first, vertices) =
        (axes * muscle.shape.middleCols(first, vertices)).colwise() + sections.centers.col(k);
  };
  for (Eigen::Index k = 0; k < count; ++k) place(k, k * muscle.rays, muscle.rays);
  place(0, count * muscle.rays, 1);
  place(count - 1, count * muscle.rays + 1, 1);
  return points;
}

/// The vertices' places in their sections, and the sections' on the line, from the surface as it was captured.
static CylinderMuscle prepare(const Pose& capture, const Muscle& muscle) {
  CylinderMuscle result;
  result.name = muscle.name;
  result.line = &muscle.action_line;
  result.rays = muscle.action_line.rays;
  const Index count = (muscle.surface.vertex_count() - 2) / result.rays;
  const Points centers = subdivide_line(muscle.action_line.points, muscle.action_line.scaling);
  result.length = polyline_length(centers);
  result.places = distances_along(centers);
  result.spacing = spacing_of(centers);
  result.first_ray = muscle.surface.vertices.col(0) - centers.col(0);
  if (result.first_ray.norm() < 1e-9) result.first_ray = Vec3::UnitX();
  const Sections sections = sections_at(result, capture);
  result.shape.resize(3, muscle.surface.vertex_count());
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Index k = v < count * result.rays ? v / result.rays : v == count * result.rays ? 0 : count - 1;
    result.shape.col(v) = sections.axes(k).transpose() * (muscle.surface.vertices.col(v) - sections.centers.col(k));
  }
  return result;
}

namespace {

class CylinderMethod final : public DeformationMethod {
 public:
  explicit CylinderMethod(const Scene& scene) : lines_(scene.muscles) {
    const Pose capture = capture_pose(scene.bodies.size());
    for (const Muscle& muscle : lines_) {
      muscles_.push_back(prepare(capture, muscle));
      shapes_.push_back(muscle.surface.vertices);
    }
  }

  void reset() override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) shapes_[m] = lines_[m].surface.vertices;
  }

  StepReport advance(const Pose& pose) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<Points> next(muscles_.size());
    parallel_for(static_cast<Index>(muscles_.size()), 8, [&](Index begin, Index end) {
      for (auto m = static_cast<std::size_t>(begin); m < static_cast<std::size_t>(end); ++m) {
        const auto start = std::chrono::steady_clock::now();
        next[m] = surface_at(muscles_[m], pose);
        const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - start;
        report.muscles[m].milliseconds = taken.count();
      }
    });
    for (std::size_t m = 0; m < muscles_.size(); ++m)
      if (!next[m].allFinite()) throw QualityError("muscle " + muscles_[m].name + ": a section is not finite");
    shapes_ = std::move(next);
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.resize(muscles_.size());
    for (std::size_t m = 0; m < muscles_.size(); ++m) frame.muscles[m] = {shapes_[m]};
  }

  void restore(const Frame&, const Frame& last) override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) shapes_[m] = last.muscles[m].points;
  }

 private:
  std::vector<Muscle> lines_;  ///< the scene's, which need not outlive this
  std::vector<CylinderMuscle> muscles_;
  std::vector<Points> shapes_;
};

}  // namespace

std::unique_ptr<DeformationMethod> make_cylinder_method(const Scene& scene) {
  return std::make_unique<CylinderMethod>(scene);
}

}  // namespace gracilis
