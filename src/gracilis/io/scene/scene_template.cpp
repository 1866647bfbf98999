#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/setting_table.hpp>

namespace gracilis {

/// One line of comment and one of value for each setting; values are those of the default preset.
static std::string section(const std::string& title, const std::vector<DescribedSetting>& table) {
  std::string text = "[" + title + "]\n";
  for (const DescribedSetting& setting : table) {
    text += "# " + std::string(setting.meaning) + "\n# " + expectation(setting) + "\n";
    text += std::string(setting.key) + " = " + to_text(setting.default_value) + "\n\n";
  }
  return text;
}
template <class Settings>
static std::string section(const std::string& title) {
  return section(title, describe_settings<Settings>());
}

static std::string method_section() {
  std::string text = "# Optional: how muscles are deformed; the first is the default:\n";
  for (const MethodEntry& method : methods())
    text += "#   \"" + std::string(method.name) + "\": " + std::string(method.meaning) + "\n";
  return text + "method = \"" + std::string(methods().front().name) + "\"\n\n";
}

static std::string preset_section() {
  std::string text = "# The settings to start from:\n";
  for (const Preset& preset : presets()) {
    text += "#   \"" + std::string(preset.name) + "\": " + std::string(preset.meaning) + "\n";
  }
  return text + "# A preset sets aside the settings of included files. Settings below replace the preset's.\n" +
         "preset = \"" + std::string(presets().front().name) + "\"\n\n";
}

static constexpr const char* head =
    R"(# A scene for Gracilis. Keys may come in any order; those that say "optional" may be left out.
# Files are looked for beside this one, then in the data folder (--data, GRACILIS_DATA, or shared/data next to the scene's
# folder or above it). Units of files and keys are named; all else is metres, kilograms, seconds.
schema = 1

# Optional: appears in the run's manifest; default: the file's name.
name = "example"

# Optional: how the subject stands in the frame of the files, for views of pictures; defaults as in OpenSim's models.
anterior = [1, 0, 0]
superior = [0, 1, 0]

# Optional: what nobody measured, in words; repeated in each run's manifest.
# guessed = ["joint hip_r: a sphere on the femur's head"]

# Optional: other scene files, relative to this one, on which this one builds. Tables merge key by key, lists of tables
# (bones, muscles, ...) by their names; what stands here wins. [motion] is replaced as a whole.
# include = ["base.toml"]

)";

static constexpr const char* only_some = R"(# Optional: keep these muscles only.
# only = ["gluteus_maximus_r"]

)";

static constexpr const char* elements =
    R"(# Optional: a table with the columns cloud, index, x_mm, y_mm, z_mm (rows of a cloud in their order), for attachments.
[landmarks]
file = "landmarks.csv"
unit = "mm" # "m" (default), "cm" or "mm"

# Rigid surfaces, in the pose in which everything was captured, all in one frame. Formats: .ply .stl .obj .vtk .vtp .glb
[[bones]]
name = "hip_bone_r"
body = "pelvis" # the body it belongs to; default: its own name
file = "hip_bone_r.ply"
unit = "mm" # "m" (default), "cm" or "mm"

[[bones]]
name = "femur_r"
file = "femur_r.ply"
unit = "mm"
# part = "femur" # optional, of a bone, a muscle or a patch in a .glb: the node or mesh of this name alone
mirror = false # optional, of a bone, a muscle or a patch: what is right of the plane through the frame's origin goes left
# Instead of a file, of a bone or a muscle: a box, each side cut into cells.
# box = { size_mm = [200, 200, 10], center_mm = [0, 0, 0], cells = [1, 1, 1] }

# What moves. Exactly one body is the child of no joint: it is fixed in the world.
[[joints]]
name = "hip_r"
parent = "pelvis"
child = "femur_r"
center = [0.143478, 0.243439, -0.43267]
center_unit = "m"                    # "m" (default), "cm" or "mm"
orientation_xyz_rad = [0.0, 0.0, 0.0] # optional: the joint's frame, body-fixed X, Y, Z angles as in OpenSim models

