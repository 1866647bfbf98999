#include <gracilis/methods/xpbd/mid_solve_snapshot.hpp>
#include <gracilis/methods/xpbd/presets.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/methods/xpbd/step_counts.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <algorithm>

namespace gracilis {

/// Of contact, whose settings stand in three structs; a key that two of them share is told once.
static std::vector<DescribedSetting> contact_table() {
  std::vector<DescribedSetting> table = describe_settings<ContactSettings>();
  for (const auto& part : {describe_settings<SurfaceContactSettings>(), describe_settings<VirtualEdgeSettings>()})
    for (const DescribedSetting& setting : part) {
      const auto same = [&](const DescribedSetting& other) { return other.key == setting.key; };
      if (std::none_of(table.begin(), table.end(), same)) table.push_back(setting);
    }
  return table;
}

static std::vector<Problem> validate_xpbd(const Scene& scene) {
  std::vector<Problem> problems;
  for (const Muscle& muscle : scene.muscles) {
    const std::string bone = xpbd_settings(scene, muscle).slide_on_bone;
    const auto has_name = [&](const Bone& each) { return each.name == bone; };
    if (!bone.empty() && std::none_of(scene.bones.begin(), scene.bones.end(), has_name))
      problems.push_back({"", "muscle '" + muscle.name + "'",
                          "'slide_on_bone' names '" + bone + "', but the scene has no such bone", ""});
  }
  const VirtualEdgeSettings edges = with_values(VirtualEdgeSettings{}, scene.method.contact);
  if (contact_settings(scene).muscle == MuscleContact::virtual_edges && !(edges.reach > edges.distance))
    problems.push_back({"", "contact",
                        "virtual edges are seeded no farther than 'contact_distance', so muscles meet before they are "
                        "found",
                        "give 'seed_reach' a larger value"});
  return problems;
}

static std::unique_ptr<DeformationMethod> make_xpbd(const Scene& scene, const BoneFieldSource& fields) {
  std::vector<DistanceField> far_fields;
  if (needs_far_fields(scene)) far_fields = fields(strings::far_field_settings());
  return make_xpbd_method(scene, fields(scene.distance_fields), std::move(far_fields));
}

/// What finds contact remembers more than frames record.
static int xpbd_resume_period(const Scene& scene) {
  if (contact_settings(scene).muscle == MuscleContact::none) return 1;
  return with_values(SurfaceContactSettings{}, scene.method.contact).update_period;
}

static bool has_surface_contact(const Scene& scene) { return contact_settings(scene).muscle == MuscleContact::surface; }

MethodEntry xpbd_entry() {
  return {.name = "xpbd",
          .meaning = "their surfaces, by constraints",
          .settings = describe_settings<XpbdSettings>(),
          .contact = contact_table(),
          .presets = xpbd_presets(),
          .metrics = xpbd::step_metrics(),
          .validate = validate_xpbd,
          .make = make_xpbd,
          .resume_period = xpbd_resume_period,
          .has_surface_contact = has_surface_contact,
          .has_far_fields = needs_far_fields,
          .phase_timer = xpbd::phase_timer};
}

}  // namespace gracilis
