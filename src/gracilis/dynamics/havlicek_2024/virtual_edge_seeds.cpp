#include <gracilis/dynamics/havlicek_2024/virtual_edge_seeds.hpp>

#include <gracilis/core/parallel.hpp>

#include <Eigen/Geometry>
#include <nanoflann.hpp>

#include <algorithm>
#include <deque>
#include <memory>
#include <numeric>

namespace gracilis {

namespace {

/// Queries per task.
constexpr Index queries_per_task = 512;

using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The particles of a surface, to be asked for the nearest. Stays where it is made: the tree refers to the rows.
struct Cloud {
  using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Rows, 3>;
  Rows rows;
  Eigen::AlignedBox3f box;
  std::unique_ptr<Tree> tree;

  explicit Cloud(const Particles& particles) : rows(particles.count(), 3) {
    for (Index p = 0; p < particles.count(); ++p) {
      rows.row(p) = particles.position(p).transpose();
      box.extend(Eigen::Vector3f(particles.position(p)));
    }
    tree = std::make_unique<Tree>(3, std::cref(rows));
  }
  Cloud(const Cloud&) = delete;
  Cloud& operator=(const Cloud&) = delete;

  /// -1 when there is none within reach.
  Index nearest(const Eigen::Vector3f& p, float reach) const {
    if (!(box.squaredExteriorDistance(p) <= reach * reach)) return -1;
    Eigen::Index found = -1;
    float distance2 = 0;
    tree->query(p.data(), 1, &found, &distance2);
    return distance2 <= reach * reach ? static_cast<Index>(found) : -1;
  }
};

void seed_pair(const VirtualEdgePair& pair, float reach, const Particles& first, const Cloud& second,
               std::vector<PairEdges::Edge>& edges) {
  std::vector<Index> nearest(static_cast<std::size_t>(first.count()));
  parallel_for(first.count(), queries_per_task, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p)
      nearest[static_cast<std::size_t>(p)] = second.nearest(first.position(p) + pair.shift, reach);
  });
  edges.clear();
  for (Index p = 0; p < first.count(); ++p) {
    const VirtualEdge edge{p, nearest[static_cast<std::size_t>(p)]};
    if (edge.b >= 0) edges.push_back({edge, edge, 0});
  }
}

/// Which edges stand where one before them stands already.
std::vector<char> coinciding(const std::vector<PairEdges::Edge>& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return edges[i].now < edges[j].now; });
  std::vector<char> repeated(edges.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i) repeated[order[i]] = edges[order[i]].now == edges[order[i - 1]].now;
  return repeated;
}

void drop(const std::vector<char>& repeated, std::vector<PairEdges::Edge>& edges) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!repeated[i]) edges[kept++] = edges[i];
  edges.resize(kept);
}

/// Lets them begin again between ends of two seeds chosen at random. The generator's numbers are the standard's, the
/// same everywhere.
void reseed(const std::vector<char>& repeated, PairEdges& pair) {
  std::vector<PairEdges::Edge>& edges = pair.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!repeated[i]) continue;
    const Index a = edges[pair.random() % edges.size()].seed.a, b = edges[pair.random() % edges.size()].seed.b;
    edges[i].seed = edges[i].now = {a, b};
  }
}

}  // namespace

VirtualEdgeState make_virtual_edge_state(const VirtualEdgeWorld& world) {
  VirtualEdgeState state;
  state.pairs.resize(world.pairs.size());
  for (std::size_t i = 0; i < state.pairs.size(); ++i)
    state.pairs[i].random.seed(static_cast<std::minstd_rand::result_type>(i + 1));
  return state;
}

void begin_edge_frame(const VirtualEdgeWorld& world, const std::vector<const Particles*>& particles,
                      VirtualEdgeState& state) {
  if (world.pairs.empty() || state.frames++ % world.settings.update_period != 0) return;
  std::deque<Cloud> clouds;
  for (const Particles* each : particles) clouds.emplace_back(*each);
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const VirtualEdgePair& pair = world.pairs[i];
    seed_pair(pair, world.settings.reach, *particles[static_cast<std::size_t>(pair.first)],
              clouds[static_cast<std::size_t>(pair.second)], state.pairs[i].edges);
  }
}

void end_edge_frame(const VirtualEdgeWorld& world, VirtualEdgeState& state) {
  for (PairEdges& pair : state.pairs) {
    const std::vector<char> repeated = coinciding(pair.edges);
    pair.coinciding = static_cast<Index>(std::count(repeated.begin(), repeated.end(), 1));
    if (world.settings.coinciding == CoincidingEdgeRule::drop) drop(repeated, pair.edges);
    if (world.settings.coinciding == CoincidingEdgeRule::reseed) reseed(repeated, pair);
  }
}

}  // namespace gracilis