# Rotations in their order, each about an axis fixed in the frame left by the ones before; with translation = true a shift
# along the axis, with capture_mm and range_mm.
[[joints.axes]]
coordinate = "hip_flexion_r"
axis = [0, 0, 1]
capture_deg = 0.0     # optional: the coordinate's value when the surfaces were captured; default 0
range_deg = [-30, 120] # optional: leaving it is warned about, never clamped; default -180 to 180

[[muscles]]
name = "gluteus_maximus_r"
file = "gluteus_maximus_r.ply"
unit = "mm"
piece = "all"          # optional: the surface may consist of several closed pieces; "largest" keeps only one

# Optional: any key of [settings] below, for this muscle alone. Also wins over --set KEY=VALUE; --set MUSCLE.KEY=VALUE wins
# over it.
[muscles.settings]
distance_stiffness = 5.0

# Optional: any key of [fibers] below, for this muscle alone; and
# file = "fibers.vtp"     # lines to use instead (.vtk, .vtp, .csv, .tck or .trk), with unit = "m" (default, of .tck and
#                         # .trk "mm"), "cm" or "mm"
# tracts = "tracts.trk"   # instead of 'file': fascicles as measured, noisy and cut short, that fibers are made to run like
# pennation_deg = 25      # instead of 'pennation'
# lines = "superficial"   # "inner" (default): they are the fibers; "superficial": they lie on the surface, fill it in
[muscles.fibers]
count = 100

# Optional: any key of [contraction] below, for this muscle alone; and
# file = "lines.vtp"      # lines drawn on the surface along which it contracts, with unit = "m" (default), "cm" or "mm"
[muscles.contraction]
threshold = 0.02

# Optional: the line that the muscle's surface was made about, as 'gracilis import' writes it: sections of so many corners
# where the line is divided into so many equal parts; or, with 'scaling' instead, at its points and between them where
# each part is halved so often.
# [muscles.action_line]
# rays = 12
# parts = 30                                     # or scaling = 3
# points_mm = [[-100, 20, 60], [-70, -220, 130]] # origin first
# bodies = ["pelvis", "femur_r"]                 # of each point
# tendon_mm = 40                                 # optional: length at the insertion; origin_tendon_mm likewise
# tendon_sections = true                         # optional: a section more where each tendon ends
# optimal_fiber_mm = 110                         # optional, with pennation_deg: for forces of 'export --to tetrahedra'
# centers_mm = [[...], ...]                      # optional: of all sections, where they lie beside the line
# optional: how the line runs in other poses, where its points do not stay on their bodies. A point that is there within
# a range, or always; or that moves, each component with a coordinate (rows: degrees, mm, mm per degree) or not at all:
# [[muscles.action_line.path]]
# body = "femur_r"
# point_mm = [-70, -200, 130]
# condition = "knee_angle_r"    # optional, with range_deg (of a translation: range_mm)
# range_deg = [-120, -40]
# [[muscles.action_line.path]]
# body = "tibia_r"
# frame_mm = [-70, -420, 130]   # and orientation_xyz_rad: the frame that x, y and z are in
# x = { coordinate = "knee_angle_r", curve_deg = [[-120, 20, 0.1], [0, 30, 0]] } # of a translation: curve_mm
# y = { mm = -40 }
# And surfaces that it runs around, between these of its points (counted from 0):
# [[muscles.action_line.wraps]]
# kind = "cylinder"             # "cylinder", "sphere", "ellipsoid", "torus"
# body = "femur_r"
# center_mm = [-70, -400, 130]  # and orientation_xyz_rad
# radius_mm = 25                # of an ellipsoid radii_mm; of a torus also ring_radius_mm
# length_mm = 100               # of a cylinder
# side = "+x"                   # optional: on this side only
# first_point = 0
# last_point = 3
# Of a sheet over several heads' lines ('gracilis import --merge-heads') the table has rays and side alone, and each head
# has its own points, tendons, path and wraps:
# [[muscles.action_line.heads]]
# name = "glut_max1_r"          # in the model; activations of a table are the mean of the heads' columns
# max_isometric_force_n = 573   # weighs them
# shares = [0, 0.1, 0.2, 1]     # where its sections lie along its line, as many in all heads

