#include <gracilis/draft/dictionary.hpp>

#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace gracilis::embedded {
extern const std::string_view words_toml, bones_toml, spine_toml, joints_toml, muscles_lower_toml, muscles_upper_toml,
    muscles_trunk_toml, tendons_toml;
}

namespace gracilis {
namespace {

std::vector<std::string> texts(const toml::node_view<const toml::node> list) {
  std::vector<std::string> result;
  if (const toml::array* array = list.as_array())
    for (const toml::node& each : *array) result.push_back(each.value_or(std::string()));
  return result;
}

std::set<std::string> text_set(const toml::node_view<const toml::node> list) {
  const std::vector<std::string> all = texts(list);
  return {all.begin(), all.end()};
}

std::vector<Real> numbers(const toml::node_view<const toml::node> list) {
  std::vector<Real> result;
  if (const toml::array* array = list.as_array())
    for (const toml::node& each : *array) result.push_back(each.value_or(0.0));
  return result;
}

Vec3 vector_of(const toml::node_view<const toml::node> list) {
  const std::vector<Real> values = numbers(list);
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : Vec3::Zero();
}

WordTables read_words(const toml::table& table) {
  WordTables words{
      text_set(table["right"]), text_set(table["left"]), text_set(table["fillers"]), text_set(table["others"]), {}, {}};
  for (const auto& [key, value] : *table["same"].as_table())
    words.same[std::string(key.str())] = value.value_or(std::string());
  for (const auto& [key, value] : *table["instead"].as_table())
    words.instead[std::string(key.str())] = value.value_or(std::string());
  return words;
}

std::vector<Alias> aliases_of(const std::vector<std::string>& names, const WordTables& words) {
  std::vector<Alias> aliases;
  for (const std::string& name : names) aliases.push_back(read_name(name, words).words);
  std::erase(aliases, Alias{});
  return aliases;
}

std::string numbered(std::string text, long number) {
  for (std::size_t at; (at = text.find("{n}")) != std::string::npos;) text.replace(at, 3, std::to_string(number));
  return text;
}

KnownBone read_known_bone(const toml::table& row, const WordTables& words, long number, long first) {
  const toml::node_view<const toml::node> view(row);
  KnownBone bone;
  bone.name = numbered(view["name"].value_or(std::string()), number);
  bone.segment = numbered(view["segment"].value_or(std::string()), number);
  bone.paired = view["paired"].value_or(false);
  bone.length = view["length"].value_or(0.0);
  bone.place = vector_of(view["place"]) + static_cast<Real>(number - first) * vector_of(view["step"]);
  if (view["ends"]) bone.ends = {vector_of(view["ends"][0]), vector_of(view["ends"][1])};
  std::vector<std::string> names = texts(view["aliases"]);
  for (std::string& name : names) name = numbered(name, number);
  names.push_back(bone.name);
  bone.aliases = aliases_of(names, words);
  return bone;
}

void add_bones(const toml::table& table, Dictionary& known) {
  for (const toml::node& node : *table["bones"].as_array()) {
    const toml::table& row = *node.as_table();
    const std::vector<Real> range = numbers(toml::node_view<const toml::node>(row)["numbers"]);
    const long first = range.empty() ? 0 : std::lround(range[0]), last = range.empty() ? 0 : std::lround(range[1]);
    for (long n = first; n <= last; ++n) known.bones.push_back(read_known_bone(row, known.words, n, first));
  }
}

Site read_site(const std::string& text, bool or_before) {
  Site site{text};
  site.or_before = or_before;
  const std::size_t at = text.find('@'), dash = text.find('-', at == std::string::npos ? text.size() : at);
  if (at == std::string::npos || dash == std::string::npos) return site;
  const std::string_view range = std::string_view(text).substr(at + 1);
  double from = 0, to = 0;
  if (!parse_number(range.substr(0, dash - at - 1), from) || !parse_number(range.substr(dash - at), to)) return site;
  site.bone = text.substr(0, at);
  site.from = from;
  site.to = to;
  return site;
}

std::vector<Site> sites(const toml::node_view<const toml::node> list) {
  std::vector<Site> result;
  for (const std::string& text : texts(list)) {
    std::istringstream alternatives(text);
    bool is_first = true;
    for (std::string each; std::getline(alternatives, each, '|'); is_first = false)
      result.push_back(read_site(each, !is_first));
  }
  return result;
}

void add_muscles(const toml::table& table, Dictionary& known) {
  for (const toml::node& node : *table["muscles"].as_array()) {
    const toml::node_view<const toml::node> row(node);
    std::vector<std::string> names = texts(row["aliases"]);
    const std::string name = row["name"].value_or(std::string());
    names.push_back(name);
    known.muscles.push_back({name, aliases_of(names, known.words), sites(row["origin"]), sites(row["insertion"]),
                             1e-3 * row["fiber_mm"].value_or(0.0)});
  }
}

void add_tendons(const toml::table& table, Dictionary& known) {
  for (const toml::node& node : *table["tendons"].as_array()) {
    const toml::node_view<const toml::node> row(node);
    known.tendons.push_back(
        {row["name"].value_or(std::string()), row["end"].value_or(std::string()) == "origin", texts(row["muscles"])});
  }
}

JointKind joint_kind(const std::string& name) {
  static const std::vector<std::string> names = {"ball", "condyles", "roller", "pivot", "saddle"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::logic_error("joints.toml: unknown kind " + name);
  return static_cast<JointKind>(found - names.begin());
}

KnownCoordinate read_coordinate(const toml::node& node) {
  const toml::node_view<const toml::node> row(node);
  KnownCoordinate coordinate;
  coordinate.name = row["name"].value_or(std::string());
  coordinate.about = row["about"].value_or(std::string());
  const std::vector<Real> range = numbers(row["range"]);
  coordinate.range_min = radians(range.at(0));
  coordinate.range_max = radians(range.at(1));
  if (row["shown"]) coordinate.shown = radians(row["shown"].value_or(0.0));
  return coordinate;
}

void add_joints(const toml::table& table, Dictionary& known) {
  for (const toml::node& node : *table["segments"].as_array()) {
    const toml::node_view<const toml::node> row(node);
    known.segments.push_back({row["name"].value_or(std::string()), row["parent"].value_or(std::string()),
                              row["body"].value_or(std::string()), row["paired"].value_or(false)});
  }
  for (const toml::node& node : *table["joints"].as_array()) {
    const toml::node_view<const toml::node> row(node);
    const std::vector<Real> radius = numbers(row["radius"]);
    KnownJoint joint{row["name"].value_or(std::string()),
                     row["parent"].value_or(std::string()),
                     row["child"].value_or(std::string()),
                     joint_kind(row["kind"].value_or(std::string())),
                     texts(row["convex"]),
                     texts(row["concave"]),
                     radius.at(0),
                     radius.at(1),
                     texts(row["only_with"]),
                     {}};
    for (const toml::node& each : *row["coordinates"].as_array()) joint.coordinates.push_back(read_coordinate(each));
    known.joints.push_back(std::move(joint));
  }
}

/// Bending back and forth, aside and turning, as far as the level's row and its region say.
std::vector<KnownCoordinate> coordinates_of(const std::string& level, const std::vector<Real>& turns,
                                            const toml::node_view<const toml::node> region) {
  const Real flexion = radians(turns.at(0)) * region["flexion"].value_or(0.0);
  const Real bending = radians(turns.at(1)), turning = radians(turns.at(2));
  return {{level + "_FE", "right", -flexion, radians(turns[0]) - flexion, -flexion * region["shown"].value_or(0.0)},
          {level + "_LB", "anterior", -bending, bending, std::nullopt},
          {level + "_AR", "superior", -turning, turning, std::nullopt}};
}

/// The segments and joints of the spine, from below.
void add_spine(const toml::table& table, Dictionary& known) {
  known.segments.push_back(
      {table["root"]["segment"].value_or(std::string()), "", table["root"]["body"].value_or(std::string())});
  for (const toml::node& node : *table["levels"].as_array()) {
    const toml::node_view<const toml::node> row(node);
    const std::string name = row["name"].value_or(std::string()), segment = row["segment"].value_or(std::string()),
                      parent = row["parent"].value_or(std::string());
    const toml::node_view<const toml::node> region = table["regions"][row["region"].value_or(std::string())];
    known.segments.push_back({segment, parent, row["body"].value_or(std::string())});
    known.joints.push_back({name, parent, segment, row["masses"].value_or(false) ? JointKind::masses : JointKind::disc,
                            texts(row["upper"]), texts(row["lower"]), 0, region["radius"].value_or(0.0),
                            texts(region["only_with"]), coordinates_of(name, numbers(row["turns"]), region),
                            texts(region["not_with"])});
  }
}

Dictionary read_dictionary() {
  Dictionary known;
  const auto table = [](std::string_view text, const char* name) { return parse_toml(std::string(text), name); };
  known.words = read_words(table(embedded::words_toml, "words.toml"));
  add_bones(table(embedded::bones_toml, "bones.toml"), known);
  add_spine(table(embedded::spine_toml, "spine.toml"), known);
  add_joints(table(embedded::joints_toml, "joints.toml"), known);
  add_muscles(table(embedded::muscles_lower_toml, "muscles_lower.toml"), known);
  add_muscles(table(embedded::muscles_upper_toml, "muscles_upper.toml"), known);
  add_muscles(table(embedded::muscles_trunk_toml, "muscles_trunk.toml"), known);
  add_tendons(table(embedded::tendons_toml, "tendons.toml"), known);
  return known;
}

}  // namespace

bool KnownTendon::joins(const KnownMuscle& muscle) const {
  return std::find(muscles.begin(), muscles.end(), muscle.name) != muscles.end();
}

const KnownSegment& Dictionary::segment(const std::string& name) const {
  const auto found =
      std::find_if(segments.begin(), segments.end(), [&](const auto& each) { return each.name == name; });
  if (found == segments.end()) throw std::logic_error("joints.toml: unknown segment " + name);
  return *found;
}

const Dictionary& dictionary() {
  static const Dictionary known = read_dictionary();
  return known;
}

std::string with_side(std::string name, BodySide side) {
  if (const std::size_t at = name.find("{s}"); at != std::string::npos) name.replace(at, 3, side_ending(side));
  return name;
}

}  // namespace gracilis
