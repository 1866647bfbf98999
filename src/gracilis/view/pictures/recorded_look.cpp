#include <gracilis/view/pictures/recorded_look.hpp>

#include <vector>

namespace gracilis {

MuscleLook recorded_look(const RecordedRun& run, const std::string& muscle) {
  const TriangleMesh rest = recorded_surface(run, muscle, 0);
  const Points tissue = recorded_tissue(run, muscle);
  std::vector<Index> ends[2];
  for (Index v = 0; v < tissue.cols(); ++v)
    for (const int end : {0, 1})
      if (tissue(end, v) > 0.5) ends[end].push_back(v);
  if (ends[0].empty() || ends[1].empty()) return muscle_look(rest, recorded_fibers(run, muscle, 0));
  return muscle_look(rest, ends[0], ends[1]);
}

}  // namespace gracilis