# At least one origin and one insertion, or none at all. Which vertices are held follows from the keys given, in one of six ways:
# 1. 'bone' and landmarks: within bone_distance_mm of the bone and landmark_distance_mm of the landmarks.
[[muscles.attachments]]
name = "ilium"
end = "origin"      # "origin" or "insertion"
bone = "hip_bone_r" # one name or several, ["hip_bone_r", "sacrum"]; the vertices move with its body
cloud = "ilium"     # names of clouds in the landmark file; or points_mm = [[x, y, z], ...]
line = "closed"     # "cloud" (default): separate points; "open": a line through them; "closed": an outline and its inside,
                    # seen in its plane; "outline": points around an area in any order, and its inside on the bone
bone_distance_mm = 4
landmark_distance_mm = 12
# aponeurosis = ["sheet.ply"] # optional, for any of the six: surfaces in the muscle or on it, tendon spread along
# unit = "mm"                 # the belly, on which fibers end instead

# 2. 'body' and landmarks, where the bone is not in the scene: within landmark_distance_mm of them.
[[muscles.attachments]]
name = "vertebrae"
end = "origin"
body = "pelvis"
points_mm = [[140.0, 230.0, -300.0]]
landmark_distance_mm = 12
guessed = true # optional: not measured; marked so in the run's manifest

# 3. 'vertices': exactly these, counted from 0 in the file's order.
[[muscles.attachments]]
name = "linea_aspera"
end = "insertion"
body = "femur_r"
vertices = [10, 11, 12]

# 4. 'bone' alone: within bone_distance_mm of it.
[[muscles.attachments]]
name = "trochanter"
end = "insertion"
bone = "femur_r"
bone_distance_mm = 3

# 5. 'patch': within landmark_distance_mm of an open surface that lies on the bone; of its pieces those count that are nearest
# to 'bone', and bone_distance_mm may be given, too.
# [[muscles.attachments]]
# name = "ischium"
# end = "origin"
# bone = "hip_bone_r"
# patch = "patches/adductor_magnus_r.ply"
# unit = "mm"
# landmark_distance_mm = 3

# 6. 'muscle': within muscle_distance_mm of another muscle of the scene, whose motion it follows and which it pulls at (a
# tendon that two share, a belly that another arises from). Landmarks, 'patch' or 'vertices' may say where, as on a bone.
# [[muscles.attachments]]
# name = "quadriceps_tendon"
# end = "insertion"
# muscle = "vastus_intermedius_r"
# muscle_distance_mm = 1

# Optional, for method = "cylinder": a section that gives way. It stays on its side of another muscle's section, to whose
# corner its own is joined, and out of that muscle and of bones.
# [[transversals]]
# muscle = "gluteus_maximus_r"
# section = 5                  # counted from the origin, from 0
# ray = 3                      # corner of the section
# other_muscle = "gluteus_medius_r"
# other_section = 4
# other_ray = 9
# bones = ["femur_r"]

# Optional: how active muscles are, 0 to 1, in one way for each; those not named are relaxed.
# 1. A constant:
[[activations]]
muscle = "gluteus_maximus_r" # one name or several
value = 0.3
# 2. A column of a table over time; default: the one with the muscle's name.   file = "activation.sto", column = "glut_max1_r"
# 3. A function of a coordinate, linear between points:   coordinate = "hip_flexion_r", points_deg = [[0, 0.1], [90, 0.6]]
# 4. A joint control unit: what went with the nearest of sampled poses ('gracilis activations join' makes the samples).
# [[joint_control_units]]
# name = "hip"
# joint = "hip_r"
# samples = "samples.sto"         # or: motion = "walk.mot", results = "activation.sto", names = "names.toml" (optional)
# combine = "sum"                 # of files: a muscle's parts become one by their "sum", "maximum" or "weighted_mean",
#                                 # which needs forces = "force.sto"
# coordinates = ["hip_flexion_r"] # optional: that tell samples apart; default: all of the joint
# muscles = ["iliacus_r"]         # optional: that it governs; default: all that the samples know
# falloff = 0.02                  # optional: F in exp(-F d²), 1/deg²; default: from the samples' spacing
# neighbors = 10                  # optional: K, how many of the nearest samples are asked
# hit_deg = 1e-6                  # optional: a sample no farther than this is the answer

