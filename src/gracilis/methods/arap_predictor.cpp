#include <gracilis/methods/arap_predictor.hpp>

#include <gracilis/geometry/arap_volume.hpp>
#include <gracilis/geometry/measures.hpp>

#include <utility>

namespace gracilis {

constexpr int arap_predictor_rounds = 4;

ArapPredictor::ArapPredictor(const TriangleMesh& rest, const MeshTopology& topology, std::vector<char> held)
    : held_(std::move(held)),
      faces_(rest.faces),
      volume_(enclosed_volume(rest.vertices, rest.faces)),
      surface_(rest, topology, held_) {}

void ArapPredictor::bring_nearer(const std::function<void(Points&)>& push_out, Points& points) const {
  for (int round = 0; round < arap_predictor_rounds; ++round) {
    surface_.place(surface_.best_rotations(points), points);
    arap::restore_volume_by_multiplier(surface_, faces_, held_, volume_, points);
    push_out(points);
  }
}

}  // namespace gracilis
