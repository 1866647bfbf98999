// Shapes the built-in scenes while the program is built: HIP ELBOW, the files to write.
#include <gracilis/anatomy/builtin/builtin_elbow.hpp>
#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/builtin/builtin_surfaces.hpp>

#include <fstream>

namespace {

bool is_written(const gracilis::Scene& scene, const char* path) {
  std::ofstream file(path, std::ios::binary);
  file << gracilis::written_surfaces(scene);
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int count, char** arguments) {
  using namespace gracilis;
  return count == 3 && is_written(builtin_hip(), arguments[1]) && is_written(builtin_elbow(), arguments[2]) ? 0 : 1;
}