# Optional: without a motion a run is frame 0, the capture pose, alone.
[motion]
# Either an OpenSim table (.mot, .sto), whose columns are matched to the joints' coordinates by name; with 'coordinates',
# these columns only:
# file = "flexion.mot"     # optional with it: begin and end (s), and time_step, the least time between rows that are kept
# or key poses with equal steps between them:
coordinates = ["hip_flexion_r"]
key_poses_deg = [[0], [90]] # one row per pose, one column per coordinate; coordinates not named keep their capture value
# (of translations: key_poses_mm and step_mm)
step_deg = 1                # largest change of a coordinate per frame; default 1
time_step = 0.016666666666666666 # s between frames; default 1/60
# max_frames = 1000000      # optional: a motion that asks for more is refused, since more come of a slip in a step

)";

/// Of [prepare], what is no number.
static constexpr const char* only_apart =
    R"(# Optional: only these are pulled apart: "a" from all others, which stay, and from bones, "a:b" each from the other alone.
apart = ["gluteus_maximus_r", "gluteus_medius_r:piriformis_r"]
)";

/// A section with every line a comment.
static std::string commented_out(std::string text) {
  std::string commented = "# ";
  text.resize(text.find_last_not_of('\n') + 1);
  for (char c : text) commented += c == '\n' ? std::string("\n# ") : std::string(1, c);
  return commented + "\n\n";
}

std::string scene_template() {
  const MethodEntry& usual = methods().front();
  std::string text =
      head + method_section() + only_some + preset_section() + elements +
      "# How a run goes from the capture pose into the motion and out of it.\n" + section<Sequence>("sequence") +
      "# Optional: repairs, remeshes and pulls apart all muscles at first use; needs a program built with it.\n" +
      commented_out(section<PrepareSettings>("prepare") + only_apart) +
      "# Surfaces of all muscles, when they are read.\n" + section<SurfaceSettings>("surfaces") +
      "# Distance fields of all bones.\n" + section<DistanceFieldSettings>("distance_field") +
      "# Contact between muscles.\n" + section("contact", usual.contact) + "# Fibers inside all muscles.\n" +
      section<FiberSettings>("fibers") + "# How active muscles contract.\n" +
      section<ContractionSettings>("contraction") + "# The method '" + std::string(usual.name) +
      "', for all muscles.\n" + section("settings", usual.settings);
  for (const MethodEntry& method : methods())
    if (&method != &usual && !method.settings.empty())
      text += "# With method = \"" + std::string(method.name) + "\" instead:\n" +
              commented_out(section("settings", method.settings));
  return text;
}

template <class Settings>
static std::string values(const std::string& title, const Settings& settings) {
  std::string text = title + "\n";
  for (const auto& [key, value] : list_settings(settings)) text += key + " = " + to_text(value) + "\n";
  return text;
}

/// Those of a method: the first of `given` that has a value, else the default.
static std::string values(const std::string& title, const std::vector<DescribedSetting>& table,
                          std::initializer_list<const SettingValues*> given) {
  if (table.empty()) return {};
  std::string text = title + "\n";
  for (const DescribedSetting& setting : table) {
    SettingValue value = setting.default_value;
    for (const SettingValues* layer : given)
      if (const auto found = layer->find(setting.key); found != layer->end()) {
        value = found->second;
        break;
      }
    text += std::string(setting.key) + " = " + to_text(value) + "\n";
  }
  return text;
}

std::string settings_text(const Scene& scene) {
  const MethodEntry& method = method_of(scene);
  std::string text = "method = \"" + scene.method.name + "\"\n" + values("[sequence]", scene.sequence) +
                     values("[distance_field]", scene.distance_fields) +
                     values("[contact]", method.contact, {&scene.method.contact});
  for (const Muscle& muscle : scene.muscles) {
    text += "[[muscles]]\nname = \"" + muscle.name + "\"\n" +
            values("[muscles.settings]", method.settings, {&muscle.settings, &scene.method.settings}) +
            values("[muscles.fibers]", muscle.fibers) + values("[muscles.contraction]", muscle.contraction);
  }
  return text;
}

}  // namespace gracilis
