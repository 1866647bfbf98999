#include <gracilis/io/scene/method_reader.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/toml_reader.hpp>
#include <gracilis/methods/registry.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace gracilis {

static Real unit_of(TomlReader& table, const std::string& key) {
  const std::string unit = table.text(key).value_or("m");
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  table.add_problem(key, "'" + key + "' must be \"m\", \"cm\" or \"mm\"");
  return 1;
}

static NamedFile named_file(TomlReader& table, const std::string& path) {
  return {path, unit_of(table, "unit"), table.place()};
}

static constexpr long most_box_triangles = 2'000'000;

static BoxDescription read_box(TomlReader table) {
  const Vec3 center = table.vector("center_mm").value_or(Vec3::Zero()) / 1000;
  const Vec3 size = table.required_vector("size_mm").value_or(Vec3::Ones()) / 1000;
  const Vec3 cells = table.vector("cells").value_or(Vec3::Ones());
  if (!(size.minCoeff() > 0)) table.add_problem("size_mm", "'size_mm' must be three numbers above 0");
  if (!(cells.minCoeff() >= 1 && cells.maxCoeff() <= 1000 && cells == cells.array().round().matrix()))
    table.add_problem("cells", "'cells' must be three integers from 1 to 1000");
  const Real triangles = 4 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]);
  if (triangles > most_box_triangles)
    table.add_problem("cells", "'cells' asks for " + std::to_string(static_cast<long>(triangles)) + " triangles",
                      std::to_string(most_box_triangles) + " are the most that are made");
  table.reject_unknown_keys();
  const auto count = [&](int k) { return std::clamp(static_cast<int>(cells[k]), 1, 1000); };
  return {center - size / 2, center + size / 2, {count(0), count(1), count(2)}};
}

/// The surface of an element: a file, or a box of its own making.
template <class Description>
static void read_surface(TomlReader& table, Description& description) {
  if (std::optional<TomlReader> box = table.table("box")) {
    if (table.has("file")) table.add_problem("file", "the surface is given twice, by 'file' and by 'box'");
    description.box = read_box(std::move(*box));
  } else {
    description.file = named_file(table, table.required_text("file"));
  }
}

static BoneDescription read_bone(TomlReader table) {
  BoneDescription bone;
  bone.name = table.required_text("name");
  bone.body = table.text("body").value_or(bone.name);
  read_surface(table, bone);
  bone.place = table.place();
  table.reject_unknown_keys();
  return bone;
}

static JointAxis read_axis(TomlReader table) {
  JointAxis axis;
  axis.coordinate = table.required_text("coordinate");
  const std::optional<Vec3> direction = table.required_vector("axis");
  if (direction && direction->norm() < 1e-9)
    table.add_problem("axis", "the axis has no length");
  else if (direction)
    axis.axis = direction->normalized();
  axis.translation = table.flag("translation").value_or(false);
  const Real unit = axis.translation ? 0.001 : radians(1);
  const std::string capture = axis.translation ? "capture_mm" : "capture_deg";
  const NumberRange values = axis.translation ? NumberRange{-1e5, 1e5, "mm"} : NumberRange{-360, 360, "degrees"};
  axis.capture_value = table.number(capture, values).value_or(0) * unit;
  const std::string range_key = axis.translation ? "range_mm" : "range_deg";
  if (const std::optional<Eigen::Vector2d> range = table.pair(range_key)) {
    axis.range_min = (*range)(0) * unit;
    axis.range_max = (*range)(1) * unit;
    if (axis.range_min > axis.range_max) table.add_problem(range_key, "the range ends before it begins");
  }
  table.reject_unknown_keys();
  return axis;
}

static JointDescription read_joint(TomlReader table) {
  JointDescription result;
  Joint& joint = result.joint;
  joint.name = table.required_text("name");
  result.parent = table.required_text("parent");
  result.child = table.required_text("child");
  result.place = table.place();
  const Vec3 center = table.required_vector("center").value_or(Vec3::Zero()) * unit_of(table, "center_unit");
  const Vec3 angles = table.vector("orientation_xyz_rad").value_or(Vec3::Zero());
  joint.frame = Eigen::Translation3d(center) * Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) *
                Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) * Eigen::AngleAxisd(angles.z(), Vec3::UnitZ());
  for (TomlReader& axis : table.tables("axes")) joint.axes.push_back(read_axis(std::move(axis)));
  table.reject_unknown_keys();
  return result;
}

