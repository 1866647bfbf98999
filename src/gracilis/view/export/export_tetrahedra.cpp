#include <gracilis/view/export/export_tetrahedra.hpp>

#include <gracilis/anatomy/sections/tetrahedra.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/tetrahedra_writer.hpp>
#include <gracilis/scene/section_line.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <optional>

namespace gracilis {

static Points read_points(const nlohmann::ordered_json& rows) {
  Points points(3, static_cast<Eigen::Index>(rows.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      points(k, i) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(k)).get<Real>();
  return points;
}

/// A muscle's line as the run's manifest has it; no rays where it has none.
static ActionLine recorded_line(const RecordedRun& run, const std::string& muscle) {
  ActionLine line;
  try {
    if (!run.manifest.contains("action_lines") || !run.manifest.at("action_lines").contains(muscle)) return line;
    const auto& json = run.manifest.at("action_lines").at(muscle);
    const auto count = [&](const char* key, Index most) {
      const std::optional<Index> number = whole_number<Index>(json.at(key).get<Real>(), 0, most);
      if (!number)
        throw InputError({(run.folder / "run.json").string(), muscle, std::string("'") + key + "' is no count",
                          "run the scene again"});
      return *number;
    };
    line.rays = count("rays", 1000);
    line.scaling = count("scaling", 16);
    line.shares = json.value("shares", std::vector<Real>{});
    line.tendon = json.at("tendon_m").get<Real>();
    line.origin_tendon = json.at("origin_tendon_m").get<Real>();
    line.tendon_sections = json.value("tendon_sections", false);
    line.optimal_fiber = json.at("optimal_fiber_m").get<Real>();
    line.pennation = json.at("pennation_rad").get<Real>();
    line.points = read_points(json.at("points_m"));
    line.centers = read_points(json.at("centers_m"));
  } catch (const nlohmann::json::exception& error) {
    throw InputError({(run.folder / "run.json").string(), muscle, error.what(), "run the scene again"});
  }
  return line;
}

static void append_sections(std::string& text, const std::string& muscle, int frame, const SectionRings& rings,
                            const std::vector<Real>& places, const ActionLine& line) {
  auto out = std::back_inserter(text);
  for (Index k = 0; k < rings.sections(); ++k) {
    const SectionShape shape = section_shape(rings, k);
    const Real place = places[static_cast<std::size_t>(k)];
    const bool tendon = place < line.origin_tendon || place > places.back() - line.tendon;
    fmt::format_to(out, "{},{},{},{:.3f},{},{:.5f},{:.4f},{}\n", frame, muscle, k, 1000 * place,
                   tendon ? "tendon" : "muscle", 1e4 * shape.area, shape.quotient, shape.convex ? 1 : 0);
  }
}

static void append_muscle(std::string& text, const std::string& muscle, int frame, const Tetrahedra& cells,
                          const ActionLine& line, Real specific_tension) {
  const Real belly = compartment_volume(cells, Compartment::muscle),
             tendon = compartment_volume(cells, Compartment::tendon);
  const Real area = line.optimal_fiber > 0 ? physiological_area(belly, line.pennation, line.optimal_fiber) : 0;
  fmt::format_to(std::back_inserter(text), "{},{},{},{:.4f},{:.4f},{:.3f},{:.4f},{:.2f}\n", frame, muscle,
                 cells.cells.cols(), 1e6 * belly, 1e6 * tendon,
                 1e3 * (belly * muscle_density + tendon * tendon_density), 1e4 * area, area * specific_tension);
}

void export_tetrahedra(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames,
                       Real specific_tension) {
  std::filesystem::create_directories(folder);
  std::string sections = "frame,muscle,section,place_mm,compartment,area_cm2,isoperimetric_quotient,convex\n";
  std::string muscles =
      "frame,muscle,tetrahedra,muscle_volume_cm3,tendon_volume_cm3,mass_g,physiological_cross_section_cm2,force_n\n";
  bool any = false;
  for (const std::string& muscle : run.muscles) {
    const ActionLine line = recorded_line(run, muscle);
    if (line.rays == 0) continue;
    any = true;
    const Points rest = recorded_surface(run, muscle, 0).vertices;
    const bool fits = line.points.cols() >= 2 && (line.shares.empty() || are_shares(line.shares)) &&
                      rest.cols() >= line.rays * section_count(line) + 2;
    const Points fine = fits ? section_line(line).centers : Points(3, 0);
    if (rest.cols() != line.rays * fine.cols() + 2 || (line.centers.cols() > 0 && line.centers.cols() != fine.cols()))
      throw InputError({run.folder.string(), muscle, "is not made of its line's sections", "run the scene again"});
    const std::vector<Real> places = distances_along(fine);
    for (const int frame : frames) {
      const SectionRings rings = rings_of(recorded_surface(run, muscle, frame).vertices, line.rays, rest,
                                          line.centers.cols() > 0 ? line.centers : fine);
      const Tetrahedra cells = tetrahedra_of(rings, places, line.origin_tendon, line.tendon);
      write_tetrahedra(folder / fmt::format("{}_{:04}.vtu", muscle, frame), cells);
      append_sections(sections, muscle, frame, rings, places, line);
      append_muscle(muscles, muscle, frame, cells, line, specific_tension);
    }
  }
  if (!any)
    throw InputError(
        {run.folder.string(), "", "has no muscles made of sections", "import a model, or give action lines"});
  write_text_atomically(folder / "sections.csv", sections);
  write_text_atomically(folder / "muscles.csv", muscles);
}

}  // namespace gracilis
