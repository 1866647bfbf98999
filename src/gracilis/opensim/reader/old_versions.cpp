#include <gracilis/opensim/reader/old_versions.hpp>

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
                                                                  {"Thelen2003Muscle_Old", "Thelen2003Muscle"}};

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

/// Forces that hold points themselves get a path that holds them.
static void give_paths(const pugi::xml_node& root) {
  struct Finder : pugi::xml_tree_walker {
    std::vector<pugi::xml_node> holders;
    bool for_each(pugi::xml_node& node) override {
      if (std::string_view(node.name()) == "PathPointSet" && std::string_view(node.parent().name()) != "GeometryPath")
        holders.push_back(node.parent());
      return true;
    }
  } finder;
  pugi::xml_node all = root;
  all.traverse(finder);
  for (pugi::xml_node& holder : finder.holders) {
    pugi::xml_node path = holder.append_child("GeometryPath");
    for (const char* set : {"PathPointSet", "PathWrapSet"})
      if (const pugi::xml_node own = holder.child(set)) path.append_move(own);
  }
}

/// <DynamicsEngine><SimbodyEngine> holds bodies and constraints of version 1.
static void lift_engine(const pugi::xml_node& root) {
  pugi::xml_node model = root.child("Model");
  const pugi::xml_node holder = model.child("DynamicsEngine");
  const pugi::xml_node engine = holder.first_child().child("BodySet") ? holder.first_child() : holder;
  for (const char* set : {"BodySet", "ConstraintSet", "CoordinateSet"})
    if (!model.child(set) && engine.child(set)) model.append_move(engine.child(set));
}

void bring_to_version_3(const pugi::xml_node& document) {
  rename_all(document);
  give_paths(document);
  lift_engine(document);
  pugi::xml_node model = document.child("Model");
  if (!model.child("ForceSet") && model.child("ActuatorSet")) model.child("ActuatorSet").set_name("ForceSet");
}

}  // namespace gracilis::opensim
