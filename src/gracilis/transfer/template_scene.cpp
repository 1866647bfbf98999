#include <gracilis/transfer/template_scene.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/scene/setting_table.hpp>

namespace gracilis {
namespace {

toml::table values_table(const SettingValues& values) {
  std::string text;
  for (const auto& [key, value] : values) text += std::string(key) + " = " + to_text(value) + "\n";
  return parse_toml(text, "settings");
}

toml::array bone_tables(const Scene& scene) {
  toml::array list;
  for (const Bone& bone : scene.bones)
    list.push_back(toml::table{{"name", bone.name}, {"body", scene.bodies[static_cast<std::size_t>(bone.body)]}});
  return list;
}

toml::array joint_tables(const Scene& scene) {
  toml::array list;
  for (const Joint& joint : scene.joints) {
    toml::array axes;
    for (const JointAxis& axis : joint.axes) {
      toml::table table{{"coordinate", axis.coordinate}};
      if (axis.translation) table.insert("translation", true);
      axes.push_back(std::move(table));
    }
    list.push_back(toml::table{{"name", joint.name},
                               {"parent", scene.bodies[static_cast<std::size_t>(joint.parent_body)]},
                               {"child", scene.bodies[static_cast<std::size_t>(joint.child_body)]},
                               {"axes", std::move(axes)}});
  }
  return list;
}

toml::array muscle_tables(const Scene& scene) {
  toml::array list;
  for (const Muscle& muscle : scene.muscles) {
    toml::array attachments;
    for (const Attachment& attachment : muscle.attachments) {
      toml::table table{{"name", attachment.name},
                        {"end", attachment.end == AttachmentEnd::origin ? "origin" : "insertion"}};
      if (const MuscleBody* on = muscle_body(scene, attachment.body))
        table.insert("muscle", scene.muscles[static_cast<std::size_t>(on->muscle)].name);
      else
        table.insert("body", scene.bodies[static_cast<std::size_t>(attachment.body)]);
      attachments.push_back(std::move(table));
    }
    toml::table table{{"name", muscle.name}, {"attachments", std::move(attachments)}};
    if (!muscle.settings.empty()) table.insert("settings", values_table(muscle.settings));
    if (const SettingValues fibers = changed_values(muscle.fibers); !fibers.empty())
      table.insert("fibers", values_table(fibers));
    if (const SettingValues contraction = changed_values(muscle.contraction); !contraction.empty())
      table.insert("contraction", values_table(contraction));
    list.push_back(std::move(table));
  }
  return list;
}

}  // namespace

TemplateScene template_of(const Scene& scene) {
  TemplateScene result;
  result.name = scene.name;
  result.loaded.scene = scene;
  toml::table& tables = result.tables;
  tables.insert("schema", 1);
  if (scene.method.name != "xpbd") tables.insert("method", scene.method.name);
  const std::pair<const char*, SettingValues> sections[] = {{"settings", scene.method.settings},
                                                            {"contact", scene.method.contact},
                                                            {"sequence", changed_values(scene.sequence)},
                                                            {"distance_field", changed_values(scene.distance_fields)}};
  for (const auto& [key, values] : sections)
    if (!values.empty()) tables.insert(key, values_table(values));
  tables.insert("bones", bone_tables(scene));
  tables.insert("joints", joint_tables(scene));
  tables.insert("muscles", muscle_tables(scene));
  return result;
}

TemplateScene read_template(const std::string& name, const SceneOptions& options) {
  if (builtin_scene_of(name)) {
    TemplateScene result = template_of(load_scene(name, options).scene);
    result.name = name;
    return result;
  }
  TemplateScene result;
  result.name = name;
  result.loaded = read_scene(name, options);
  result.tables = load_scene_layers(name, options.set).table;
  result.file = name;
  result.data_root = find_data_root(name, options.data);
  return result;
}

}  // namespace gracilis
