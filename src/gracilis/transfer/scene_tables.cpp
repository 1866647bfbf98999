#include <gracilis/transfer/scene_tables.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/transfer/mirrored_scene.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

std::string text_of(const toml::table& table, const char* key) { return table[key].value_or(std::string()); }

/// Without digits that mean nothing.
double rounded(Real value, int digits) {
  const Real scale = std::pow(10.0, digits), result = std::round(value * scale) / scale;
  return result == 0 ? 0 : result;
}

toml::array vector_of(const Vec3& v, int digits) {
  return toml::array{rounded(v[0], digits), rounded(v[1], digits), rounded(v[2], digits)};
}

toml::array rows_of(const Points& points, Real unit) {
  toml::array rows;
  for (Index i = 0; i < points.cols(); ++i) rows.push_back(vector_of(points.col(i) / unit, 4));
  return rows;
}

template <class Named>
const Named* find_named(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void set(toml::table& table, const char* key, toml::array value) { table.insert_or_assign(key, std::move(value)); }

void erase(toml::table& table, std::initializer_list<const char*> keys) {
  for (const char* key : keys) table.erase(key);
}

/// Every text that is the name of something takes the other side's.
void rename(toml::node& node, const std::set<std::string>& names) {
  if (toml::table* table = node.as_table())
    for (auto&& [key, each] : *table) rename(each, names);
  else if (toml::array* array = node.as_array())
    for (toml::node& each : *array) rename(each, names);
  else if (toml::value<std::string>* text = node.as_string(); text && names.count(text->get()))
    *text = other_side_name(text->get());
}

std::set<std::string> names_in(const Scene& scene) {
  std::set<std::string> names(scene.bodies.begin(), scene.bodies.end());
  for (const Bone& bone : scene.bones) names.insert(bone.name);
  for (const Muscle& muscle : scene.muscles) names.insert(muscle.name);
  for (const Joint& joint : scene.joints) {
    names.insert(joint.name);
    for (const JointAxis& axis : joint.axes) names.insert(axis.coordinate);
  }
  return names;
}

struct Writing {
  const TemplateScene& origin;
  const Transferred& transferred;
  fs::path folder;
  std::vector<std::string>& left_out;

  const Scene& scene() const { return transferred.scene; }

  /// Calls act(table) for each of a list, which says whether it stays.
  template <class Act>
  static void each(toml::table& tables, const char* key, const Act& act) {
    toml::array* list = tables[key].as_array();
    if (!list) return;
    for (auto at = list->begin(); at != list->end();) at = act(*at->as_table()) ? at + 1 : list->erase(at);
    if (list->empty()) tables.erase(key);
  }

  bool bone(toml::table& table) const {
    const std::string name = text_of(table, "name");
    if (!find_named(scene().bones, name)) return false;
    erase(table, {"unit", "mirror", "part", "box", "file"});
    table.insert("file", "bones/" + name + ".vtp");
    return true;
  }

  bool joint(toml::table& table) const {
    const Joint* joint = find_named(scene().joints, text_of(table, "name"));
    if (!joint) return false;
    erase(table, {"center_unit", "orientation_xyz_rad"});
    set(table, "center", vector_of(joint->frame.translation(), 6));
    if (!joint->frame.linear().isIdentity(1e-9))
      set(table, "orientation_xyz_rad", vector_of(joint->frame.linear().eulerAngles(0, 1, 2), 8));
    std::size_t number = 0;
    each(table, "axes", [&](toml::table& axis) { return this->axis(joint->axes[number++], axis); });
    return true;
  }

  static bool axis(const JointAxis& axis, toml::table& table) {
    erase(table, {"capture_deg", "capture_mm", "range_deg", "range_mm"});
    set(table, "axis", vector_of(axis.axis, 8));
    const Real unit = axis.translation ? 0.001 : radians(1);
    const std::string suffix = axis.translation ? "_mm" : "_deg";
    if (axis.capture_value != 0) table.insert("capture" + suffix, rounded(axis.capture_value / unit, 4));
    table.insert("range" + suffix, toml::array{rounded(axis.range_min / unit, 4), rounded(axis.range_max / unit, 4)});
    return true;
  }

  bool muscle(toml::table& table) const {
    const Muscle* muscle = find_named(scene().muscles, text_of(table, "name"));
    if (!muscle) return false;
    erase(table, {"unit", "mirror", "part", "box", "given", "piece", "file"});
    table.insert("file", "muscles/" + muscle->name + ".vtp");
    lines(table, "fibers", "file", muscle->given_fibers, "fibers/" + muscle->name + ".vtp");
    lines(table, "fibers", "tracts", muscle->tracts, "fibers/" + muscle->name + "_tracts.vtp");
    lines(table, "contraction", "file", muscle->given_surface_fibers, "fibers/" + muscle->name + "_surface.vtp");
    if (toml::table* line = table["action_line"].as_table()) {
      action_line(muscle->name, muscle->action_line, *line);
      std::size_t head = 0;
      each(*line, "heads", [&](toml::table& own) {
        const ActionLine& now = muscle->action_line.heads[head++];
        own.insert_or_assign("name", now.name);
        action_line(now.name, now, own);
        return true;
      });
    }
    std::size_t number = 0, sheet = 0;
    each(table, "attachments", [&](toml::table& end) { return attachment(*muscle, number++, sheet, end); });
    return true;
  }

  static void lines(toml::table& muscle, const char* section, const char* key, const Polylines& lines,
                    const std::string& file) {
    toml::table* table = muscle[section].as_table();
    if (!table || !table->contains(key) || lines.count() == 0) return;
    table->insert_or_assign(key, file);
    table->erase("unit");
  }

  void action_line(const std::string& muscle, const ActionLine& line, toml::table& table) const {
    if (line.points.cols() > 0) set(table, "points_mm", rows_of(line.points, 0.001));
    if (line.centers.cols() > 0) set(table, "centers_mm", rows_of(line.centers, 0.001));
    if (!table.contains("path") && !table.contains("wraps")) return;
    left_out.push_back("line of " + muscle + ": its points that come and go and the surfaces that it wraps around");
    erase(table, {"path", "wraps"});
  }

  bool attachment(const Muscle& muscle, std::size_t number, std::size_t& sheet, toml::table& table) const {
    const Attachment& attachment = muscle.attachments[number];
    erase(table, {"bone", "cloud", "points_mm", "patch", "unit", "part", "mirror", "line", "bone_distance_mm",
                  "muscle_distance_mm", "landmark_distance_mm"});
    if (!table.contains("muscle"))
      table.insert_or_assign("body", scene().bodies[static_cast<std::size_t>(attachment.body)]);
    toml::array vertices;
    for (const Index v : attachment.vertices) vertices.push_back(v);
    set(table, "vertices", std::move(vertices));
    table.insert_or_assign("guessed", true);
    if (!table.contains("aponeurosis")) return true;
    const std::size_t count = table["aponeurosis"].is_array() ? table["aponeurosis"].as_array()->size() : 1;
    toml::array files;
    for (std::size_t i = 0; i < count; ++i)
      files.push_back(fmt::format("muscles/{}_sheet_{}.vtp", muscle.name, sheet++));
    set(table, "aponeurosis", std::move(files));
    return true;
  }

  /// Of a list of texts or one text, those that are still there; false: none is.
  template <class Named>
  static bool keep_known(toml::table& table, const char* key, const std::vector<Named>& known) {
    if (toml::array* list = table[key].as_array()) {
      for (auto at = list->begin(); at != list->end();)
        at = find_named(known, at->value_or(std::string())) ? at + 1 : list->erase(at);
      return !list->empty();
    }
    return find_named(known, text_of(table, key)) != nullptr;
  }

  /// A file that lies beside the table that names it, or in the data folder, now in tables/.
  void copy_file(toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (!node || !node->is_string()) return;
    const fs::path named = node->value_or(std::string());
    const fs::path source = node->source().path ? fs::path(*node->source().path).parent_path() : fs::path(".");
    fs::path file = source / named;
    if (!is_there(file)) file = origin.data_root / named;
    const std::string to = "tables/" + named.filename().string();
    write_text_atomically(folder / to, read_text(file));
    table.insert_or_assign(key, to);
  }

  bool knows(const std::string& coordinate) const {
    return std::any_of(scene().joints.begin(), scene().joints.end(), [&](const Joint& joint) {
      return std::any_of(joint.axes.begin(), joint.axes.end(),
                         [&](const JointAxis& axis) { return axis.coordinate == coordinate; });
    });
  }

  /// Columns whose joints are not there go; a motion without any goes as a whole.
  void motion(toml::table& tables) const {
    const Motion& all = scene().motion;
    std::vector<Index> kept;
    for (std::size_t i = 0; i < all.coordinates.size(); ++i)
      if (knows(all.coordinates[i])) kept.push_back(static_cast<Index>(i));
    toml::table* table = tables["motion"].as_table();
    const bool is_whole = kept.size() == all.coordinates.size();
    if (kept.empty()) {
      tables.erase("motion");
      return;
    }
    const bool keyed = table && (table->contains("key_poses_deg") || table->contains("key_poses_mm"));
    if (table && keyed && is_whole) return;
    if (table && !keyed && is_whole && !transferred.is_mirrored) return copy_file(*table, "file");
    Table rows;
    rows.name = "motion";
    rows.times = all.times;
    rows.in_degrees = true;
    rows.values.resize(all.values.rows(), static_cast<Index>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const std::string& name = all.coordinates[static_cast<std::size_t>(kept[i])];
      rows.columns.push_back(name);
      rows.values.col(static_cast<Index>(i)) = all.values.col(kept[i]) * (is_translation(name) ? 1 : degrees(1));
    }
    write_sto(folder / "tables" / "motion.sto", rows);
    toml::array names;
    for (const std::string& name : rows.columns) names.push_back(name);
    toml::table made{{"file", "tables/motion.sto"}, {"coordinates", std::move(names)}};
    tables.insert_or_assign("motion", std::move(made));
  }

  bool is_translation(const std::string& coordinate) const {
    for (const Joint& joint : scene().joints)
      for (const JointAxis& axis : joint.axes)
        if (axis.coordinate == coordinate) return axis.translation;
    return false;
  }

  bool activation(toml::table& table) const {
    if (!keep_known(table, "muscle", scene().muscles)) return false;
    if (table.contains("coordinate") && !knows(text_of(table, "coordinate"))) return false;
    if (transferred.is_mirrored && table.contains("file") && !table.contains("column"))
      table.insert("column", other_side_name(text_of(table, "muscle")));
    copy_file(table, "file");
    return true;
  }

  bool transversal(toml::table& table) const {
    if (table.contains("bones") && !keep_known(table, "bones", scene().bones)) table.erase("bones");
    if (table.contains("other_muscle") && !find_named(scene().muscles, text_of(table, "other_muscle"))) return false;
    return find_named(scene().muscles, text_of(table, "muscle")) &&
           (table.contains("bones") || table.contains("other_muscle"));
  }
};

/// With or without a slash behind it.
std::string name_of_folder(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

toml::array guessed_list(const Transferred& transferred, const TemplateScene& origin) {
  toml::array list;
  list.push_back(fmt::format("all muscles, attachments and joints: carried from {}{}", origin.name,
                             transferred.is_mirrored ? ", mirrored" : ""));
  for (const Guess& guess : transferred.guesses) list.push_back(guess.subject + ": " + to_string(guess));
  for (const std::string& line : transferred.skeleton.doubtful) list.push_back(line);
  return list;
}

}  // namespace

toml::table subject_tables(const TemplateScene& origin, const Transferred& transferred, const fs::path& folder,
                           std::vector<std::string>& left_out) {
  toml::table tables = origin.tables;
  Writing writing{origin, transferred, folder, left_out};
  create_folder(folder / "tables");
  if (transferred.is_mirrored) rename(tables, names_in(origin.loaded.scene));
  erase(tables, {"prepare", "landmarks", "only"});
  tables.insert_or_assign("name", name_of_folder(folder));
  set(tables, "anterior", vector_of(transferred.scene.axes.anterior, 8));
  set(tables, "superior", vector_of(transferred.scene.axes.superior, 8));
  set(tables, "guessed", guessed_list(transferred, origin));
  Writing::each(tables, "bones", [&](toml::table& table) { return writing.bone(table); });
  Writing::each(tables, "joints", [&](toml::table& table) { return writing.joint(table); });
  Writing::each(tables, "muscles", [&](toml::table& table) { return writing.muscle(table); });
  writing.motion(tables);
  Writing::each(tables, "activations", [&](toml::table& table) { return writing.activation(table); });
  Writing::each(tables, "transversals", [&](toml::table& table) { return writing.transversal(table); });
  if (tables.contains("joint_control_units")) {
    left_out.push_back("joint control units: their samples are of the template's muscles");
    tables.erase("joint_control_units");
  }
  return tables;
}

}  // namespace gracilis
