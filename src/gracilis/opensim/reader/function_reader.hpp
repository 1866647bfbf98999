#pragma once

#include <gracilis/opensim/functions/function.hpp>
#include <gracilis/opensim/reader/xml.hpp>

namespace gracilis::opensim {

/// The function that a Function element describes (Constant, LinearFunction, PolynomialFunction, SimmSpline and
/// NaturalCubicSpline, which OpenSim takes for its old name, PiecewiseLinearFunction, MultivariatePolynomialFunction,
/// or a MultiplierFunction of one), of `arguments` arguments. Kinds that are not known are added to `unsupported` and
/// become zero. Throws InputError: knots that do not increase, counts that do not fit, nesting deeper than 100.
Function read_function(const XmlContext& context, pugi::xml_node node, std::size_t arguments,
                       std::vector<std::string>& unsupported);

/// The first child of `node` that is a function, under `<function>` (3.x) or directly below (4.x); empty when there is
/// none.
pugi::xml_node function_below(const pugi::xml_node& node);

/// The function that is this property of an element, in each of the forms in which OpenSim reads it: below an element
/// of the property's name, named so itself, or without a name. Empty when there is none.
pugi::xml_node function_of(const pugi::xml_node& node, const char* property);

}  // namespace gracilis::opensim
