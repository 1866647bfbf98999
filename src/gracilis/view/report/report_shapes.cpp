#include <gracilis/view/report/report_shapes.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/simulate/attachment_zone.hpp>
#include <gracilis/simulate/surface_flaws.hpp>
#include <gracilis/view/pictures/recorded_look.hpp>
#include <gracilis/view/pictures/vertex_stretch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gracilis {

using Json = nlohmann::ordered_json;

static constexpr int most_frames = 120;              // shown; the view blends between them
static constexpr Index most_muscle_vertices = 4000;  // what one sees no longer, a file need not hold
static constexpr Index fewest_muscle_vertices = 100;
static constexpr Index most_bone_vertices = 4000;
static constexpr int most_fibers = 32, fewest_fibers = 4;        // per muscle
static constexpr std::size_t vertex_bytes = 8, look_bytes = 15;  // of a muscle: in each frame; once, with its two faces

/// Appends an array and returns where it begins.
template <class Number>
static std::size_t append(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  const std::size_t at = bytes.size();
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  return at;
}

static Json components(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

static std::uint8_t log_ratio_byte(Real ratio) {
  if (!(ratio > 0)) return 128;
  return static_cast<std::uint8_t>(std::clamp(std::lround(128 + 126 * std::log2(ratio)), 0L, 255L));
}

/// 200 is at the bar.
static std::uint8_t share_byte(Real share) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(200 * std::max(share, Real{0})), 0L, 255L));
}

/// Points of all frames as 16 bits per coordinate within their common box, which goes into `description`.
static void append_points(const std::vector<Points>& frames, Json& description, std::string& bytes) {
  Eigen::AlignedBox3d box;
  for (const Points& points : frames) {
    if (points.cols() == 0) continue;
    box.extend(Vec3(points.rowwise().minCoeff()));
    box.extend(Vec3(points.rowwise().maxCoeff()));
  }
  const Vec3 low = box.isEmpty() ? Vec3::Zero() : box.min();
  const Vec3 size = box.isEmpty() ? Vec3::Ones() : Vec3(box.sizes().cwiseMax(1e-9));
  std::vector<std::uint16_t> numbers;
  for (const Points& points : frames)
    for (const Vec3 point : points.colwise())
      for (int k = 0; k < 3; ++k)
        numbers.push_back(static_cast<std::uint16_t>(std::lround(65535 * (point[k] - low[k]) / size[k])));
  description["low"] = components(low);
  description["size"] = components(size);
  description["points_at"] = append(bytes, numbers);
}

static void append_faces(const Eigen::Matrix3Xi& faces, Json& description, std::string& bytes) {
  std::vector<std::uint16_t> numbers;
  for (const int index : faces.reshaped()) numbers.push_back(static_cast<std::uint16_t>(index));
  description["faces"] = faces.cols();
  description["faces_at"] = append(bytes, numbers);
}

/// What it looks like; the same in all frames.
static void append_look(const MuscleLook& look, const std::vector<Index>& vertices, Json& surface, std::string& bytes) {
  std::vector<Real> places;
  std::vector<std::uint8_t> tendon;
  for (const Index v : vertices) {
    places.push_back(look.stripes[static_cast<std::size_t>(v)] / stripe_width);
    tendon.push_back(static_cast<std::uint8_t>(std::lround(255 * look.tendon[static_cast<std::size_t>(v)])));
  }
  const auto [least, most] = std::minmax_element(places.begin(), places.end());
  const Real low = *least, range = std::max(*most - low, 1e-9);
  std::vector<std::uint16_t> stripes;
  for (const Real place : places)
    stripes.push_back(static_cast<std::uint16_t>(std::lround(65535 * (place - low) / range)));
  surface["belly"] = components(fiber_paint(surface["name"].get<std::string>()));
  surface["tendon"] = components(tendon_paint());
  surface["tendon_at"] = append(bytes, tendon);
  surface["stripes"] = {low, range};
  surface["stripes_at"] = append(bytes, stripes);
}

static std::size_t append_brightness(std::string& bytes) {
  std::vector<std::uint8_t> brightness;
  for (const Real bright : stripe_brightness(512))
    brightness.push_back(static_cast<std::uint8_t>(std::lround(255 * bright)));
  return append(bytes, brightness);
}

