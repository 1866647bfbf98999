// What JavaScript calls. One scene, the built-in hip or one that the page brings along; numbers come and go through
// buffers of this program's memory.
#include "live_scene.hpp"

#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/io/scene/scene_bytes.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace {

std::unique_ptr<gracilis::LiveScene> scene;
std::string text;

}  // namespace

extern "C" {

void prepare() { scene = std::make_unique<gracilis::LiveScene>(gracilis::builtin_hip()); }

/// As `prepare`, of scene_bytes.
void prepare_scene(const char* bytes, int size) {
  scene = std::make_unique<gracilis::LiveScene>(gracilis::scene_of_bytes({bytes, bytes + size}));
}

/// JSON, which ends with a zero. Addresses hold until the next call of anything.
const char* description() {
  text = scene->description();
  return text.c_str();
}

void choose(int choice) { scene->choose(static_cast<std::size_t>(choice)); }

void advance(const double* coordinates, const double* activations) {
  scene->advance({coordinates, coordinates + scene->coordinate_count()},
                 {activations, activations + scene->muscle_count()});
}

void show(int arms) { scene->show(arms != 0); }

/// `places`: the bone's point at rest, where it shall be, and the direction of looking. Changes the coordinates.
int pull(int bone, const double* places, double* coordinates) {
  using gracilis::Vec3;
  std::vector<double> values(coordinates, coordinates + scene->coordinate_count());
  const bool pulled =
      scene->pull(static_cast<std::size_t>(bone), Vec3(places), Vec3(places + 3), Vec3(places + 6), values);
  std::copy(values.begin(), values.end(), coordinates);
  return pulled ? 1 : 0;
}
}
