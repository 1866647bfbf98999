#pragma once

#include <gracilis/geometry/thin_plate.hpp>
#include <gracilis/transfer/skeleton_fit.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gracilis {

/// How an attachment came to lie on the subject.
struct AttachmentFit {
  std::string muscle, attachment;
  Index vertices = 0;
  Real brought = 0,
       brought_most = 0;  ///< m, from where the warp put its vertices to where they are held: mean, largest
  Real from_bone = 0;     ///< m, mean distance to the subject's bones of its body, in the end
  bool on_bone = false;   ///< false: its bone is missing, or was not near: where the warp put it
};

struct MuscleFit {
  std::string muscle;
  Real template_volume = 0, warped_volume = 0, volume = 0;  ///< m³
};

/// Pulls muscles apart from each other and from bones, in place (prepare/separation.hpp); tells how much the worst gap
/// is missed by still, m.
using SeparateFunction =
    std::function<Real(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones)>;

struct TransferredMuscles {
  std::vector<AttachmentFit> attachments;
  std::vector<MuscleFit> muscles;
};

/// Carries what muscles are made of by the warp: surfaces, aponeuroses, fibers, tracts, lines. Then attached vertices
/// are brought as near to the subject's bones as they were to the template's, the rest following harmonically, and
/// volumes (m³, by muscle) are reached by an as-rigid-as-possible surface that gives way along its normals. `subject`
/// has the subject's bones in the place of the scene's; bones that it lacks have no faces.
TransferredMuscles transfer_muscles(const Scene& scene, const std::vector<TriangleMesh>& subject,
                                    const ThinPlateMap& warp, const std::map<std::string, Real>& volumes,
                                    std::vector<Muscle>& muscles);

/// Sets what is told of muscles as they are in the end: volumes, and how far attachments are from the bones of their
/// bodies.
void measure_muscles(const Scene& scene, TransferredMuscles& muscles);

}  // namespace gracilis
