#include <gracilis/opensim/reader/function_reader.hpp>

#include <gracilis/opensim/functions/smoothing_spline.hpp>

#include <fmt/format.h>

#include <cmath>

namespace gracilis::opensim {

static bool is_function(std::string_view name) {
  return name.ends_with("Function") || name.ends_with("Spline") || name == "Constant" || name == "Sine";
}

pugi::xml_node function_below(const pugi::xml_node& node) {
  const pugi::xml_node below = node.child("function");
  for (const pugi::xml_node& child : (below.first_child() ? below : node).children())
    if (is_function(child.name())) return child;
  return {};
}

pugi::xml_node function_of(const pugi::xml_node& node, const char* property) {
  if (const pugi::xml_node holder = node.child(property)) return function_below(holder);
  for (const std::string_view name : {std::string_view(property), std::string_view()})
    for (const pugi::xml_node& child : node.children())
      if (is_function(child.name()) && name_of(child) == name) return child;
  return {};
}

static void check_coefficients(const XmlContext& context, const pugi::xml_node& node, const std::vector<Real>& values,
                               std::size_t count) {
  if (values.size() == count) return;
  context.fail(node, fmt::format("has {} coefficients where {} are needed", values.size(), count), "correct them");
}

static Function read_smoothing_spline(const XmlContext& context, const pugi::xml_node& node, const std::vector<Real>& x,
                                      const std::vector<Real>& y) {
  SmoothingSplineSettings settings;
  const Real half_order = context.number(node, "half_order", 3);
  if (!(half_order >= 1 && half_order <= 4) || half_order != std::floor(half_order) || x.size() < 2 * half_order ||
      x.size() > 1000)
    context.fail(node, fmt::format("has the half order {} and {} points", half_order, x.size()),
                 "a half order from 1 to 4, twice as many points or more, and at most 1000, can be read");
  settings.half_order = static_cast<int>(half_order);
  settings.weights = context.numbers(node, "weights");
  for (const Real weight : settings.weights)
    if (!(weight > 0)) context.fail(node, fmt::format("has the weight {}", weight), "weights must be above zero");
  if (!settings.weights.empty() && settings.weights.size() != x.size())
    context.fail(node, fmt::format("has {} weights for {} points", settings.weights.size(), x.size()), "give as many");
  settings.error_variance = context.number(node, "error_variance", 0);
  return smoothing_spline(x, y, settings);
}

static Function read_knots(const XmlContext& context, const pugi::xml_node& node) {
  const std::vector<Real> x = context.numbers(node, "x"), y = context.numbers(node, "y");
  if (x.size() < 2 || x.size() != y.size())
    context.fail(node, fmt::format("has {} values x and {} values y", x.size(), y.size()),
                 "give as many of both, and two at least");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] <= x[i - 1]) context.fail(node, fmt::format("x does not increase after {}", x[i - 1]), "sort the points");
  const std::string_view kind = node.name();
  if (kind == "GCVSpline") return read_smoothing_spline(context, node, x, y);
  // What is called NaturalCubicSpline never was one: OpenSim reads it as its new name, SimmSpline.
  if (kind == "SimmSpline" || kind == "NaturalCubicSpline") return simm_spline(x, y);
  return piecewise_linear(x, y);
}

static Function read_multivariate(const XmlContext& context, const pugi::xml_node& node, std::size_t arguments) {
  Function function;
  function.kind = Function::Kind::multivariate;
  const Real dimension = context.number(node, "dimension", 0), order = context.number(node, "order", 0);
  if (!(dimension >= 1 && dimension <= 6 && order >= 0 && order <= 12))
    context.fail(node, fmt::format("has {} dimensions and order {}", dimension, order),
                 "up to 6 dimensions and order 12 can be read");
  function.dimension = static_cast<int>(dimension);
  function.order = static_cast<int>(order);
  if (dimension != static_cast<Real>(arguments))
    context.fail(node, fmt::format("takes {} arguments but is given {} coordinates", dimension, arguments), "");
  function.coefficients = context.numbers(node, "coefficients");
  check_coefficients(context, node, function.coefficients, monomials(function.dimension, function.order).size());
  return function;
}

static Function read_plain(const XmlContext& context, const pugi::xml_node& node, std::size_t arguments,
                           std::vector<std::string>& unsupported) {
  const std::string_view kind = node.name();
  if (kind == "Constant") return constant(context.number(node, "value", 0));
  if (kind == "Sine") {
    if (arguments < 1) context.fail(node, "is a function of a coordinate but is given none", "name the coordinate");
    return sine(context.number(node, "amplitude", 1), context.number(node, "omega", 1),
                context.number(node, "phase", 0), context.number(node, "offset", 0));
  }
  if (kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "PiecewiseLinearFunction" ||
      kind == "GCVSpline") {
    if (arguments < 1) context.fail(node, "is a function of a coordinate but is given none", "name the coordinate");
    return read_knots(context, node);
  }
  if (kind == "MultivariatePolynomialFunction") return read_multivariate(context, node, arguments);
  if (kind == "LinearFunction" || kind == "PolynomialFunction") {
    Function function;
    function.kind = kind == "LinearFunction" ? Function::Kind::linear : Function::Kind::polynomial;
    function.coefficients = context.numbers(node, "coefficients");
    if (kind == "LinearFunction") check_coefficients(context, node, function.coefficients, arguments + 1);
    if (kind == "PolynomialFunction" && (function.coefficients.empty() || arguments < 1))
      context.fail(node, "needs coefficients and a coordinate", "give both");
    return function;
  }
  unsupported.push_back(fmt::format("function {} (read as zero)", kind));
  return constant(0);
}

Function read_function(const XmlContext& context, pugi::xml_node node, std::size_t arguments,
                       std::vector<std::string>& unsupported) {
  Real scale = 1;
  for (int depth = 0; std::string_view(node.name()) == "MultiplierFunction"; ++depth) {
    if (depth == 100) context.fail(node, "is nested more than 100 times", "multiply the scales");
    scale *= context.number(node, "scale", 1);
    const pugi::xml_node inner = function_below(node);
    if (!inner) context.fail(node, "multiplies no function", "give one in <function>");
    node = inner;
  }
  Function function = read_plain(context, node, arguments, unsupported);
  function.scale = scale;
  return function;
}

}  // namespace gracilis::opensim
