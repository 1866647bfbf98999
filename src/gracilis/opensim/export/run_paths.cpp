#include <gracilis/opensim/export/run_paths.hpp>

#include <gracilis/core/median.hpp>
#include <gracilis/opensim/export/xml_text.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gracilis::opensim {

std::string function_path_set(const Model& model, const std::vector<FittedMuscle>& muscles) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40600\">\n"
      "  <Set_FunctionBasedPath_>\n    <objects>\n";
  for (const FittedMuscle& muscle : muscles) {
    std::vector<std::string> coordinates;
    for (const Index i : muscle.coordinates) coordinates.push_back(xml_text(coordinate_path(model, i)));
    text += fmt::format(
        "      <FunctionBasedPath name=\"/forceset/{}\">\n        <coordinate_paths>{}</coordinate_paths>\n"
        "        <length_function>\n          <MultivariatePolynomialFunction>\n"
        "            <coefficients>{}</coefficients>\n            <dimension>{}</dimension>\n"
        "            <order>{}</order>\n          </MultivariatePolynomialFunction>\n        </length_function>\n"
        "      </FunctionBasedPath>\n",
        xml_text(muscle.name), fmt::join(coordinates, " "), fmt::join(muscle.length.coefficients, " "),
        muscle.length.dimension, muscle.length.order);
  }
  return text + "    </objects>\n  </Set_FunctionBasedPath_>\n</OpenSimDocument>\n";
}

static std::string errors_text(const PathErrors& errors) {
  std::string text = fmt::format("lengths {:.3f} mm root mean square, {:.3f} at most; arms ",
                                 1000 * errors.length_root_mean_square, 1000 * errors.length_largest);
  if (errors.arm_largest == 0) return text + "not known";
  return text + fmt::format("{:.3f} mm root mean square, {:.3f} at most", 1000 * errors.arm_root_mean_square,
                            1000 * errors.arm_largest);
}

std::string fit_line(const Model& model, const FittedMuscle& muscle) {
  std::vector<std::string> coordinates;
  for (const Index i : muscle.coordinates) coordinates.push_back(model.coordinates[static_cast<std::size_t>(i)].name);
  std::string line =
      fmt::format("{}: order {} in {}; ", muscle.name, muscle.length.order, fmt::join(coordinates, ", "));
  if (muscle.from_run) return line + fmt::format("held-out poses of the run: {}", errors_text(muscle.beside_run));
  line += fmt::format("held-out poses of the model's path: {}", errors_text(muscle.held_out));
  if (muscle.corrects) line += fmt::format("; held-out poses of the run: {}", errors_text(muscle.beside_run));
  return line;
}

std::string fit_summary(const Model& model, const std::vector<FittedMuscle>& muscles) {
  std::vector<Real> lengths, arms;
  Real worst = 0;
  std::string where;
  const auto add_arm = [&](Real error, const std::string& of) {
    arms.push_back(1000 * error);
    if (arms.back() <= worst) return;
    worst = arms.back();
    where = of;
  };
  for (const FittedMuscle& muscle : muscles) {
    lengths.push_back(1000 * muscle.held_out.length_root_mean_square);
    if (muscle.from_run) {
      if (muscle.held_out.arm_largest > 0) add_arm(muscle.held_out.arm_root_mean_square, muscle.name);
      continue;
    }
    for (Eigen::Index i = 0; i < muscle.arms.size(); ++i) {
      const Index coordinate = muscle.coordinates[static_cast<std::size_t>(i)];
      add_arm(muscle.arms[i], muscle.name + " about " + model.coordinates[static_cast<std::size_t>(coordinate)].name);
    }
  }
  if (lengths.empty()) return "no muscle was written";
  std::string text =
      fmt::format("{} muscles; root mean square on held-out poses: lengths {:.3f} mm (median), {:.3f} (worst)",
                  muscles.size(), median(lengths), *std::max_element(lengths.begin(), lengths.end()));
  if (!arms.empty()) text += fmt::format("; arms {:.3f} mm (median), {:.3f} (worst, {})", median(arms), worst, where);
  return text;
}

}  // namespace gracilis::opensim
