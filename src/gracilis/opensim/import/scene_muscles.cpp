#include <gracilis/opensim/import/scene_muscles.hpp>

#include <gracilis/opensim/import/belly_length.hpp>
#include <gracilis/opensim/import/scene_lines.hpp>
#include <gracilis/opensim/import/toml_text.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gracilis::opensim {

/// Where the length of a muscle's belly is from, as a comment.
static const char* belly_text(const Muscle& muscle, const VolumeSettings& settings) {
  if (settings.tendon != TendonPlace::beyond_belly) return "";
  return has_published_belly(muscle) ? "   # a belly as published (Ward et al. 2009), as far as the line allows"
                                     : "   # a belly as pennation and cross-section have it, as far as the line allows";
}

static std::string body_text(const Model& model, Index body) {
  return toml_text(model.bodies[static_cast<std::size_t>(body)].name);
}

static std::string points_text(const Points& points) {
  std::vector<std::string> texts;
  for (const Vec3 point : points.colwise()) texts.push_back(toml_vector(1000 * point));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// Tendons and fibers.
static std::string lengths_text(const ActionLine& line, const char* belly = "") {
  return fmt::format("tendon_mm = {}{}\norigin_tendon_mm = {}\n{}optimal_fiber_mm = {}\npennation_deg = {}\n",
                     1000 * line.tendon, belly, 1000 * line.origin_tendon,
                     line.tendon_sections ? "tendon_sections = true\n" : "", 1000 * line.optimal_fiber,
                     degrees(line.pennation));
}

static std::string line_text(const Model& model, const ActionLine& line, const char* belly) {
  std::vector<std::string> bodies;
  for (const Index body : line.bodies) bodies.push_back(body_text(model, body));
  return lengths_text(line, belly) +
         fmt::format("bodies = [{}]\npoints_mm = {}\n", fmt::join(bodies, ", "), points_text(line.points));
}

static std::string attachment_text(const Model& model, const HeldVertices& held, const std::string& name) {
  return fmt::format("\n[[muscles.attachments]]\nname = {}\nend = \"{}\"\nbody = {}\nvertices = [{}]\n",
                     toml_text(name), held.end == AttachmentEnd::origin ? "origin" : "insertion",
                     body_text(model, held.body), fmt::join(held.vertices, ", "));
}

/// An end's, and where it lies on several bodies the body's, too.
static std::string attachment_name(const Model& model, const HeldVertices& held, const std::vector<HeldVertices>& all) {
  const auto same = [&](const HeldVertices& other) { return other.end == held.end; };
  std::string name = held.end == AttachmentEnd::origin ? "origin" : "insertion";
  if (std::count_if(all.begin(), all.end(), same) > 1)
    name += "_" + model.bodies[static_cast<std::size_t>(held.body)].name;
  return name;
}

std::string muscle_text(const Model& model, const std::string& name, const MuscleVolume& volume,
                        const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                        const VolumeSettings& settings, std::vector<std::string>& left_out) {
  const auto in_model = [&](const ActionLine& line) -> const Muscle& {
    return model.muscles[static_cast<std::size_t>(index_of(model.muscles, line.name))];
  };
  const ActionLine& line = volume.line;
  std::string text = fmt::format("\n[[muscles]]\nname = {}\nfile = {}\n\n[muscles.action_line]\nrays = {}\n",
                                 toml_text(name), toml_text("muscles/" + name + ".vtp"), line.rays);
  if (line.heads.empty()) {
    const Muscle& own = in_model(line);
    text += (line.shares.empty() ? fmt::format("scaling = {}\n", line.scaling)
                                 : fmt::format("parts = {}\n", line.shares.size() - 1)) +
            line_text(model, line, belly_text(own, settings));
    if (line.centers.cols() > 0) text += fmt::format("centers_mm = {}\n", points_text(line.centers));
    text += line_path_text(model, own, poses, coordinates, "muscles.action_line", left_out);
  } else {
    text += fmt::format("side = {}\n", line.side) + lengths_text(line);
  }
  for (const ActionLine& head : line.heads) {
    const Muscle& own = in_model(head);
    text += fmt::format("\n[[muscles.action_line.heads]]\nname = {}\nmax_isometric_force_n = {}\n{}shares = [{}]\n",
                        toml_text(head.name), head.max_isometric_force,
                        line_text(model, head, belly_text(own, settings)), fmt::join(head.shares, ", "));
    text += line_path_text(model, own, poses, coordinates, "muscles.action_line.heads", left_out);
  }
  for (const HeldVertices& held : volume.held)
    text += attachment_text(model, held, attachment_name(model, held, volume.held));
  return text;
}

}  // namespace gracilis::opensim
