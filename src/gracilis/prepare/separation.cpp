#include <gracilis/prepare/separation.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <memory>

namespace gracilis {
namespace {

constexpr Real reach = 0.010;          ///< m; deeper overlaps need several looks
constexpr Real look_ahead = 0.002;     ///< m beyond the gap; what is farther away is not watched until the next look
constexpr int look_every = 8;          ///< rounds
constexpr Real longest_step = 0.0005;  ///< m per round, less than any triangle is wide
constexpr Real smoothing = 0.5;

/// A vertex (count 1), the middle of an edge (2) or of a face (3).
struct Sample {
  std::array<Index, 3> vertices;
  int count;
};

/// A sample and a surface it may come close to.
struct Watch {
  Index sample, other;
};

struct Body {
  TriangleMesh* mesh;
  Points start;  ///< before separation
  VertexStars stars;
  std::vector<Sample> samples;
  std::vector<Watch> watches;
  Real lacked = 0;  ///< m by which its worst gap was missed before
  std::optional<std::vector<Index>> apart_from = {};
  Real at_most = -1;  ///< m that a vertex may move; below 0: a multiple of that
};

Vec3 place_of(const Body& body, const Sample& sample) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < sample.count; ++k) p += body.mesh->vertices.col(sample.vertices[k]);
  return p / sample.count;
}

Body make_body(TriangleMesh& mesh) {
  Body body{&mesh, mesh.vertices, {}, {}, {}};
  MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) body.samples.push_back({{v, v, v}, 1});
  for (const MeshEdge& e : topology.edges) body.samples.push_back({{e.a, e.b, e.b}, 2});
  for (Index f = 0; f < mesh.face_count(); ++f)
    body.samples.push_back({{mesh.faces(0, f), mesh.faces(1, f), mesh.faces(2, f)}, 3});
  body.stars = std::move(topology.stars);
  return body;
}

/// Every vector half of the way to the mean of its neighbors.
void smooth_field(Points& field, const VertexStars& stars) {
  const Points before = field;
  for (Index v = 0; v < field.cols(); ++v) {
    const Index begin = stars.offsets[static_cast<std::size_t>(v)],
                end = stars.offsets[static_cast<std::size_t>(v) + 1];
    Vec3 mean = Vec3::Zero();
    for (Index i = begin; i < end; ++i) mean += before.col(stars.neighbors[static_cast<std::size_t>(i)]);
    if (end > begin) field.col(v) += smoothing * (mean / (end - begin) - before.col(v));
  }
}

class Separation {
 public:
  Separation(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones,
             const SeparationSettings& settings)
      : settings_(settings) {
    for (TriangleMesh& muscle : muscles) bodies_.push_back(make_body(muscle));
    moved_.assign(bodies_.size(), true);
    for (const TriangleMesh& bone : bones) bones_.push_back(std::make_unique<SignedDistance>(bone));
    muscles_.resize(bodies_.size());
    for (std::size_t m = 0; m < settings.at_most.size(); ++m) bodies_[m].at_most = settings.at_most[m];
    for (std::size_t m = 0; m < settings.apart_from.size(); ++m) bodies_[m].apart_from = settings.apart_from[m];
  }

  SeparationResult run(const TimeLimit& limit) {
    SeparationResult result;
    for (int round = 0;; ++round) {
      limit.check();
      for (std::size_t m = 0; m < bodies_.size(); ++m)
        if (round == 0 || moved_[m]) muscles_[m] = std::make_unique<SignedDistance>(*bodies_[m].mesh);
      if (round % look_every == 0) look();
      const std::vector<Points> pushes = push(result, round == 0);
      result.rounds = round;
      if ((result.missed == 0 && round % look_every == 0) || round >= settings_.rounds) break;
      const bool smooth = round < settings_.smooth_rounds;
      for (std::size_t m = 0; m < bodies_.size(); ++m) move(bodies_[m], pushes[m], smooth);
    }
    for (const Body& body : bodies_) {
      result.lacked.push_back(body.lacked);
      const Points moved = body.mesh->vertices - body.start;
      result.moved.push_back(moved.size() == 0 ? 0 : moved.colwise().norm().maxCoeff());
    }
    return result;
  }

 private:
  std::size_t surface_count() const { return bodies_.size() + bones_.size(); }
  bool is_muscle(Index surface) const { return static_cast<std::size_t>(surface) < bodies_.size(); }
  /// Whether a surface, perhaps of a bone, moves out of another one.
  bool gives_way(Index surface, Index other) const {
    if (!is_muscle(surface)) return false;
    const std::optional<std::vector<Index>>& all = bodies_[static_cast<std::size_t>(surface)].apart_from;
    return !all || std::find(all->begin(), all->end(), other) != all->end();
  }
  const SignedDistance& distance_to(Index surface) const {
    const auto s = static_cast<std::size_t>(surface);
    return is_muscle(surface) ? *muscles_[s] : *bones_[s - bodies_.size()];
  }
  Real gap(Index surface) const { return is_muscle(surface) ? settings_.muscle_gap : settings_.bone_gap; }

