#include <gracilis/methods/cylinder/cylinder_method.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/cylinder/section_collision.hpp>
#include <gracilis/methods/cylinder/sheet_sections.hpp>
#include <gracilis/methods/cylinder/surface_sections.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace gracilis {

struct CylinderSettings {
  int transversal_rounds = 60;
};

template <>
std::span<const Setting<CylinderSettings>> setting_table() {
  using S = CylinderSettings;
  static const Setting<S> table[] = {
      {"transversal_rounds", &S::transversal_rounds, "", 1, 10000,
       "Rounds in which tagged sections give way in a frame, at most; a section that lies deep takes some 40.", true},
  };
  return table;
}

namespace {

/// What stays the same of one muscle with an action line.
struct CylinderMuscle {
  LineSections sections;
  Index rays = 0;
  Eigen::VectorXd spacing;  ///< m, what belongs to each section of the line, in the capture pose
  Points shape;             ///< each vertex from its section's place on the line, in its section's axes
  Points offsets;           ///< so each section's center
};

}  // namespace

namespace {

/// A muscle's sections, and the vertices that close its ends.
struct CylinderShape {
  SectionRings rings;
  Points ends;

  Points vertices() const {
    Points all(3, rings.corners.cols() + ends.cols());
    all << rings.corners, ends;
    return all;
  }
};

}  // namespace

static CylinderShape shape_at(const CylinderMuscle& muscle, const Pose& pose) {
  const PlacedSections sections = sections_at(muscle.sections, pose);
  const Eigen::VectorXd spacing = spacing_of(sections.centers);
  const Eigen::Index count = sections.centers.cols();
  CylinderShape result;
  result.rings = {muscle.rays, Points(3, count), Points(3, count * muscle.rays)};
  result.ends.resize(3, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    Real growth = spacing[k] > 0 ? std::sqrt(muscle.spacing[k] / spacing[k]) : 1;
    if (distance_from_tendon(muscle.sections, static_cast<Index>(k)) < 0) growth = 1;
    const Eigen::Matrix3d axes = sections.frames.axes(k) * Eigen::DiagonalMatrix<Real, 3>(growth, growth, 1);
    const Vec3 center = sections.centers.col(k);
    result.rings.corners.middleCols(k * muscle.rays, muscle.rays) =
        (axes * muscle.shape.middleCols(k * muscle.rays, muscle.rays)).colwise() + center;
    result.rings.centers.col(k) = axes * muscle.offsets.col(k) + center;
    if (k == 0) result.ends.col(0) = axes * muscle.shape.col(count * muscle.rays) + center;
    if (k == count - 1) result.ends.col(1) = axes * muscle.shape.col(count * muscle.rays + 1) + center;
  }
  return result;
}

/// The same of a sheet; its sections' centers are their middles.
static CylinderShape shape_at(const SheetSections& sheet, const Pose& pose) {
  const Points vertices = sheet_at(sheet, pose);
  const Eigen::Index corners = vertices.cols() - 2;
  CylinderShape result;
  result.rings = {sheet.rays, Points(3, corners / sheet.rays), vertices.leftCols(corners)};
  for (Eigen::Index k = 0; k < result.rings.centers.cols(); ++k)
    result.rings.centers.col(k) = vertices.middleCols(k * sheet.rays, sheet.rays).rowwise().mean();
  result.ends = vertices.rightCols(2);
  return result;
}

/// The vertices' places in their sections, and the sections' on the line, from the surface as it was captured.
static CylinderMuscle prepare(const Pose& capture, const Muscle& muscle) {
  CylinderMuscle result;
  result.sections = line_sections(muscle);
  result.rays = muscle.action_line.rays;
  const auto count = static_cast<Index>(result.sections.places.size());
  const PlacedSections sections = sections_at(result.sections, capture);
  result.spacing = spacing_of(sections.centers);
  result.shape.resize(3, muscle.surface.vertex_count());
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Index k = section_of_vertex(v, count, result.rays);
    result.shape.col(v) =
        sections.frames.axes(k).transpose() * (muscle.surface.vertices.col(v) - sections.centers.col(k));
  }
  result.offsets = Points::Zero(3, count);
  for (Index k = 0; k < count && muscle.action_line.centers.cols() > 0; ++k)
    result.offsets.col(k) =
        sections.frames.axes(k).transpose() * (muscle.action_line.centers.col(k) - sections.centers.col(k));
  return result;
}