/// Vertices of a muscle that the gates take for near an attachment. Runs of before they told their attachments have
/// none of their own, and the looser bar everywhere.
static std::vector<char> judged_as_near(const RecordedRun& run, const std::string& name, const Points& rest) {
  const Points tissue = recorded_tissue(run, name);
  if (tissue.cols() != rest.cols()) return std::vector<char>(static_cast<std::size_t>(rest.cols()), 1);
  std::vector<Index> attached;
  for (Index v = 0; v < tissue.cols(); ++v)
    if (tissue(0, v) > 0 || tissue(1, v) > 0) attached.push_back(v);
  return near_attachments(rest, attached);
}

/// Which of the vertices that stay is nearest, for every vertex.
static std::vector<std::size_t> nearest_that_stays(const Points& rest, const std::vector<Index>& vertices) {
  const NearestPoints stay(rest(Eigen::all, vertices));
  std::vector<std::size_t> nearest(static_cast<std::size_t>(rest.cols()));
  for (Index v = 0; v < rest.cols(); ++v)
    nearest[static_cast<std::size_t>(v)] = static_cast<std::size_t>(stay.nearest(rest.col(v)));
  return nearest;
}

static Json muscle_surface(const RecordedRun& run, const std::string& name, const std::vector<int>& frames,
                           Index most_vertices, std::string& bytes) {
  const TriangleMesh rest = placed_surface(run, name, 0);
  const CoarseSurface coarse = decimate(rest, most_vertices);
  const std::vector<char> near = judged_as_near(run, name, rest.vertices);
  const std::vector<std::size_t> stands_for = nearest_that_stays(rest.vertices, coarse.vertices);
  const VertexStretch stretch_around(rest);
  std::vector<Points> points(frames.size());
  const SurfaceFlaws flaws(rest);
  std::vector<std::uint8_t> stretch(frames.size() * coarse.vertices.size()), shape(stretch.size());
  parallel_for(static_cast<Index>(frames.size()), 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const std::size_t at = k * coarse.vertices.size();
      const Points now = placed_surface(run, name, frames[k]).vertices;
      points[k] = picked(now, coarse.vertices);
      const std::vector<Real> all = stretch_around.of(now), shares = flaws.shares_of_gates(now, near, {});
      for (std::size_t v = 0; v < coarse.vertices.size(); ++v)
        stretch[at + v] = log_ratio_byte(all[static_cast<std::size_t>(coarse.vertices[v])]);
      // A flaw of a vertex that is not shown is seen at the one that stands for it.
      for (std::size_t v = 0; v < shares.size(); ++v)
        shape[at + stands_for[v]] = std::max(shape[at + stands_for[v]], share_byte(shares[v]));
    }
  });
  Json surface = {{"name", name}, {"kind", "muscle"}, {"vertices", coarse.vertices.size()}};
  append_faces(coarse.faces, surface, bytes);
  append_points(points, surface, bytes);
  surface["stretch_at"] = append(bytes, stretch);
  surface["shape_at"] = append(bytes, shape);
  append_look(recorded_look(run, name), coarse.vertices, surface, bytes);
  return surface;
}

static Json bone_surface(const RecordedRun& run, const std::string& name, const std::vector<int>& frames,
                         Index most_vertices, std::string& bytes) {
  const TriangleMesh rest = placed_surface(run, name, 0);
  const CoarseSurface coarse = decimate(rest, most_vertices);
  std::vector<float> motions(7 * frames.size());
  parallel_for(static_cast<Index>(frames.size()), 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Points now = placed_surface(run, name, frames[static_cast<std::size_t>(i)]).vertices;
      const RigidTransform motion = rigid_motion(rest.vertices, now);
      const Eigen::Quaternionf turn(motion.linear().cast<float>());
      const Eigen::Vector3f shift = motion.translation().cast<float>();
      Eigen::Map<Eigen::Vector<float, 7>>(motions.data() + 7 * i) << turn.coeffs(), shift;
    }
  });
  Json surface = {{"name", name}, {"kind", "bone"}, {"vertices", coarse.vertices.size()}};
  append_faces(coarse.faces, surface, bytes);
  append_points({picked(rest.vertices, coarse.vertices)}, surface, bytes);
  surface["motion_at"] = append(bytes, motions);
  return surface;
}