static Real millimetres(TomlReader& table, const std::string& key) {
  return table.number(key, {0, 1000, "mm"}).value_or(0) / 1000;
}

static AttachmentDescription read_attachment(TomlReader table) {
  AttachmentDescription result;
  result.place = table.place();
  result.name = table.required_text("name");
  const std::string end = table.required_text("end");
  if (end == "insertion")
    result.end = AttachmentEnd::insertion;
  else if (end != "origin" && !end.empty())
    table.add_problem("end", "'end' must be \"origin\" or \"insertion\"");
  const std::string line = table.text("line").value_or("cloud");
  if (line == "open")
    result.line = LineKind::open;
  else if (line == "closed")
    result.line = LineKind::closed;
  else if (line == "outline")
    result.line = LineKind::outline;
  else if (line != "cloud")
    table.add_problem("line", "'line' must be \"cloud\", \"open\", \"closed\" or \"outline\"");
  result.body = table.text("body").value_or("");
  result.bones = table.texts("bone");
  result.clouds = table.texts("cloud");
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("points_mm", 3))
    result.points = {rows->transpose() / 1000};
  result.bone_distance = millimetres(table, "bone_distance_mm");
  result.landmark_distance = millimetres(table, "landmark_distance_mm");
  result.vertices = table.indices("vertices");
  result.guessed = table.flag("guessed").value_or(false);
  table.reject_unknown_keys();

  // Which of the four ways is meant follows from the keys; they must fit together.
  const bool landmarks = !result.clouds.empty() || !result.points.empty();
  const bool listed = !result.vertices.empty();
  const auto complain = [&](const std::string& what, const std::string& remedy) {
    Problem problem = result.place;
    problem.what = "attachment '" + result.name + "' " + what;
    problem.remedy = remedy;
    table.add_problem(problem);
  };
  if (result.bones.empty() && result.body.empty()) complain("is fixed to nothing", "give 'bone' or 'body'");
  if (listed && (landmarks || result.bone_distance > 0 || result.landmark_distance > 0)) {
    complain("lists its vertices and also asks for distances", "keep one of the two");
  } else if (!listed && !landmarks && result.bones.empty()) {
    complain("does not say which vertices it takes", "give 'cloud', 'points_mm', 'bone' or 'vertices'");
  } else if (!listed && !result.bones.empty() && result.bone_distance == 0) {
    complain("needs the key 'bone_distance_mm'", "the distance to the bone within which vertices are taken");
  } else if (landmarks && result.landmark_distance == 0) {
    complain("needs the key 'landmark_distance_mm'", "the distance to the landmarks within which vertices are taken");
  } else if (result.line == LineKind::outline && result.bones.empty()) {
    complain("has an outline but no bone", "give 'bone', on whose surface the inside lies");
  } else if (!landmarks && result.landmark_distance > 0) {
    complain("gives a distance to landmarks but no landmarks", "give 'cloud' or 'points_mm'");
  }
  return result;
}

static void read_fibers(TomlReader table, MuscleDescription& muscle) {
  table.read_settings(muscle.fibers);
  if (const std::optional<std::string> file = table.text("file")) muscle.fiber_file = named_file(table, *file);
  const std::string kind = table.text("lines").value_or("inner");
  muscle.superficial_fibers = kind == "superficial";
  if (kind != "inner" && kind != "superficial") {
    table.add_problem("lines", "'lines' must be \"inner\" or \"superficial\"");
  } else if (table.has("lines") && muscle.fiber_file.path.empty()) {
    table.add_problem("lines", "'lines' says what the key 'file' holds, which is missing");
  }
  table.reject_unknown_keys();
}