  /// Lists what is close to what.
  void look() {
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      Body& body = bodies_[m];
      std::vector<std::vector<Watch>> found(body.samples.size());
      parallel_for(static_cast<Index>(body.samples.size()), 512, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
          const Vec3 p = place_of(body, body.samples[static_cast<std::size_t>(s)]);
          for (Index other = 0; other < static_cast<Index>(surface_count()); ++other) {
            if (static_cast<std::size_t>(other) == m || !gives_way(static_cast<Index>(m), other)) continue;
            const SignedDistance::Answer answer = distance_to(other).query(p, reach);
            if (answer.nearest.face >= 0 && answer.distance < gap(other) + look_ahead)
              found[static_cast<std::size_t>(s)].push_back({s, other});
          }
        }
      });
      body.watches.clear();
      for (const auto& some : found) body.watches.insert(body.watches.end(), some.begin(), some.end());
    }
  }

  /// The displacement that each vertex is asked for, and how far the worst sample is from its gap.
  std::vector<Points> push(SeparationResult& result, bool at_first) {
    result.missed = 0, result.shortfall = 0;
    std::vector<Points> pushes;
    for (Body& body : bodies_) {
      std::vector<Vec3> asked(body.watches.size(), Vec3::Zero());
      parallel_for(static_cast<Index>(body.watches.size()), 512, [&](Index begin, Index end) {
        for (Index w = begin; w < end; ++w)
          asked[static_cast<std::size_t>(w)] = push_of(body, body.watches[static_cast<std::size_t>(w)]);
      });
      Points sum = Points::Zero(3, body.mesh->vertex_count());
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(body.mesh->vertex_count());
      for (std::size_t w = 0; w < asked.size(); ++w) {
        const Real size = asked[w].norm();
        if (size == 0) continue;
        result.shortfall = std::max(result.shortfall, size);
        if (at_first) body.lacked = std::max(body.lacked, size);
        if (size > settings_.tolerance) ++result.missed;
        const Sample& sample = body.samples[static_cast<std::size_t>(body.watches[w].sample)];
        // A muscle moves halfway where the other does as much. Stronger demands count more, so that they are met soon.
        const auto m = static_cast<Index>(&body - bodies_.data());
        const Real share = gives_way(body.watches[w].other, m) ? 0.5 : 1;
        for (int k = 0; k < sample.count; ++k) {
          sum.col(sample.vertices[k]) += share * size * asked[w];
          weight[sample.vertices[k]] += size;
        }
      }
      for (Index v = 0; v < sum.cols(); ++v)
        if (weight[v] > 0) {
          sum.col(v) /= weight[v];
          const Real length = sum.col(v).norm();
          if (length > longest_step) sum.col(v) *= longest_step / length;
        }
      pushes.push_back(std::move(sum));
    }
    return pushes;
  }

  Vec3 push_of(const Body& body, const Watch& watch) const {
    const Vec3 p = place_of(body, body.samples[static_cast<std::size_t>(watch.sample)]);
    const SignedDistance::Answer answer = distance_to(watch.other).query(p, reach);
    // A little more than the gap, so that rounding does not undo it.
    const Real lack = gap(watch.other) + settings_.tolerance / 2 - answer.distance;
    if (answer.nearest.face < 0 || lack <= settings_.tolerance / 2 || answer.nearest.distance < 1e-9)
      return Vec3::Zero();
    const Vec3 away = (p - answer.nearest.point) / answer.distance;  // the sign turns it where p is inside
    return lack * away;
  }

  void move(Body& body, const Points& push, bool smooth) {
    const auto m = static_cast<std::size_t>(&body - bodies_.data());
    moved_[m] = !push.isZero(0);
    Points displacement = body.mesh->vertices + push - body.start;
    if (smooth && !displacement.isZero(0)) {
      smooth_field(displacement, body.stars);
      moved_[m] = true;
    }
    if (!moved_[m]) return;
    const Real farthest = body.at_most >= 0 ? body.at_most : settings_.farthest * body.lacked;
    for (Index v = 0; v < displacement.cols(); ++v) {
      const Real length = displacement.col(v).norm();
      if (length > farthest) displacement.col(v) *= farthest / length;
    }
    body.mesh->vertices = body.start + displacement;
  }

  const SeparationSettings& settings_;
  std::vector<Body> bodies_;
  std::vector<std::unique_ptr<SignedDistance>> muscles_, bones_;
  std::vector<bool> moved_;
};

}  // namespace

SeparationResult separate(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones,
                          const SeparationSettings& settings, const TimeLimit& limit) {
  return Separation(muscles, bones, settings).run(limit);
}

}  // namespace gracilis
