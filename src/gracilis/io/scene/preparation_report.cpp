#include <gracilis/io/scene/preparation_report.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gracilis {

static constexpr Real mm = 1e3, cm3 = 1e6;

std::string to_text(const PreparationReport& report) {
  std::string text;
  for (const PreparedMuscleReport& m : report.muscles) {
    text += fmt::format("{}: {} triangles, before {}; volume {:.2f} cm³, before {:.2f} ({:+.2f} %)\n", m.name,
                        m.faces_after, m.faces_before, m.volume_after * cm3, m.volume_before * cm3,
                        100 * (m.volume_after / m.volume_before - 1));
    if (m.pieces > 1) text += fmt::format("  {} closed pieces\n", m.pieces);
    if (!m.repairs.empty()) text += fmt::format("  repaired: {}\n", fmt::join(m.repairs, "; "));
    text += fmt::format("  pulled apart: {} vertices by {:.2f} mm in the mean, {:.2f} mm at most\n", m.vertices_moved,
                        m.mean_displacement * mm, m.max_displacement * mm);
    text += fmt::format("  distance to the input: {:.3f} mm in the mean, {:.2f} mm at most (Hausdorff)\n",
                        m.mean_distance * mm, m.hausdorff * mm);
    text += fmt::format("  edges sharper than 80 degrees: {}, before {}\n", m.sharp_edges_after, m.sharp_edges_before);
    text += fmt::format("  pairs of triangles that cut each other: {}, before {}\n", m.self_intersections_after,
                        m.self_intersections_before);
  }
  for (const PreparedPairReport& p : report.pairs)
    text += fmt::format("{} and {}: {} pairs of triangles cut each other, before {}\n", p.a, p.b, p.intersections_after,
                        p.intersections_before);
  if (!report.pulled_apart) text += "overlaps could not be pulled apart everywhere; muscles that this made swell are as they were before\n";
  text += fmt::format("worst gap missed by {:.3f} mm\n", report.largest_shortfall * mm);
  return text;
}

nlohmann::ordered_json to_json(const PreparationReport& report) {
  nlohmann::ordered_json json;
  json["muscles"] = nlohmann::json::array();
  for (const PreparedMuscleReport& m : report.muscles) {
    json["muscles"].push_back({{"name", m.name},
                               {"repairs", m.repairs},
                               {"triangles_before", m.faces_before},
                               {"triangles", m.faces_after},
                               {"pieces", m.pieces},
                               {"volume_before_cm3", m.volume_before * cm3},
                               {"volume_cm3", m.volume_after * cm3},
                               {"vertices_moved", m.vertices_moved},
                               {"mean_displacement_mm", m.mean_displacement * mm},
                               {"max_displacement_mm", m.max_displacement * mm},
                               {"mean_distance_mm", m.mean_distance * mm},
                               {"hausdorff_mm", m.hausdorff * mm},
                               {"sharp_edges_before", m.sharp_edges_before},
                               {"sharp_edges", m.sharp_edges_after},
                               {"self_intersections_before", m.self_intersections_before},
                               {"self_intersections", m.self_intersections_after}});
  }
  json["pairs"] = nlohmann::json::array();
  for (const PreparedPairReport& p : report.pairs)
    json["pairs"].push_back({{"a", p.a},
                             {"b", p.b},
                             {"intersections_before", p.intersections_before},
                             {"intersections", p.intersections_after}});
  json["pulled_apart"] = report.pulled_apart;
  json["largest_shortfall_mm"] = report.largest_shortfall * mm;
  return json;
}

}  // namespace gracilis