static void read_contraction(TomlReader table, MuscleDescription& muscle) {
  table.read_settings(muscle.contraction);
  if (const std::optional<std::string> file = table.text("file")) muscle.contraction_file = named_file(table, *file);
  table.reject_unknown_keys();
}

static void read_action_line(TomlReader table, ActionLineDescription& description) {
  ActionLine& line = description.line;
  if (!table.has("rays")) table.required_number("rays");
  line.rays = table.integer("rays", 6, 1000).value_or(6);
  line.scaling = table.integer("scaling", 0, 16).value_or(0);
  const auto length = [&](const char* key) { return table.number(key, {0, 10'000, "mm"}).value_or(0) / 1000; };
  line.tendon = length("tendon_mm");
  line.origin_tendon = length("origin_tendon_mm");
  line.optimal_fiber = length("optimal_fiber_mm");
  line.pennation = radians(table.number("pennation_deg", {0, 89}).value_or(0));
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("centers_mm", 3)) line.centers = rows->transpose() / 1000;
  description.bodies = table.texts("bodies");
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("points_mm", 3)) line.points = rows->transpose() / 1000;
  if (line.points.cols() != static_cast<Index>(description.bodies.size()))
    table.add_problem("bodies", "'bodies' must name a body for each of 'points_mm'");
  description.path = read_line_path(table);
  table.reject_unknown_keys();
}

static MuscleDescription read_muscle(TomlReader table, const MethodEntry& method, const FiberSettings& fibers,
                                     const ContractionSettings& contraction, std::set<std::string>& others) {
  MuscleDescription muscle;
  muscle.place = table.place();
  muscle.name = table.required_text("name");
  read_surface(table, muscle);
  muscle.fibers = fibers;
  muscle.contraction = contraction;
  if (std::optional<TomlReader> own = table.table("fibers")) read_fibers(std::move(*own), muscle);
  if (std::optional<TomlReader> own = table.table("contraction")) read_contraction(std::move(*own), muscle);
  if (std::optional<TomlReader> line = table.table("action_line"))
    read_action_line(std::move(*line), muscle.action_line);
  if (std::optional<TomlReader> settings = table.table("settings")) {
    read_method_settings(*settings, method, &MethodEntry::settings, muscle.settings, others);
    settings->reject_unknown_keys();
  }
  for (TomlReader& attachment : table.tables("attachments")) {
    muscle.attachments.push_back(read_attachment(std::move(attachment)));
  }
  table.reject_unknown_keys();
  return muscle;
}

static MotionDescription read_motion(TomlReader table) {
  MotionDescription motion;
  motion.place = table.place();
  if (const std::optional<std::string> file = table.text("file")) motion.file = {*file, 1, table.place()};
  motion.coordinates = table.texts("coordinates");
  const Index columns = static_cast<Index>(motion.coordinates.size());
  // All coordinates turn or all shift: key poses in degrees or in mm.
  const bool shifts = table.has("key_poses_mm");
  const std::string key = shifts ? "key_poses_mm" : "key_poses_deg";
  const Real unit = shifts ? 0.001 : radians(1);
  motion.translations = shifts;
  const bool keyed = table.has(key);
  if (keyed && !motion.file.path.empty()) {
    table.add_problem(key, "the motion is given twice, by 'file' and by '" + key + "'", "keep one of the two");
  } else if (keyed && columns == 0) {
    table.add_problem(key, "'" + key + "' needs the key 'coordinates'", "the names of its columns");
  } else if (!keyed && motion.file.path.empty() && !table.has("max_frames")) {
    table.add_problem("file", "[motion] needs the key 'file' or the key 'key_poses_deg'");
  }
  if (keyed && columns > 0) motion.key_poses = table.rows(key, columns).value_or(Eigen::MatrixXd(0, columns)) * unit;
  motion.max_frames = table.integer("max_frames", 1, 100'000'000).value_or(motion.max_frames);
  const NumberRange steps = {0.001, 360, shifts ? "mm" : "degrees"};
  motion.step = table.number(shifts ? "step_mm" : "step_deg", steps).value_or(1) * unit;
  motion.time_step = table.number("time_step", {1e-6, 1000, "s"}).value_or(keyed ? 1.0 / 60 : 0);
  if (motion.file.path.empty()) {
    for (const char* bound : {"begin", "end"})
      if (table.has(bound)) table.add_problem(bound, "a motion through key poses is taken as a whole");
  }
  motion.begin = table.number("begin").value_or(motion.begin);
  motion.end = table.number("end").value_or(motion.end);
  table.reject_unknown_keys();
  return motion;
}

static ActivationDescription read_activation(TomlReader table) {
  ActivationDescription activation;
  activation.place = table.place();
  activation.muscles = table.texts("muscle");
  if (activation.muscles.empty() && !table.has("muscle")) table.required_text("muscle");
  activation.value = table.number("value", {0, 1});
  if (const std::optional<std::string> file = table.text("file")) {
    activation.file = {*file, 1, table.place()};
    activation.column = table.text("column").value_or("");
  }
  activation.coordinate = table.text("coordinate").value_or("");
  if (std::optional<Eigen::MatrixXd> rows = table.rows("points_deg", 2)) {
    activation.points = std::move(*rows);
    for (Index i = 1; i < activation.points.rows(); ++i)
      if (!(activation.points(i, 0) > activation.points(i - 1, 0)))
        table.add_problem("points_deg", "the angles of 'points_deg' do not increase");
    activation.points.col(0) *= radians(1);
  }
  const bool curve = activation.points.rows() > 0 && !activation.coordinate.empty();
  const int ways = activation.value.has_value() + !activation.file.path.empty() + curve;
  if (ways != 1 || table.has("points_deg") != table.has("coordinate")) {
    Problem problem = table.place();
    problem.what = "an activation is given in exactly one way";
    problem.remedy = "give 'value', or 'file', or 'coordinate' with 'points_deg'";
    table.add_problem(problem);
  }
  table.reject_unknown_keys();
  return activation;
}

/// How parts of muscles become one.
static void read_combination(TomlReader& table, ControlUnitDescription& unit) {
  const std::string way = table.text("combine").value_or("sum");
  unit.forces = NamedFile{table.text("forces").value_or(""), 1, table.place()};
  if (const std::optional<CombineParts> combine = find_combination(way)) {
    unit.combine = *combine;
  } else {
    table.add_problem("combine", "there is no way '" + way + "' to combine parts of a muscle",
                      "'sum', 'weighted_mean' or 'maximum'");
  }
  if ((unit.combine == CombineParts::weighted_mean) == unit.forces.path.empty())
    table.add_problem("combine", "'forces' and combine = \"weighted_mean\" need each other",
                      "give both, or neither for the sum or the maximum");
}

static ControlUnitDescription read_control_unit(TomlReader table) {
  ControlUnitDescription unit;
  unit.place = table.place();
  unit.name = table.required_text("name");
  unit.joint = table.required_text("joint");
  const auto file = [&](const char* key) { return NamedFile{table.text(key).value_or(""), 1, table.place()}; };
  unit.samples = file("samples"), unit.motion = file("motion"), unit.results = file("results");
  unit.names = file("names");
  read_combination(table, unit);
  const bool joined = !unit.motion.path.empty() && !unit.results.path.empty();
  const bool tells_how = table.has("motion") || table.has("results") || table.has("names") || table.has("combine");
  if (unit.samples.path.empty() ? !joined : tells_how) {
    Problem problem = table.place();
    problem.what = "the samples of a joint control unit are given in exactly one way";
    problem.remedy = "give 'samples', or 'motion' and 'results'";
    table.add_problem(problem);
  }
  unit.coordinates = table.texts("coordinates");
  unit.muscles = table.texts("muscles");
  unit.falloff = table.number("falloff", {0, 1e9, "1/deg²"}).value_or(0);
  table.reject_unknown_keys();
  return unit;
}

// ---- References between elements

template <class Description>
static void reject_duplicates(const std::vector<Description>& list, const std::string& kind,
                              std::vector<Problem>& problems) {
  std::map<std::string, Problem> first;
  for (const Description& element : list) {
    const auto [found, inserted] = first.emplace(element.name, element.place);
    if (inserted || element.name.empty()) continue;
    Problem problem = element.place;
    problem.what = kind + " '" + element.name + "' stands twice";
    problem.remedy = "the first one is at " + found->second.file + ":" + found->second.where;
    problems.push_back(problem);
  }
}

static void require_known(const std::string& name, const std::vector<std::string>& known, const std::string& kind,
                          const Problem& place, std::vector<Problem>& problems) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  Problem problem = place;
  problem.what = "there is no " + kind + " '" + name + "'";
  problem.remedy = suggestion(name, known);
  problems.push_back(problem);
}

