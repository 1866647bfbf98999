#pragma once

#include <gracilis/core/types.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// The rules by which OpenSim takes a set of FunctionBasedPaths, from its sources (FunctionBasedPath.cpp,
/// MultivariatePolynomialFunction.cpp, ModelFactory.cpp, version 4.6). Nothing of our own reader is used.
namespace gracilis::opensim {

struct RuledPath {
  std::string force;
  std::vector<std::string> coordinates;
  std::vector<Real> coefficients;
  int dimension = 0, order = 0;
};

inline std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// n over k.
inline std::size_t combinations(int n, int k) {
  std::size_t value = 1;
  for (int i = 1; i <= k; ++i) value = value * static_cast<std::size_t>(n - k + i) / static_cast<std::size_t>(i);
  return value;
}

/// What OpenSim would throw about, a sentence each. `components`: absolute paths of the model's forces and coordinates.
inline std::vector<std::string> broken_rules(const std::string& file, const std::set<std::string>& components,
                                             std::vector<RuledPath>* paths = nullptr) {
  std::vector<std::string> broken;
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) broken.push_back(what);
  };
  pugi::xml_document document;
  require(static_cast<bool>(document.load_string(file.c_str())), "is XML");
  const pugi::xml_node root = document.child("OpenSimDocument");
  require(root.attribute("Version").as_int() >= 40500, "FunctionBasedPath came with 4.5");
  const pugi::xml_node set = root.first_child();
  require(std::string(set.name()) == "Set_FunctionBasedPath_" && !set.next_sibling(), "one set and nothing else");
  std::set<std::string> names;
  for (const pugi::xml_node& node : set.child("objects").children()) {
    require(std::string(node.name()) == "FunctionBasedPath", "holds FunctionBasedPaths only");
    RuledPath path{node.attribute("name").as_string(), words_in(node.child("coordinate_paths").text().as_string()), {}};
    require(path.force.starts_with("/forceset/") && components.count(path.force) > 0, path.force + " is a force");
    require(names.insert(path.force).second, path.force + " occurs once");
    require(!path.coordinates.empty(), path.force + " depends on coordinates");
    for (const std::string& coordinate : path.coordinates)
      require(coordinate.starts_with("/jointset/") && components.count(coordinate) > 0,
              coordinate + " is a coordinate");
    const std::set<std::string> different(path.coordinates.begin(), path.coordinates.end());
    require(different.size() == path.coordinates.size(), path.force + " names each coordinate once");
    for (const pugi::xml_node& child : node.children()) {
      static const std::set<std::string> properties = {"coordinate_paths", "length_function", "moment_arm_functions",
                                                       "lengthening_speed_function"};
      require(properties.count(child.name()) > 0, std::string(child.name()) + " is a property");
    }
    const pugi::xml_node function = node.child("length_function").first_child();
    require(std::string(function.name()) == "MultivariatePolynomialFunction" && !function.next_sibling(),
            path.force + " has one polynomial");
    path.dimension = function.child("dimension").text().as_int(-1);
    path.order = function.child("order").text().as_int(-1);
    for (const std::string& word : words_in(function.child("coefficients").text().as_string())) {
      char* end = nullptr;
      path.coefficients.push_back(std::strtod(word.c_str(), &end));
      require(*end == '\0' && std::abs(path.coefficients.back()) < 1e300, word + " is a finite number");
    }
    require(path.dimension == static_cast<int>(path.coordinates.size()), path.force + " takes as many arguments");
    require(path.dimension >= 1 && path.dimension <= 6, path.force + " takes up to six");
    require(path.order >= 1, path.force + " has a derivative");
    require(path.order >= 1 && path.coefficients.size() == combinations(path.dimension + path.order, path.order),
            path.force + " has a coefficient for each term");
    if (paths) paths->push_back(path);
  }
  return broken;
}

/// The polynomial's value by the order of terms that MultivariatePolynomialFunction.h lists: the last argument's power
/// grows fastest, the first one's slowest.
inline Real ruled_value(const RuledPath& path, const std::vector<Real>& q) {
  std::vector<int> powers(q.size(), 0);
  Real sum = 0;
  for (std::size_t term = 0; term < path.coefficients.size(); ++term) {
    Real product = path.coefficients[term];
    for (std::size_t i = 0; i < q.size(); ++i)
      for (int k = 0; k < powers[i]; ++k) product *= q[i];
    sum += product;
    for (std::size_t i = q.size(); i-- > 0;) {
      ++powers[i];
      int total = 0;
      for (const int power : powers) total += power;
      if (total <= path.order) break;
      powers[i] = 0;
    }
  }
  return sum;
}

/// Absolute paths of the muscles, coordinates and bodies in a model's text, as it stands in its sets.
inline std::set<std::string> components_of(const std::string& model) {
  pugi::xml_document document;
  document.load_string(model.c_str());
  const pugi::xml_node root = document.child("OpenSimDocument").child("Model");
  std::set<std::string> components = {"/ground"};
  for (const pugi::xml_node& body : root.child("BodySet").child("objects").children())
    components.insert(std::string("/bodyset/") + body.attribute("name").as_string());
  for (const pugi::xml_node& force : root.child("ForceSet").child("objects").children())
    components.insert(std::string("/forceset/") + force.attribute("name").as_string());
  for (const pugi::xml_node& joint : root.child("JointSet").child("objects").children())
    for (const pugi::xml_node& coordinate : joint.child("coordinates").children())
      components.insert(std::string("/jointset/") + joint.attribute("name").as_string() + "/" +
                        coordinate.attribute("name").as_string());
  return components;
}

}  // namespace gracilis::opensim