/// Null where the run has no fibers of this muscle, or not the same number in every frame.
static Json muscle_fibers(const RecordedRun& run, const std::string& name, const std::vector<int>& frames,
                          Index fibers_shown, std::string& bytes) {
  const Polylines rest = spread_lines(placed_fibers(run, name, 0), fibers_shown);
  if (rest.count() == 0) return nullptr;
  const std::vector<Real> rest_lengths = polyline_lengths(rest);
  std::vector<Points> points;
  std::vector<std::uint8_t> strain;
  for (const int frame : frames) {
    const Polylines now = spread_lines(placed_fibers(run, name, frame), fibers_shown);
    if (now.offsets != rest.offsets) return nullptr;
    points.push_back(now.points);
    const std::vector<Real> lengths = polyline_lengths(now);
    for (std::size_t i = 0; i < lengths.size(); ++i)
      strain.push_back(log_ratio_byte(rest_lengths[i] > 0 ? lengths[i] / rest_lengths[i] : 1));
  }
  Json fibers = {{"muscle", name}, {"sizes", Json::array()}};
  for (Index i = 0; i < rest.count(); ++i) fibers["sizes"].push_back(rest.size(i));
  append_points(points, fibers, bytes);
  fibers["strain_at"] = append(bytes, strain);
  return fibers;
}

/// What is left out of a run so that it fits.
struct ShownParts {
  std::vector<int> frames;
  Index fibers = 0;  ///< per muscle
};

/// As many frames as have room with the fewest vertices and fibers; then as many fibers as take a quarter.
static ShownParts shown_parts(const RecordedRun& run, std::size_t budget) {
  std::size_t fibers = 0, points = 0;
  for (const std::string& muscle : run.muscles) {
    const Polylines rest = placed_fibers(run, muscle, 0);
    fibers += static_cast<std::size_t>(rest.count()), points += static_cast<std::size_t>(rest.points.cols());
  }
  const Real muscles = static_cast<Real>(std::max<std::size_t>(run.muscles.size(), 1));
  const Real fiber_bytes = fibers == 0 ? 0 : 6.0 * static_cast<Real>(points) / static_cast<Real>(fibers) + 1;
  const Real fewest = muscles * (vertex_bytes * fewest_muscle_vertices + fewest_fibers * fiber_bytes);
  const Real room = static_cast<Real>(budget) - muscles * look_bytes * fewest_muscle_vertices;
  ShownParts parts;
  parts.frames = spread_frames(run.frame_count, static_cast<int>(std::clamp(room / fewest, 2.0, Real{most_frames})));
  const Real of_a_fiber = std::max(1.0, static_cast<Real>(parts.frames.size()) * muscles * fiber_bytes);
  parts.fibers = static_cast<Index>(std::clamp(room / 4 / of_a_fiber, Real{fewest_fibers}, Real{most_fibers}));
  return parts;
}

ReportShapes report_shapes(const RecordedRun& run, std::size_t budget) {
  ReportShapes shapes;
  Json surfaces = Json::array(), fibers = Json::array();
  const Index bone_vertices = std::min<Index>(
      most_bone_vertices, static_cast<Index>(budget / 4 / 18 / std::max<std::size_t>(run.bones.size(), 1)));
  const auto [frames, fibers_shown] = shown_parts(run, budget / 4 * 3);
  for (const std::string& bone : run.bones)
    surfaces.push_back(bone_surface(run, bone, frames, bone_vertices, shapes.bytes));
  for (const std::string& muscle : run.muscles) {
    const Json lines = muscle_fibers(run, muscle, frames, fibers_shown, shapes.bytes);
    if (!lines.is_null()) fibers.push_back(lines);
  }
  const std::size_t brightness_at = append_brightness(shapes.bytes);
  // What is left is for the muscles: for each what those before it, some of which cannot be thinned further, have left.
  const std::size_t per_vertex = vertex_bytes * frames.size() + look_bytes;
  for (std::size_t m = 0; m < run.muscles.size(); ++m) {
    const std::size_t left = budget > shapes.bytes.size() ? budget - shapes.bytes.size() : 0;
    const auto vertices = static_cast<Index>(left / (run.muscles.size() - m) / per_vertex);
    surfaces.push_back(muscle_surface(
        run, run.muscles[m], frames, std::clamp(vertices, fewest_muscle_vertices, most_muscle_vertices), shapes.bytes));
  }
  shapes.description = {
      {"frames", frames}, {"surfaces", surfaces}, {"fibers", fibers}, {"brightness_at", brightness_at}};
  return shapes;
}

}  // namespace gracilis