static SectionCorner read_corner(TomlReader& table, const std::string& prefix) {
  SectionCorner corner;
  corner.section = table.integer(prefix + "section", 0, 1'000'000).value_or(0);
  corner.ray = table.integer(prefix + "ray", 0, 1'000'000).value_or(0);
  return corner;
}

static TransversalDescription read_transversal(TomlReader table) {
  TransversalDescription description;
  description.place = table.place();
  description.muscle = table.required_text("muscle");
  description.transversal.moved = read_corner(table, "");
  description.other = table.text("other_muscle").value_or("");
  description.transversal.other = read_corner(table, "other_");
  description.bones = table.texts("bones");
  table.reject_unknown_keys();
  return description;
}

static void check_references(const SceneDescription& scene, std::vector<Problem>& problems) {
  std::vector<std::string> bones, bodies, coordinates;
  for (const BoneDescription& bone : scene.bones) {
    bones.push_back(bone.name);
    if (std::find(bodies.begin(), bodies.end(), bone.body) == bodies.end()) bodies.push_back(bone.body);
  }
  // A body without a bone is known by the joint that moves it or that it carries; a misspelled one then hangs on
  // nothing, which the scene's validation finds.
  for (const JointDescription& joint : scene.joints) {
    bodies.push_back(joint.parent);
    bodies.push_back(joint.child);
    for (const JointAxis& axis : joint.joint.axes) coordinates.push_back(axis.coordinate);
  }
  for (const MuscleDescription& muscle : scene.muscles) {
    reject_duplicates(muscle.attachments, "attachment", problems);
    const ActionLineDescription& line = muscle.action_line;
    for (const auto* names : {&line.bodies, &line.path.point_bodies, &line.path.wrap_bodies})
      for (const std::string& body : *names) require_known(body, bodies, "body", muscle.place, problems);
    for (const auto& point : line.path.coordinates)
      for (const std::string& coordinate : point)
        if (!coordinate.empty()) require_known(coordinate, coordinates, "coordinate", muscle.place, problems);
    for (const AttachmentDescription& attachment : muscle.attachments) {
      for (const std::string& bone : attachment.bones) require_known(bone, bones, "bone", attachment.place, problems);
      require_known(attachment.body, bodies, "body", attachment.place, problems);
      if (!attachment.clouds.empty() && scene.landmarks.path.empty()) {
        Problem problem = attachment.place;
        problem.what = "attachment '" + attachment.name + "' names a cloud but the scene names no landmark file";
        problem.remedy = "add [landmarks] with 'file' and 'unit'";
        problems.push_back(problem);
      }
    }
  }
  for (const JointDescription& joint : scene.joints)
    for (const JointAxis& axis : joint.joint.axes) {
      const auto& named = scene.motion.coordinates;
      const bool moved =
          scene.motion.key_poses.rows() > 0 && std::find(named.begin(), named.end(), axis.coordinate) != named.end();
      if (!moved || axis.translation == scene.motion.translations) continue;
      Problem problem = scene.motion.place;
      problem.what = "'" + axis.coordinate + (axis.translation ? "' is a translation" : "' is a rotation");
      problem.remedy = axis.translation ? "give 'key_poses_mm'" : "give 'key_poses_deg'";
      problems.push_back(problem);
    }
  for (const std::string& coordinate : scene.motion.coordinates) {
    require_known(coordinate, coordinates, "coordinate", scene.motion.place, problems);
  }
  // All muscles of the scene count, also those that --only leaves out.
  std::vector<std::string> muscles, joints;
  for (const MuscleDescription& muscle : scene.muscles) muscles.push_back(muscle.name);
  for (const JointDescription& joint : scene.joints) joints.push_back(joint.joint.name);
  for (const ActivationDescription& activation : scene.activations) {
    for (const std::string& name : activation.muscles)
      require_known(name, muscles, "muscle", activation.place, problems);
    require_known(activation.coordinate, coordinates, "coordinate", activation.place, problems);
  }
  for (const TransversalDescription& each : scene.transversals) {
    require_known(each.muscle, muscles, "muscle", each.place, problems);
    require_known(each.other, muscles, "muscle", each.place, problems);
    for (const std::string& bone : each.bones) require_known(bone, bones, "bone", each.place, problems);
  }
  for (const ControlUnitDescription& unit : scene.control_units) {
    require_known(unit.joint, joints, "joint", unit.place, problems);
    for (const std::string& name : unit.muscles) require_known(name, muscles, "muscle", unit.place, problems);
    for (const std::string& name : unit.coordinates)
      require_known(name, coordinates, "coordinate", unit.place, problems);
  }
  reject_duplicates(scene.bones, "bone", problems);
  reject_duplicates(scene.muscles, "muscle", problems);
}