namespace {

/// Lets tagged sections give way in one pose; each frame anew, so that nothing is carried on.
class Resolution {
 public:
  Resolution(const std::vector<Transversal>& transversals, const std::vector<Bone>& bones,
             const std::vector<TriangleTree>& hits, const Pose& pose, int most_rounds,
             std::vector<CylinderShape>& shapes)
      : transversals_(transversals),
        bones_(bones),
        hits_(hits),
        pose_(pose),
        most_rounds_(most_rounds),
        shapes_(shapes) {
    for (const Transversal& each : transversals) held_.emplace_back(rings_of(each.moved), each.moved.section);
  }

  /// Adds the time to the reports of the muscles that give way, and to all what did not come free.
  void run(std::vector<MuscleReport>& reports) {
    std::vector<int> unresolved(shapes_.size(), 0), rounds(shapes_.size(), 0);
    bool any = true;
    for (int round = 0; round < most_rounds_ && any; ++round) {
      any = false;
      for (std::size_t i = 0; i < transversals_.size(); ++i) {
        const auto muscle = static_cast<std::size_t>(transversals_[i].moved.muscle);
        const auto start = std::chrono::steady_clock::now();
        const bool moved = give_way(transversals_[i], held_[i]);
        const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - start;
        reports[muscle].milliseconds += taken.count();
        if (moved) rounds[muscle] = round + 1;
        any = any || moved;
      }
    }
    // What the last round moved may be free now.
    for (std::size_t i = 0; any && i < transversals_.size(); ++i) {
      const SectionCorner& moved = transversals_[i].moved;
      const SectionRings before = rings_of(moved);
      YieldingSection state = held_[i];
      const bool caught = give_way(transversals_[i], state);
      rings_of(moved) = before;
      if (!caught) continue;
      ++unresolved[static_cast<std::size_t>(moved.muscle)];
      take_back(rings_of(moved), moved.section, held_[i]);
    }
    for (std::size_t muscle = 0; muscle < reports.size(); ++muscle)
      reports[muscle].metrics = {{"collision_rounds", static_cast<Real>(rounds[muscle])},
                                 {"unresolved_transversals", static_cast<Real>(unresolved[muscle])}};
  }

 private:
  SectionRings& rings_of(const SectionCorner& corner) const {
    return shapes_[static_cast<std::size_t>(corner.muscle)].rings;
  }

  bool give_way(const Transversal& each, YieldingSection& state) const {
    SectionRings& rings = rings_of(each.moved);
    bool moved = false;
    std::vector<Obstacle> obstacles;
    if (each.other.muscle >= 0) {
      const SectionRings& other = rings_of(each.other);
      moved = yield_to_transversal(rings, each.moved, transversal_depth(rings, each.moved, other, each.other));
      obstacles.push_back(obstacle_of(other));
    }
    for (const Index bone : each.bones) {
      const Bone& solid = bones_[static_cast<std::size_t>(bone)];
      const RigidTransform back = pose_.bodies[static_cast<std::size_t>(solid.body)].inverse();
      const TriangleTree& tree = hits_[static_cast<std::size_t>(bone)];
      obstacles.push_back([back, &tree](const Vec3& a, const Vec3& b) { return tree.cut(back * a, back * b); });
    }
    const Obstacle any = [&](const Vec3& a, const Vec3& b) {
      return std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& cuts) { return cuts(a, b); });
    };
    if (!yield_to_obstacle(rings, each.moved.section, any, state)) return moved;
    inflate(rings, each.moved.section, state.area, state.fixed);
    return true;
  }

  const std::vector<Transversal>& transversals_;
  const std::vector<Bone>& bones_;
  const std::vector<TriangleTree>& hits_;
  const Pose& pose_;
  int most_rounds_;
  std::vector<CylinderShape>& shapes_;
  std::vector<YieldingSection> held_;
};

