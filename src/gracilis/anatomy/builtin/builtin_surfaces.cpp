#include <gracilis/anatomy/builtin/builtin_surfaces.hpp>

#include <cassert>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace gracilis {

namespace {

class SurfaceWriter {
 public:
  template <typename T>
  void values(const T* first, Index count) {
    bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes_.append(reinterpret_cast<const char*>(first), static_cast<std::size_t>(count) * sizeof(T));
  }
  void mesh(const TriangleMesh& mesh) {
    values(mesh.vertices.data(), static_cast<Index>(mesh.vertices.size()));
    values(mesh.faces.data(), static_cast<Index>(mesh.faces.size()));
  }
  void list(const std::vector<Index>& list) { values(list.data(), static_cast<Index>(list.size())); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class SurfaceReader {
 public:
  explicit SurfaceReader(std::string_view bytes) : rest_(bytes) {}

  void mesh(TriangleMesh& mesh) {
    mesh.vertices.resize(3, count() / 3);
    copy(mesh.vertices.data(), mesh.vertices.size());
    mesh.faces.resize(3, count() / 3);
    copy(mesh.faces.data(), mesh.faces.size());
  }
  void list(std::vector<Index>& list) {
    list.resize(static_cast<std::size_t>(count()));
    copy(list.data(), static_cast<std::ptrdiff_t>(list.size()));
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  Index count() {
    Index count = 0;
    copy(&count, 1);
    return count;
  }
  template <typename T>
  void copy(T* to, std::ptrdiff_t count) {
    const std::size_t size = static_cast<std::size_t>(count) * sizeof(T);
    assert(size <= rest_.size());
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  std::string_view rest_;
};

template <typename AnyScene, typename Visitor>  // const Scene or Scene
void visit_surfaces(AnyScene& scene, Visitor& visitor) {
  for (auto& bone : scene.bones) visitor.mesh(bone.surface);
  for (auto& muscle : scene.muscles) {
    visitor.mesh(muscle.surface);
    for (auto& attachment : muscle.attachments) visitor.list(attachment.vertices);
  }
}

}  // namespace

std::string written_surfaces(const Scene& scene) {
  SurfaceWriter writer;
  visit_surfaces(scene, writer);
  return writer.take();
}

void put_surfaces(std::string_view bytes, Scene& scene) {
  SurfaceReader reader(bytes);
  visit_surfaces(scene, reader);
  assert(reader.is_at_end());
}

}  // namespace gracilis