static void keep_only(std::vector<MuscleDescription>& muscles, const std::vector<std::string>& only, Problem place,
                      std::vector<Problem>& problems) {
  if (only.empty()) return;
  std::vector<std::string> names;
  for (const MuscleDescription& muscle : muscles) names.push_back(muscle.name);
  for (const std::string& name : only) require_known(name, names, "muscle", place, problems);
  std::erase_if(muscles, [&](const MuscleDescription& muscle) {
    return std::find(only.begin(), only.end(), muscle.name) == only.end();
  });
}

static void read_axes(TomlReader& top, AnatomicalAxes& axes) {
  const Vec3 anterior = top.vector("anterior").value_or(axes.anterior);
  const Vec3 superior = top.vector("superior").value_or(axes.superior);
  if (!(anterior.norm() > 0 && superior.norm() > 0 &&
        std::abs(anterior.normalized().dot(superior.normalized())) < 0.1)) {
    top.add_problem(top.has("superior") ? "superior" : "anterior", "'anterior' and 'superior' are not at right angles",
                    "give both, as in anterior = [0, -1, 0] and superior = [0, 0, 1]");
    return;
  }
  axes.superior = superior.normalized();
  axes.anterior = (anterior - anterior.dot(axes.superior) * axes.superior).normalized();
}