class CylinderMethod final : public DeformationMethod {
 public:
  explicit CylinderMethod(const Scene& scene)
      : lines_(scene.muscles),
        transversals_(scene.transversals),
        settings_(with_values(CylinderSettings{}, scene.method.settings)) {
    const Pose capture = capture_pose(scene.bodies.size());
    if (!transversals_.empty()) bones_ = scene.bones;
    for (const Bone& bone : bones_) hits_.emplace_back(bone.surface);
    surfaces_.resize(lines_.size());
    muscles_.resize(lines_.size());
    sheets_.resize(lines_.size());
    parallel_for_each(lines_.size(), [&](std::size_t m) {
      if (!lines_[m].action_line.heads.empty())
        sheets_[m] = sheet_sections(lines_[m], capture);
      else if (lines_[m].action_line.rays > 0)
        muscles_[m] = prepare(capture, lines_[m]);
      else
        surfaces_[m] = surface_sections(lines_[m]);
    });
    for (const Muscle& muscle : lines_) shapes_.push_back(muscle.surface.vertices);
  }

  void reset() override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) shapes_[m] = lines_[m].surface.vertices;
  }

  StepReport advance(const Pose& pose, Real) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<CylinderShape> shapes(muscles_.size());
    std::vector<Points> next(muscles_.size());
    parallel_for(static_cast<Index>(muscles_.size()), 8, [&](Index begin, Index end) {
      for (auto m = static_cast<std::size_t>(begin); m < static_cast<std::size_t>(end); ++m) {
        const auto start = std::chrono::steady_clock::now();
        if (surfaces_[m])
          next[m] = surface_at(*surfaces_[m], pose);
        else
          shapes[m] = sheets_[m] ? shape_at(*sheets_[m], pose) : shape_at(muscles_[m], pose);
        const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - start;
        report.muscles[m].milliseconds = taken.count();
      }
    });
    Resolution(transversals_, bones_, hits_, pose, settings_.transversal_rounds, shapes).run(report.muscles);
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      if (!surfaces_[m]) next[m] = shapes[m].vertices();
      if (!next[m].allFinite()) throw QualityError("muscle " + lines_[m].name + ": a section is not finite");
    }
    shapes_ = std::move(next);
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.resize(muscles_.size());
    for (std::size_t m = 0; m < muscles_.size(); ++m) frame.muscles[m] = {shapes_[m]};
  }

  void restore(const std::vector<Pose>&, const Frame&, const Frame& last) override {
    for (std::size_t m = 0; m < muscles_.size(); ++m) shapes_[m] = last.muscles[m].points;
  }

 private:
  std::vector<Muscle> lines_;  ///< the scene's, which need not outlive this
  std::vector<Transversal> transversals_;
  CylinderSettings settings_;
  std::vector<Bone> bones_;
  std::vector<TriangleTree> hits_;                        ///< of each bone
  std::vector<CylinderMuscle> muscles_;                   ///< with an action line
  std::vector<std::optional<SheetSections>> sheets_;      ///< with those of several heads
  std::vector<std::optional<SurfaceSections>> surfaces_;  ///< without
  std::vector<Points> shapes_;
};

}  // namespace

MethodEntry cylinder_entry() {
  return {.name = "cylinder",
          .meaning = "sections across an action line, or across the middle of a surface, without a solver",
          .settings = describe_settings<CylinderSettings>(),
          .metrics = {{"collision_rounds", 0}, {"unresolved_transversals", 0, "transversals that did not come free"}},
          .make = [](const Scene& scene, const BoneFieldSource&) { return make_cylinder_method(scene); },
          .takes_transversals = true};
}

std::unique_ptr<DeformationMethod> make_cylinder_method(const Scene& scene) {
  return std::make_unique<CylinderMethod>(scene);
}

}  // namespace gracilis
