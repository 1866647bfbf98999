#pragma once

#include <gracilis/dynamics/contact/field/face_set.hpp>
#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

namespace gracilis {

/// Pushes the deepest points of edges, the middles that keep a gap of their own, the deepest points of faces, and
/// particles out along the field's gradient. Returns how many were touching. An edge's deepest point is followed from
/// iteration to iteration, a face's is that of the last listing.
Index project_edge_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                            Particles& particles);
/// Of the middles of edges that keep a gap of their own (project_edge_contacts).
Index project_middle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                              Particles& particles);
/// Of the deepest points of large faces (project_edge_contacts).
Index project_face_contacts(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                            NearField& near, Particles& particles);
/// Of the particles themselves (project_edge_contacts).
Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                                Particles& particles);

}  // namespace gracilis
