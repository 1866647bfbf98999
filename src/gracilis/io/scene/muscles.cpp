#include <gracilis/io/scene/muscles.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/scene/attachments.hpp>
#include <gracilis/io/scene/bodies.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/method_reader.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/scene/section_line.hpp>

namespace gracilis::sections {

/// A file of lines. Formats of tractography are in mm, whatever others are in.
static NamedFile line_file(TomlReader& table, const std::string& path) {
  NamedFile file = named_file(table, path);
  const std::string extension = lower_case_extension(path);
  if (!table.has("unit") && (extension == ".trk" || extension == ".tck")) file.unit = 0.001;
  return file;
}

static void read_fibers(TomlReader table, MuscleDescription& description) {
  FiberSettings& fibers = description.muscle.fibers;
  table.read_settings(fibers);
  if (table.has("pennation_deg")) {
    if (table.has("pennation")) table.add_problem("pennation_deg", "'pennation' is given twice, in rad and in degrees");
    fibers.pennation = radians(table.number("pennation_deg", {-68, 68, "degrees"}).value_or(degrees(fibers.pennation)));
  }
  if (const std::optional<std::string> file = table.text("file")) description.fiber_file = line_file(table, *file);
  if (const std::optional<std::string> file = table.text("tracts")) description.tract_file = line_file(table, *file);
  if (table.has("file") && table.has("tracts"))
    table.add_problem("tracts", "'file' holds the fibers themselves, 'tracts' what fibers are made from",
                      "keep one of the two");
  const std::string kind = table.text("lines").value_or("inner");
  description.muscle.given_are_superficial = kind == "superficial";
  if (kind != "inner" && kind != "superficial") {
    table.add_problem("lines", "'lines' must be \"inner\" or \"superficial\"");
  } else if (table.has("lines") && description.fiber_file.path.empty()) {
    table.add_problem("lines", "'lines' says what the key 'file' holds, which is missing");
  }
  table.reject_unknown_keys();
}

static void read_contraction(TomlReader table, MuscleDescription& description) {
  table.read_settings(description.muscle.contraction);
  if (const std::optional<std::string> file = table.text("file"))
    description.surface_fiber_file = line_file(table, *file);
  table.reject_unknown_keys();
}

/// What the table of a line and that of a sheet's head have in common.
static void read_line(TomlReader& table, ActionLine& line, LineDescription& description) {
  const auto length = [&](const char* key) { return table.number(key, {0, 10'000, "mm"}).value_or(0) / 1000; };
  line.tendon = length("tendon_mm");
  line.origin_tendon = length("origin_tendon_mm");
  line.optimal_fiber = length("optimal_fiber_mm");
  line.pennation = radians(table.number("pennation_deg", {0, 89}).value_or(0));
  description.bodies = table.texts("bodies");
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("points_mm", 3)) line.points = rows->transpose() / 1000;
  if (line.points.cols() != static_cast<Index>(description.bodies.size()))
    table.add_problem("bodies", "'bodies' must name a body for each of 'points_mm'");
  description.path = read_line_path(table);
}

/// One of the lines of a sheet.
static void read_head(TomlReader table, ActionLine& head, LineDescription& description) {
  head.name = table.required_text("name");
  head.max_isometric_force = table.number("max_isometric_force_n", {0, 1e6, "N"}).value_or(0);
  head.shares = table.numbers("shares");
  read_line(table, head, description);
  table.reject_unknown_keys();
}

static void read_action_line(TomlReader table, MuscleDescription& description) {
  ActionLine& line = description.muscle.action_line;
  if (!table.has("rays")) table.required_number("rays");
  line.rays = table.integer("rays", 6, 1000).value_or(6);
  line.side = table.integer("side", 1, 1000).value_or(0);
  for (TomlReader& head : table.tables("heads")) {
    line.heads.emplace_back().rays = line.rays;
    read_head(std::move(head), line.heads.back(), description.heads.emplace_back());
  }
  line.scaling = table.integer("scaling", 0, 16).value_or(0);
  if (const std::optional<Index> parts = table.integer("parts", 1, 10000)) line.shares = even_shares(*parts);
  line.tendon_sections = table.flag("tendon_sections").value_or(false);
  if (!line.shares.empty() && (table.has("scaling") || line.tendon_sections))
    table.add_problem("parts", "'parts' puts all sections: it cannot stand beside 'scaling' or 'tendon_sections'");
  if (const std::optional<Eigen::MatrixXd> rows = table.rows("centers_mm", 3)) line.centers = rows->transpose() / 1000;
  read_line(table, line, description.line);
  table.reject_unknown_keys();
}

MuscleDescription read_muscle(TomlReader table, const MuscleDefaults& defaults, std::set<std::string>& others) {
  MuscleDescription description;
  Muscle& muscle = description.muscle;
  description.place = table.place();
  muscle.name = table.required_text("name");
  description.surface = read_surface(table);
  const std::string piece = table.text("piece").value_or("all");
  description.surface.largest_piece = piece == "largest";
  if (piece != "all" && piece != "largest") table.add_problem("piece", "'piece' must be \"all\" or \"largest\"");
  muscle.fibers = defaults.fibers;
  muscle.contraction = defaults.contraction;
  if (std::optional<TomlReader> own = table.table("fibers")) read_fibers(std::move(*own), description);
  if (std::optional<TomlReader> own = table.table("contraction")) read_contraction(std::move(*own), description);
  if (std::optional<TomlReader> line = table.table("action_line")) read_action_line(std::move(*line), description);
  if (std::optional<TomlReader> settings = table.table("settings")) {
    read_method_settings(*settings, defaults.method, &MethodEntry::settings, muscle.settings, others);
    settings->reject_unknown_keys();
  }
  for (TomlReader& attachment : table.tables("attachments"))
    description.attachments.push_back(read_attachment(std::move(attachment)));
  table.reject_unknown_keys();
  return description;
}

static void place_line(ActionLine& line, const LineDescription& description, Scene& scene) {
  const auto index = [&](const std::string& body) { return body_index(scene, body); };
  for (const std::string& body : description.bodies) line.bodies.push_back(index(body));
  line.path = place_line_path(description.path, scene, index);
}

/// Lines of a file; none where no file is named.
static void read_lines(SceneInProgress& progress, const NamedFile& file, Polylines& lines) {
  if (file.path.empty()) return;
  read_file(progress, file, [&](const std::filesystem::path& path) { lines = read_polylines(path, file.unit); });
}

/// Tracts in another unit or frame than the muscle say nothing about it.
static void check_tracts(SceneInProgress& progress, const NamedFile& file, const Muscle& muscle) {
  if (muscle.tracts.count() == 0 || muscle.surface.vertex_count() == 0) return;
  if (any_point_within(muscle.surface, muscle.tracts.points)) return;
  progress.add_problem(file.place, "no tract of '" + file.path + "' lies in " + muscle.name,
                       "check the units and that both are in the same frame");
}

void add_muscle(SceneInProgress& progress, SurfaceLoader& surfaces, const MuscleDescription& description) {
  Scene& scene = progress.loaded.scene;
  Muscle& muscle = scene.muscles.emplace_back(description.muscle);
  read_lines(progress, description.fiber_file, muscle.given_fibers);
  place_line(muscle.action_line, description.line, scene);
  for (std::size_t h = 0; h < description.heads.size(); ++h)
    place_line(muscle.action_line.heads[h], description.heads[h], scene);
  read_lines(progress, description.tract_file, muscle.tracts);
  read_lines(progress, description.surface_fiber_file, muscle.given_surface_fibers);
  const bool is_repaired = surfaces.take(description.surface, SurfaceRole::muscle, muscle.surface);
  check_tracts(progress, description.tract_file, muscle);
  if (!is_repaired) return;
  for (const AttachmentDescription& each : description.attachments) {
    if (!each.attachment.listed) continue;
    progress.add_problem(each.place,
                         "attachment '" + each.attachment.name + "' of " + muscle.name +
                             " lists vertices, but the surface had to be repaired, which may have renumbered them",
                         "write the repaired surface to a file of its own, or describe the attachment by distances");
  }
}

}  // namespace gracilis::sections
