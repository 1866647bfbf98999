#include <gracilis/opensim/function_reader.hpp>

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

static void check_coefficients(const XmlContext& context, const pugi::xml_node& node, const std::vector<Real>& values,
                               std::size_t count) {
  if (values.size() == count) return;
  context.fail(node, fmt::format("has {} coefficients where {} are needed", values.size(), count), "correct them");
}

static Function read_knots(const XmlContext& context, const pugi::xml_node& node) {
  const std::vector<Real> x = context.numbers(node, "x"), y = context.numbers(node, "y");
  if (x.size() < 2 || x.size() != y.size())
    context.fail(node, fmt::format("has {} values x and {} values y", x.size(), y.size()),
                 "give as many of both, and two at least");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] <= x[i - 1]) context.fail(node, fmt::format("x does not increase after {}", x[i - 1]), "sort the points");
  const std::string_view kind = node.name();
  if (kind == "SimmSpline") return simm_spline(x, y);
  return kind == "NaturalCubicSpline" ? natural_spline(x, y) : piecewise_linear(x, y);
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
  if (kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "PiecewiseLinearFunction") {
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
