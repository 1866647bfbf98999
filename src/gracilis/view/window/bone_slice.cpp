#include <gracilis/view/window/bone_slice.hpp>

#include <gracilis/core/parallel.hpp>

#include <cmath>

namespace gracilis {

static constexpr Real spacing = 0.0015;    // m, between the plane's points
static constexpr Real outline = 0.0006;    // m, half as thick as the line that marks the surface
static constexpr Index most_points = 300;  // along one side

const ColorScale& slice_scale() {
  static const ColorScale scale = [] {
    ColorScale result = color_scale(ColorBy::edge_stretch);
    result.name = "bone-distance";
    result.title = "distance to bone, mm";
    std::reverse(result.colors.begin(), result.colors.end());
    result.low = -0.012;
    result.high = 0.012;
    result.ticks = {"≤ -12", "0", "12"};
    return result;
  }();
  return scale;
}

/// Everything that is shown, along the anatomical axes: right, anterior, superior.
static Eigen::AlignedBox3d box_along(const Eigen::Matrix3d& axes, const ShownShapes& shapes, const ShownFrame& frame) {
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < shapes.bones.size(); ++b)
    for (const auto& point : shapes.bone_points[b].colwise())
      box.extend(axes.transpose() * (frame.bones[b] * Vec3(point.cast<Real>())));
  return box;
}

/// The distance to the nearest bone; infinity where no field reaches.
static Real distance_at(const Vec3& point, const std::vector<RigidTransform>& to_rest,
                        const std::vector<FieldGrid>& grids) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < grids.size(); ++b)
    nearest = std::min<Real>(nearest, sample(grids[b], (to_rest[b] * point).cast<float>()).distance);
  return nearest;
}

ColoredMesh bone_slice(const ShownShapes& shapes, const ShownFrame& frame, const std::vector<DistanceField>& fields,
                       Slice plane, Real at) {
  ColoredMesh mesh;
  if (plane == Slice::none || fields.empty()) return mesh;
  Eigen::Matrix3d axes;
  axes << shapes.axes.right(), shapes.axes.anterior, shapes.axes.superior;
  const Eigen::AlignedBox3d box = box_along(axes, shapes, frame);
  const int across = plane == Slice::sagittal ? 0 : plane == Slice::coronal ? 1 : 2;
  const int u = (across + 1) % 3, v = (across + 2) % 3;
  const Vec3 size = box.sizes();
  const Real step = std::max({spacing, size[u] / most_points, size[v] / most_points});
  const Index columns = static_cast<Index>(size[u] / step) + 2, rows = static_cast<Index>(size[v] / step) + 2;

  std::vector<RigidTransform> to_rest;
  std::vector<FieldGrid> grids;
  for (std::size_t b = 0; b < fields.size(); ++b) {
    to_rest.push_back(frame.bones[b].inverse());
    grids.push_back(grid_of(fields[b]));
  }
  std::vector<Real> distances(static_cast<std::size_t>(columns * rows));
  mesh.points.resize(distances.size());
  mesh.colors.resize(distances.size());
  parallel_for(rows, 8, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index column = 0; column < columns; ++column) {
        Vec3 place = box.min();
        place[across] += at * size[across];
        place[u] += step * static_cast<Real>(column);
        place[v] += step * static_cast<Real>(row);
        const Vec3 point = axes * place;
        const auto i = static_cast<std::size_t>(row * columns + column);
        distances[i] = distance_at(point, to_rest, grids);
        mesh.points[i] = point.cast<float>();
        mesh.colors[i] =
            std::abs(distances[i]) < outline ? Color(Color::Constant(0.1)) : color_at(slice_scale(), distances[i]);
      }
  });
  const auto is_near = [&](Index i) { return distances[static_cast<std::size_t>(i)] < slice_scale().high; };
  for (Index row = 0; row + 1 < rows; ++row)
    for (Index column = 0; column + 1 < columns; ++column) {
      const auto i = static_cast<int>(row * columns + column);
      const int right = i + 1, above = i + static_cast<int>(columns), opposite = above + 1;
      if (!is_near(i) || !is_near(right) || !is_near(above) || !is_near(opposite)) continue;
      mesh.faces.emplace_back(i, right, opposite);
      mesh.faces.emplace_back(i, opposite, above);
    }
  return mesh;
}

}  // namespace gracilis
