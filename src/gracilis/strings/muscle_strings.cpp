#include <gracilis/strings/muscle_strings.hpp>

#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace gracilis::strings {

namespace {

/// A fiber bent by less than this per segment (m) rests on nothing.
constexpr Real least_bend = 1e-7;
/// Bodies with less than this share of a node do not carry it.
constexpr Real least_share = 1e-6;

/// The body of the attached vertex next to a fiber's end.
Index body_at(const Muscle& muscle, AttachmentEnd end, const Vec3& place) {
  Index body = 0;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Attachment& attachment : muscle.attachments) {
    if (attachment.end != end) continue;
    for (const Index v : attachment.vertices) {
      const Real distance = (muscle.surface.vertices.col(v) - place).squaredNorm();
      if (distance < nearest) nearest = distance, body = attachment.body;
    }
  }
  return body;
}

/// Sorts lines so that groups of any power of two of them, one after the other, lie together: halves are parted where
/// their middles spread most.
void part_lines(std::vector<std::pair<Vec3, Index>>& lines, std::size_t begin, std::size_t end) {
  if (end - begin < 3) return;
  Eigen::AlignedBox3d box;
  for (std::size_t i = begin; i < end; ++i) box.extend(lines[i].first);
  Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::sort(lines.begin() + static_cast<std::ptrdiff_t>(begin), lines.begin() + static_cast<std::ptrdiff_t>(end),
            [&](const auto& a, const auto& b) {
              return std::tie(a.first[axis], a.second) < std::tie(b.first[axis], b.second);
            });
  const std::size_t half = begin + std::bit_floor(end - begin - 1);
  part_lines(lines, begin, half);
  part_lines(lines, half, end);
}

Polylines side_by_side(const Polylines& fibers) {
  std::vector<std::pair<Vec3, Index>> lines;
  for (Index f = 0; f < fibers.count(); ++f) lines.emplace_back(fibers.line(f).rowwise().mean(), f);
  part_lines(lines, 0, lines.size());
  Polylines sorted;
  for (const auto& [middle, f] : lines) sorted.append(fibers.line(f));
  return sorted;
}

void lay_along_fibers(const Muscle& muscle, const Polylines& fibers, MuscleStrings& result) {
  result.strings = fibers.count();
  result.nodes = result.settings.segments + 1;
  result.fibers.resize(3, result.strings * result.nodes);
  for (Index s = 0; s < result.strings; ++s) {
    const Points line = resampled(fibers.line(s), result.settings.segments);
    result.fibers.middleCols(result.node(s, 0), result.nodes) = line;
    result.lengths.push_back(polyline_length(line));
    result.origin_bodies.push_back(body_at(muscle, AttachmentEnd::origin, line.col(0)));
    result.insertion_bodies.push_back(body_at(muscle, AttachmentEnd::insertion, line.rightCols<1>()));
  }
}

/// The node up to which a line, read from its first column, runs away from `far_end`; 0 where it does not, by `least`.
Index turning_node(const Points& line, const Vec3& far_end, Real least) {
  Index turning = 0;
  Real farthest = (line.col(0) - far_end).norm();
  for (Index i = 1; i < line.cols() / 2; ++i) {
    const Real distance = (line.col(i) - far_end).norm();
    if (distance > farthest + (turning == 0 ? least : 0)) farthest = distance, turning = i;
  }
  return turning;
}

/// Of a part that turns back, what lies near its bone.
Index nodes_near_body(const Points& line, Index turning, Index body, const BoneDistances& bones, Real reach) {
  Index last = 0;
  while (last < turning && distance_to_body(bones, body, line.col(last + 1)) <= reach) ++last;
  return last;
}