/// The method that is named, else the preset's.
static const MethodEntry& start_from_preset(TomlReader& top, SceneDescription& scene) {
  scene.preset = top.text("preset").value_or(std::string(presets().front().name));
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  const std::optional<Preset> preset = find_preset(scene.preset);
  if (!preset)
    top.add_problem("preset", "there is no preset '" + scene.preset + "'", suggestion(scene.preset, names));
  else
    scene.method.name = preset->method.name;
  const MethodEntry& method = read_method(top, scene.method);
  if (!preset) return method;
  if (preset->method.name == scene.method.name) scene.method = preset->method;
  scene.distance_fields = preset->distance_fields;
  return method;
}

template <class Settings>
static void read_section(TomlReader& top, const std::string& key, Settings& settings) {
  std::optional<TomlReader> section = top.table(key);
  if (!section) return;
  section->read_settings(settings);
  section->reject_unknown_keys();
}

/// Whether a muscle's wish counts instead of another one: the larger number, and the later of what is no number.
static bool counts_before(const SettingValue& wish, const SettingValue& other) {
  const auto number_in = [](const SettingValue& value) -> std::optional<Real> {
    if (const int* integer = std::get_if<int>(&value)) return *integer;
    const Real* number = std::get_if<Real>(&value);
    return number ? std::optional(*number) : std::nullopt;
  };
  const std::optional<Real> own = number_in(wish), others = number_in(other);
  return !own || !others || *own > *others;
}

