#include <gracilis/opensim/kinematics/external_loads.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/reader/model_file.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>

namespace gracilis::opensim {

/// The three columns that begin with an identifier; none where there is no identifier.
static std::vector<Function> functions_of(const XmlContext& context, const pugi::xml_node& node, const char* name,
                                          const Table& table) {
  const std::string identifier = context.text(node, name);
  if (identifier.empty() || identifier == "Unassigned") return {};
  std::vector<Function> functions;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (!table.columns[i].starts_with(identifier)) continue;
    const Eigen::VectorXd column = table.values.col(static_cast<Eigen::Index>(i));
    functions.push_back(table.times.size() < 2
                            ? constant(column[0])
                            : natural_spline(table.times, {column.data(), column.data() + column.size()}));
  }
  if (functions.size() != 3)
    context.fail(node,
                 fmt::format("{} columns of its table begin with '{}' instead of 3", functions.size(), identifier),
                 fmt::format("correct <{}>", name));
  return functions;
}

static Index body_named(const XmlContext& context, const pugi::xml_node& node, const char* name, const Model& model) {
  const std::string body = last_name(context.text(node, name));
  const Index index = body.empty() ? 0 : index_of(model.bodies, body);
  if (index < 0) context.fail(node, fmt::format("names the body '{}', which the model does not have", body), "");
  return index;
}

ExternalLoads read_external_loads(const Model& model, const std::filesystem::path& path) {
  const XmlFile file = read_xml(path);
  const pugi::xml_node loads_node = file.root.child("ExternalLoads");
  if (!loads_node) throw InputError({path.string(), "", "holds no external loads", "name another file"});
  const XmlContext context{path, loads_node.child("defaults"), file.version};
  const Table table = read_table(file_beside(path, context.text(loads_node, "datafile")));
  ExternalLoads loads;
  loads.begin = table.times.front();
  loads.end = table.times.back();
  for (const pugi::xml_node& node : objects_of(loads_node, "objects")) {
    if (std::string_view(node.name()) != "ExternalForce") continue;
    if (!context.boolean(node, "appliesForce", !context.boolean(node, "isDisabled", false))) continue;
    ExternalForce force;
    force.name = name_of(node);
    force.body = body_named(context, node, "applied_to_body", model);
    force.force_frame = body_named(context, node, "force_expressed_in_body", model);
    force.point_frame = body_named(context, node, "point_expressed_in_body", model);
    force.force = functions_of(context, node, "force_identifier", table);
    force.point = functions_of(context, node, "point_identifier", table);
    force.torque = functions_of(context, node, "torque_identifier", table);
    loads.forces.push_back(std::move(force));
  }
  return loads;
}

static Vec3 at(const std::vector<Function>& functions, Real time) {
  return {value(functions[0], {time}), value(functions[1], {time}), value(functions[2], {time})};
}

void add_loads(const ExternalLoads& loads, Real time, const std::vector<RigidTransform>& poses, BodyForces& forces) {
  const auto pose = [&](Index body) { return poses[static_cast<std::size_t>(body)]; };
  for (const ExternalForce& load : loads.forces) {
    const RigidTransform on = pose(load.body), frame = pose(load.force_frame);
    if (!load.force.empty()) {
      const Vec3 point = load.point.empty() ? Vec3(on.translation()) : pose(load.point_frame) * at(load.point, time);
      add_force(forces, load.body, on, point, frame.linear() * at(load.force, time));
    }
    if (!load.torque.empty()) forces.col(load.body).head<3>() += frame.linear() * at(load.torque, time);
  }
}

}  // namespace gracilis::opensim
