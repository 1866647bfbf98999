#pragma once

#include <gracilis/methods/tissue/ends_on_muscles.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/minimize.hpp>

#include <vector>

namespace gracilis::tissue {

/// One of the muscles of a group that ends join.
struct JoinedTissue {
  std::size_t number = 0;  ///< in the scene
  const PreparedTissue* muscle = nullptr;
  Surroundings* around = nullptr;
  const FactoredMatrix* metric = nullptr;
  Points* nodes = nullptr;
};

/// Takes the muscles of a group together to the least energy near their nodes, the springs between them included: in
/// turns they would come there slowly. Ends turn with what lies below them as that was at the beginning. In so many
/// iterations at most. The surroundings then say what they do to each other.
Minimized settle_joined(const std::vector<EndOnMuscle>& ends, const std::vector<JoinedTissue>& group, int iterations);

}  // namespace gracilis::tissue