/// What muscles are solved with together is the scene's: the largest value that a muscle asks for.
static void share_settings(const MethodEntry& method, SceneDescription& scene) {
  for (const DescribedSetting& setting : method.settings) {
    const std::string key(setting.key);
    bool is_given = false;
    for (MuscleDescription& muscle : scene.muscles) {
      const auto own = muscle.settings.find(key);
      if (!setting.is_shared || own == muscle.settings.end()) continue;
      SettingValue& all = scene.method.settings.emplace(key, setting.default_value).first->second;
      if (counts_before(own->second, all)) all = own->second;
      muscle.settings.erase(own);
      is_given = true;
    }
    if (is_given)
      scene.notes.push_back("'" + key + "' holds for all muscles together; the largest value given is taken");
  }
}

SceneDescription read_scene_description(const std::filesystem::path& path, const std::vector<std::string>& set,
                                        const std::vector<std::string>& only) {
  const SceneLayers layers = load_scene_layers(path, set);
  std::vector<Problem> problems;
  TomlReader top(layers.table, "the scene file", problems);
  SceneDescription scene;
  scene.files = layers.files;
  scene.notes = layers.notes;

  if (!top.has("schema")) {
    problems.push_back({path.string(), "", "the scene file does not say which schema it follows", "add: schema = 1"});
  } else if (top.number("schema").value_or(0) != 1) {
    top.add_problem("schema", "only schema 1 is known to this version");
  }
  scene.name = top.text("name").value_or(path.stem().string());
  const MethodEntry& method = start_from_preset(top, scene);
  read_axes(top, scene.axes);
  std::set<std::string> of_other_methods, of_other_contact;
  const auto read_for_all = [&](const char* key, std::vector<DescribedSetting> MethodEntry::*which,
                                SettingValues& values, std::set<std::string>& others) {
    std::optional<TomlReader> section = top.table(key);
    if (!section) return;
    read_method_settings(*section, method, which, values, others);
    section->reject_unknown_keys();
  };
  read_for_all("settings", &MethodEntry::settings, scene.method.settings, of_other_methods);
  read_for_all("contact", &MethodEntry::contact, scene.method.contact, of_other_contact);
  read_section(top, "distance_field", scene.distance_fields);
  read_section(top, "sequence", scene.sequence);
  FiberSettings fibers;
  read_section(top, "fibers", fibers);
  ContractionSettings contraction;
  if (const std::optional<Preset> preset = find_preset(scene.preset)) contraction = preset->contraction;
  read_section(top, "contraction", contraction);
  if (top.has("prepare")) read_section(top, "prepare", scene.prepare.emplace());
  if (std::optional<TomlReader> landmarks = top.table("landmarks")) {
    scene.landmarks = named_file(*landmarks, landmarks->required_text("file"));
    landmarks->reject_unknown_keys();
  }
  for (TomlReader& bone : top.tables("bones")) scene.bones.push_back(read_bone(std::move(bone)));
  for (TomlReader& joint : top.tables("joints")) scene.joints.push_back(read_joint(std::move(joint)));
  for (TomlReader& muscle : top.tables("muscles"))
    scene.muscles.push_back(read_muscle(std::move(muscle), method, fibers, contraction, of_other_methods));
  share_settings(method, scene);
  if (!of_other_methods.empty()) scene.notes.push_back(note_on_others(scene.method.name, of_other_methods));
  if (std::optional<TomlReader> motion = top.table("motion")) scene.motion = read_motion(std::move(*motion));
  for (TomlReader& each : top.tables("activations")) scene.activations.push_back(read_activation(std::move(each)));
  for (TomlReader& unit : top.tables("joint_control_units"))
    scene.control_units.push_back(read_control_unit(std::move(unit)));
  for (TomlReader& each : top.tables("transversals")) scene.transversals.push_back(read_transversal(std::move(each)));
  check_references(scene, problems);
  const Problem only_place = top.has("only") ? place_of(*top.find("only")) : Problem{};
  keep_only(scene.muscles, top.texts("only"), only_place, problems);
  keep_only(scene.muscles, only, {"--only", "", "", ""}, problems);
  top.reject_unknown_keys();
  sort_by_place(problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  return scene;
}

}  // namespace gracilis
