#include <gracilis/prepare/following.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/prepare/cut_and_fill.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace gracilis {
namespace {

constexpr int most_rounds = 5;
constexpr std::ptrdiff_t most_spread = 2;  ///< from round to round, triangles being divided; more is a tangle

/// The edge's middle, made where there is none yet.
class Middles {
 public:
  explicit Middles(const TriangleMesh& mesh) : next_(mesh.vertex_count()) {}
  void make(Index a, Index b) {
    if (of_.try_emplace(std::minmax(a, b), next_).second) ++next_;
  }
  Index at(Index a, Index b) const {
    const auto found = of_.find(std::minmax(a, b));
    return found == of_.end() ? -1 : found->second;
  }
  const std::map<std::pair<Index, Index>, Index>& all() const { return of_; }

 private:
  Index next_;
  std::map<std::pair<Index, Index>, Index> of_;
};

/// Adds what becomes of a face whose edges have these middles, -1 where they have none.
void add_divided(const Eigen::Vector3i& face, std::array<Index, 3> middle, std::vector<Eigen::Vector3i>& faces) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](Index m) { return m >= 0; });
  // Turned so that what is there comes first.
  int first = 0;
  while (count > 0 && count < 3 && !(middle[first] >= 0 && middle[(first + 2) % 3] < 0)) ++first;
  const Index a = face[first], b = face[(first + 1) % 3], c = face[(first + 2) % 3];
  const Index ab = middle[first], bc = middle[(first + 1) % 3], ca = middle[(first + 2) % 3];
  if (count == 0) faces.emplace_back(face);
  if (count == 1) faces.insert(faces.end(), {{a, ab, c}, {ab, b, c}});
  if (count == 2) faces.insert(faces.end(), {{a, ab, c}, {ab, bc, c}, {ab, b, bc}});
  if (count == 3) faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
}

/// Every edge of the chosen faces in two.
void divide(TriangleMesh& mesh, const std::vector<char>& chosen) {
  Middles middles(mesh);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3 && chosen[static_cast<std::size_t>(f)]; ++k)
      middles.make(mesh.faces(k, f), mesh.faces((k + 1) % 3, f));
  std::vector<Eigen::Vector3i> faces;
  for (const Eigen::Vector3i face : mesh.faces.colwise())
    add_divided(face, {middles.at(face[0], face[1]), middles.at(face[1], face[2]), middles.at(face[2], face[0])},
                faces);
  const Index before = mesh.vertex_count();
  mesh.vertices.conservativeResize(3, before + static_cast<Index>(middles.all().size()));
  for (const auto& [edge, vertex] : middles.all())
    mesh.vertices.col(vertex) = (mesh.vertices.col(edge.first) + mesh.vertices.col(edge.second)) / 2;
  mesh.faces.resize(3, static_cast<Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f) mesh.faces.col(static_cast<Index>(f)) = faces[f];
}

}  // namespace

bool follow_where_cut(TriangleMesh& mesh, const TriangleMesh& surface, const TimeLimit& limit) {
  const NearestTriangle nearest(surface);
  std::ptrdiff_t last = mesh.face_count();
  for (int round = 0;; ++round) {
    limit.check();
    std::vector<char> bad = faces_that_cut(mesh, limit);
    const std::ptrdiff_t count = std::count(bad.begin(), bad.end(), 1);
    if (count == 0) return is_solid(mesh);
    if (round == most_rounds || count > most_spread * last) return false;
    last = count;
    widen(mesh, bad);
    const Index old = mesh.vertex_count();
    std::vector<char> moves(static_cast<std::size_t>(old), 0);
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (const Index v : mesh.faces.col(f))
        if (bad[static_cast<std::size_t>(f)]) moves[static_cast<std::size_t>(v)] = 1;
    divide(mesh, bad);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (v >= old || moves[static_cast<std::size_t>(v)])
        mesh.vertices.col(v) = nearest.query(mesh.vertices.col(v)).point;
  }
}

}  // namespace gracilis
