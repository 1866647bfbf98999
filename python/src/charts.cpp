#include "charts.hpp"

#include "arrays.hpp"
#include "errors.hpp"

#include <gracilis/view/charts/line_chart.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

namespace py = pybind11;

namespace gracilis::python {

static std::vector<Real> numbers_of(const py::handle& object, const std::string& what) {
  const Eigen::VectorXd values = values_from(object, what);
  return {values.begin(), values.end()};
}

/// The picture of curves by muscles' names over a common axis.
static std::string muscle_curves_svg(const std::string& title, const std::string& x_label, const std::string& y_label,
                                     const py::object& x, const py::dict& curves) {
  LineChart chart{title, x_label, y_label, {}};
  const std::vector<Real> shared = numbers_of(x, x_label);
  for (const auto& [key, values] : curves) {
    const std::string muscle = py::str(key).cast<std::string>();
    std::vector<Real> y = numbers_of(values, muscle);
    if (y.size() != shared.size()) refuse(muscle, "must have as many values as there are along the axis");
    chart.series.push_back({muscle, shared, std::move(y), muscle_color(muscle), 2});
  }
  return to_svg(chart);
}

void bind_charts(py::module_& module) { module.def("muscle_curves_svg", &muscle_curves_svg); }

}  // namespace gracilis::python
