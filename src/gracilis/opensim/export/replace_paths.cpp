#include <gracilis/opensim/export/replace_paths.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/reader/function_reader.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>

namespace gracilis::opensim {

/// The coordinate that a component's path names, the joint included.
static Index component_coordinate(const XmlContext& context, const pugi::xml_node& node, const Model& model,
                                  const std::string& path) {
  const Index index = index_of(model.coordinates, last_name(path));
  if (index < 0 || coordinate_path(model, index) != path)
    context.fail(node, fmt::format("names the coordinate '{}', which does not exist", path),
                 "write it as /jointset/JOINT/COORDINATE");
  return index;
}

static Path function_path(const XmlContext& context, const pugi::xml_node& node, Model& model) {
  Path path;
  const std::string names = context.text(node, "coordinate_paths");
  for (const std::string_view name : words_of(names))
    path.function_coordinates.push_back(component_coordinate(context, node, model, std::string(name)));
  const pugi::xml_node function = function_of(node, "length_function");
  if (!function || path.function_coordinates.empty())
    context.fail(node, "needs <coordinate_paths> and a <length_function>", "give both");
  path.length_function = read_function(context, function, path.function_coordinates.size(), model.unsupported);
  const Function& read = path.length_function;
  if (read.kind == Function::Kind::multivariate &&
      (read.dimension != static_cast<int>(path.function_coordinates.size()) || read.order < 1))
    context.fail(node, fmt::format("has a function of {} arguments and order {}", read.dimension, read.order),
                 "give as many as there are coordinates, and an order from 1 on");
  return path;
}

void replace_paths(const std::filesystem::path& set, Model& model) {
  const XmlFile file = read_xml(set);
  const pugi::xml_node root = file.root.child("Set_FunctionBasedPath_");
  if (!root)
    throw InputError({set.string(), "", "holds no Set_FunctionBasedPath_", "name a set of FunctionBasedPaths"});
  const XmlContext context{set, root.child("defaults"), file.version};
  for (const pugi::xml_node& node : root.child("objects").children("FunctionBasedPath")) {
    const std::string name = name_of(node);
    const Index muscle = name.starts_with("/forceset/") ? index_of(model.muscles, name.substr(10)) : -1;
    if (muscle < 0) context.fail(node, "is named as no force of the model", "name it /forceset/MUSCLE");
    model.muscles[static_cast<std::size_t>(muscle)].path = function_path(context, node, model);
  }
}

}  // namespace gracilis::opensim
