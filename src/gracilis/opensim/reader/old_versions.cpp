#include <gracilis/opensim/reader/old_versions.hpp>

#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <vector>

namespace gracilis::opensim {

/// Names that elements had, and their present ones.
static const std::map<std::string_view, const char*> new_names = {{"MusclePoint", "PathPoint"},
                                                                  {"MuscleViaPoint", "ConditionalPathPoint"},
                                                                  {"MovingMusclePoint", "MovingPathPoint"},
                                                                  {"MusclePointSet", "PathPointSet"},
                                                                  {"MuscleWrap", "PathWrap"},
                                                                  {"MuscleWrapSet", "PathWrapSet"},
                                                                  {"natCubicSpline", "SimmSpline"},
                                                                  {"NatCubicSpline", "SimmSpline"},
                                                                  {"Schutte1993Muscle", "Schutte1993Muscle_Deprecated"},
                                                                  {"Thelen2003Muscle_Old", "Thelen2003Muscle"},
                                                                  {"XAttachment", "x_location"},
                                                                  {"YAttachment", "y_location"},
                                                                  {"ZAttachment", "z_location"}};

static void rename_all(const pugi::xml_node& root) {
  struct Renamer : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (const auto found = new_names.find(node.name()); found != new_names.end()) node.set_name(found->second);
      return true;
    }
  } renamer;
  pugi::xml_node all = root;
  all.traverse(renamer);
}

/// All elements of this name, found before any of them is changed.
static std::vector<pugi::xml_node> elements_called(const char* name, const pugi::xml_node& root) {
  struct Finder : pugi::xml_tree_walker {
    std::string_view name;
    std::vector<pugi::xml_node> found;
    bool for_each(pugi::xml_node& node) override {
      if (node.name() == name) found.push_back(node);
      return true;
    }
  } finder;
  finder.name = name;
  pugi::xml_node all = root;
  all.traverse(finder);
  return finder.found;
}

/// Forces that hold points themselves get a path that holds them.
static void give_paths(const pugi::xml_node& root) {
  for (const pugi::xml_node& points : elements_called("PathPointSet", root)) {
    pugi::xml_node holder = points.parent();
    if (std::string_view(holder.name()) == "GeometryPath") continue;
    pugi::xml_node path = holder.append_child("GeometryPath");
    for (const char* set : {"PathPointSet", "PathWrapSet"})
      if (const pugi::xml_node own = holder.child(set)) path.append_move(own);
  }
}

/// A custom joint's axes stood in one set, each with one <coordinate>: those that turn are rotations in their order,
/// the others translations in theirs.
static void order_axes(pugi::xml_node joint) {
  if (!joint.child("TransformAxisSet")) return;
  pugi::xml_node transform = joint.append_child("SpatialTransform");
  int rotations = 0, translations = 0;
  for (const pugi::xml_node& old : objects_of(joint, "TransformAxisSet")) {
    const bool turns = lower_case(trimmed(old.child_value("is_rotation"))) == "true";
    const int number = turns ? ++rotations : ++translations;
    pugi::xml_node axis = transform.append_copy(old);
    axis.remove_attribute("name");
    axis.append_attribute("name") = fmt::format("{}{}", turns ? "rotation" : "translation", number).c_str();
    axis.child("coordinate").set_name("coordinates");
  }
  joint.remove_child("TransformAxisSet");
}

/// <DynamicsEngine><SimbodyEngine> holds bodies and constraints of version 1.
static void lift_engine(const pugi::xml_node& root) {
  pugi::xml_node model = root.child("Model");
  const pugi::xml_node holder = model.child("DynamicsEngine");
  const pugi::xml_node engine = holder.first_child().child("BodySet") ? holder.first_child() : holder;
  for (const char* set : {"BodySet", "ConstraintSet", "CoordinateSet"})
    if (!model.child(set) && engine.child(set)) model.append_move(engine.child(set));
}

void bring_to_version_3(const pugi::xml_node& document, int version) {
  rename_all(document);
  if (version <= 20301)
    for (pugi::xml_node& angle : elements_called("pennation_angle", document))
      angle.set_name("pennation_angle_at_optimal");
  if (version < 10901)
    for (const pugi::xml_node& joint : elements_called("CustomJoint", document)) order_axes(joint);
  give_paths(document);
  lift_engine(document);
  pugi::xml_node model = document.child("Model");
  if (!model.child("ForceSet") && model.child("ActuatorSet")) model.child("ActuatorSet").set_name("ForceSet");
}

}  // namespace gracilis::opensim