/// Harmonic fibers can leave an attachment away from their other end; a taut string would jump there.
void hold_what_turns_back(const BoneDistances& bones, MuscleStrings& result) {
  const StringSettings& settings = result.settings;
  for (Index s = 0; s < result.strings; ++s) {
    const Points line = result.fibers.middleCols(result.node(s, 0), result.nodes);
    const Points reversed = line.rowwise().reverse();
    const auto held = [&](const Points& from, Index body) {
      const Index turning = turning_node(from, from.rightCols<1>(), settings.pinned_least);
      return nodes_near_body(from, turning, body, bones, settings.pinned_reach);
    };
    result.first_held.push_back(held(line, result.origin_bodies[static_cast<std::size_t>(s)]));
    result.last_held.push_back(result.nodes - 1 - held(reversed, result.insertion_bodies[static_cast<std::size_t>(s)]));
  }
}

/// How bodies carry each node, by their distance, and how strongly fascia ties it to where they do.
void share_by_distance(std::size_t bodies, const BoneDistances& bones, MuscleStrings& result) {
  const StringSettings& settings = result.settings;
  const Index count = result.strings * result.nodes;
  result.shares = Eigen::MatrixXd::Zero(static_cast<Index>(bodies), count);
  result.ties.resize(count);
  for (Index p = 0; p < count; ++p) {
    Real nearest = std::numeric_limits<Real>::infinity();
    for (Index b = 0; b < static_cast<Index>(bodies); ++b) {
      const Real distance = std::max(distance_to_body(bones, b, result.fibers.col(p)), Real{0});
      if (!std::isfinite(distance)) continue;
      nearest = std::min(nearest, distance);
      result.shares(b, p) = std::pow(distance + settings.share_offset, -3);
    }
    const Real sum = result.shares.col(p).sum();
    if (sum > 0) result.shares.col(p) /= sum;
    // Without any bone around, the ends' bodies are all there is.
    if (!(sum > 0)) {
      const auto s = static_cast<std::size_t>(p / result.nodes);
      const Real along = static_cast<Real>(p % result.nodes) / static_cast<Real>(result.nodes - 1);
      result.shares(result.origin_bodies[s], p) += 1 - along;
      result.shares(result.insertion_bodies[s], p) += along;
    }
    result.ties[p] = std::max(1 - nearest / settings.tie_reach, Real{0});
  }
  result.shares = (result.shares.array() < least_share).select(0, result.shares);
  for (Index p = 0; p < count; ++p) result.shares.col(p) /= result.shares.col(p).sum();
}

void measure_bone_distances(const BoneDistances& bones, MuscleStrings& result) {
  result.bone_distances.resize(static_cast<Index>(bones.fields.size()), result.fibers.cols());
  for (std::size_t b = 0; b < bones.fields.size(); ++b)
    for (Index p = 0; p < result.fibers.cols(); ++p)
      result.bone_distances(static_cast<Index>(b), p) =
          static_cast<Real>(sample_spline_bounded(bones.fields[b], result.fibers.col(p).cast<float>()).distance);
}

/// Per body with a share in a node: its nearest bone under the support, where the string may slide over it.
std::vector<Slide> slides_under(const MuscleStrings& muscle, const BoneDistances& bones, Index node,
                                const Vec3& normal) {
  std::vector<Slide> slides;
  for (Index body = 0; body < muscle.shares.rows(); ++body) {
    if (!(muscle.shares(body, node) > 0)) continue;
    Slide slide{-1, 0, std::numeric_limits<Real>::infinity()};
    Vec3 gradient = Vec3::Zero();
    for (std::size_t b = 0; b < bones.fields.size(); ++b) {
      if (bones.bodies[b] != body) continue;
      const FieldSample seen = sample_spline(bones.fields[b].grid, muscle.fibers.col(node).cast<float>());
      if (static_cast<Real>(seen.distance) >= slide.distance) continue;
      slide.bone = static_cast<Index>(b), slide.distance = static_cast<Real>(seen.distance);
      gradient = seen.gradient.cast<Real>();
    }
    if (slide.bone < 0 || gradient.norm() < least_slope) continue;
    // Far from a bone its nearest point jumps, and with it what a node would slide over.
    const Real nearness = std::clamp(1 - slide.distance / muscle.settings.support_reach, Real{0}, Real{1});
    slide.share = muscle.shares(body, node) * nearness * gradient.normalized().dot(normal);
    if (slide.share > 0) slides.push_back(slide);
  }
  return slides;
}

