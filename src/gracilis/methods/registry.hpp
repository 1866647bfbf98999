#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// All methods; the first is the default.
const std::vector<MethodEntry>& methods();

/// The method with this name, or null.
const MethodEntry* find_method(std::string_view name);

/// The scene's method. Precondition: there is one.
const MethodEntry& method_of(const Scene& scene);

/// All that makes a scene unfit for its method; empty when there is nothing: no such method, settings that it does not
/// have or that are out of their range, what the method itself asks for, and distance fields of its own that would take
/// more memory than machines have.
std::vector<Problem> validate_method(const Scene& scene);

/// The scene's method, prepared. `fields` are asked for only where it looks at bones. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_method(const Scene& scene, const BoneFieldSource& fields);

/// Whether surfaces keep out of each other in this scene.
bool keeps_surfaces_apart(const Scene& scene);

/// An interrupted run goes on after a frame whose number is a multiple of this, because a method may remember more than
/// frames record in between.
int resume_period(const Scene& scene);

/// The presets of all methods; the first is the default.
std::vector<Preset> presets();

/// The preset with this name, or none.
std::optional<Preset> find_preset(std::string_view name);

/// A value of the method's settings for one muscle: its own, else the scene's, else the default. Precondition: the
/// method has the setting.
SettingValue setting_of(const Scene& scene, const Muscle& muscle, const DescribedSetting& setting);

/// m from attachments over which a muscle passes from tendon to belly: `tendon_length` of its method, or a usual length
/// where the method has no such setting.
Real tendon_length_of(const Scene& scene, const Muscle& muscle);

}  // namespace gracilis