/// A taut fiber that is bent rests on something, at the inner side of its bend.
void find_supports(const BoneDistances& bones, MuscleStrings& result) {
  result.supports.assign(static_cast<std::size_t>(result.fibers.cols()), {});
  for (Index s = 0; s < result.strings; ++s)
    for (Index i = 1; i + 1 < result.nodes; ++i) {
      const Index p = result.node(s, i);
      const Vec3 bend = 2 * result.fibers.col(p) - result.fibers.col(p - 1) - result.fibers.col(p + 1);
      if (!(bend.norm() > least_bend)) continue;
      NodeSupport& support = result.supports[static_cast<std::size_t>(p)];
      support.normal = bend.normalized();
      support.slides = slides_under(result, bones, p, support.normal);
    }
}

void find_neighbors(MuscleStrings& result) {
  result.neighbors.resize(static_cast<std::size_t>(result.strings));
  const Index kept = std::min<Index>(result.settings.neighbors, result.strings - 1);
  for (Index s = 0; s < result.strings; ++s) {
    std::vector<std::pair<Real, Index>> others;
    const auto line = [&](Index k) { return result.fibers.middleCols(result.node(k, 0), result.nodes); };
    for (Index other = 0; other < result.strings; ++other)
      if (other != s) others.emplace_back((line(s) - line(other)).colwise().norm().mean(), other);
    std::sort(others.begin(), others.end());
    for (Index k = 0; k < kept; ++k)
      result.neighbors[static_cast<std::size_t>(s)].push_back(others[static_cast<std::size_t>(k)].second);
  }
}

}  // namespace

bool runs_between_bodies(const Muscle& muscle) {
  return std::any_of(muscle.attachments.begin(), muscle.attachments.end(),
                     [&](const Attachment& each) { return each.body != muscle.attachments.front().body; });
}

std::optional<MuscleStrings> muscle_strings(const Scene& scene, const Muscle& muscle, const BoneDistances& bones,
                                            const StringSettings& settings) {
  Muscle fibered = muscle;
  fibered.fibers.count = settings.count;
  fibered.fibers.segments = settings.segments;
  // They will be pulled tight, and begin as the smoothest lines that the surface holds.
  fibered.fibers.smoothing_reach = unlimited_smoothing;
  const Polylines fibers = side_by_side(attached_fibers_of(fibered));
  if (fibers.count() == 0 || !fibers.points.allFinite()) return std::nullopt;
  MuscleStrings result;
  result.settings = settings;
  lay_along_fibers(muscle, fibers, result);
  if (*std::min_element(result.lengths.begin(), result.lengths.end()) <= 0) return std::nullopt;
  hold_what_turns_back(bones, result);
  share_by_distance(scene.bodies.size(), bones, result);
  measure_bone_distances(bones, result);
  find_supports(bones, result);
  find_neighbors(result);
  result.taut = pulled_tight(result, bones);
  result.lanes = string_lanes(result);
  return result;
}

Index body_holding(const MuscleStrings& muscle, Index string, Index i) {
  const auto s = static_cast<std::size_t>(string);
  if (i <= muscle.first_held[s]) return muscle.origin_bodies[s];
  return i >= muscle.last_held[s] ? muscle.insertion_bodies[s] : -1;
}

Vec3 string_direction(const MuscleStrings& muscle, const Points& places, Index string, Index i) {
  const Vec3 along = places.col(muscle.node(string, std::min(i + 1, muscle.nodes - 1))) -
                     places.col(muscle.node(string, std::max(i - 1, Index{0})));
  const Real length = along.norm();
  return length > 0 ? Vec3(along / length) : Vec3(Vec3::UnitZ());
}

}  // namespace gracilis::strings
