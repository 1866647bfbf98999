#include <gracilis/opensim/reader/xml.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/io/xml_text.hpp>
#include <gracilis/opensim/reader/old_versions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gracilis::opensim {

/// Length of the character of UTF-8 that begins here; 0: none does.
static std::size_t character_at(const std::string& bytes, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u; };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  if ((first == 0xe0 && byte(i + 1) < 0xa0) || (first == 0xed && byte(i + 1) > 0x9f) ||
      (first == 0xf0 && byte(i + 1) < 0x90) || (first == 0xf4 && byte(i + 1) > 0x8f))
    return 0;
  return length;
}

/// What is not UTF-8 is taken for Latin-1, byte by byte, so that names stay apart and can be written again.
static std::string valid_utf8(const std::string& bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t length = character_at(bytes, i);
    if (length > 0) {
      text.append(bytes, i, length);
    } else {
      const auto byte = static_cast<unsigned char>(bytes[i]);
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
    i += std::max<std::size_t>(length, 1);
  }
  return text;
}

XmlFile read_xml(const std::filesystem::path& path) {
  const std::string bytes = valid_utf8(read_text(path));
  XmlFile file{path, std::make_shared<pugi::xml_document>(), {}, 0};
  parse_xml(path, bytes, "is not XML", "save it again with OpenSim", *file.document);
  file.root = file.document->child("OpenSimDocument");
  if (!file.root) throw InputError({path.string(), "", "is no OpenSim document", "is it an OpenSim file?"});
  file.version = file.root.attribute("Version").as_int();
  if (file.version < 10000)
    throw InputError({path.string(), "",
                      fmt::format("has document version '{}'; 10000 (OpenSim 1.0) is the oldest that can be read",
                                  file.root.attribute("Version").value()),
                      "open it in OpenSim 3 or 4 and save it"});
  if (file.version < 30000) bring_to_version_3(file.root, file.version);
  return file;
}

void XmlContext::fail(const pugi::xml_node& node, const std::string& what, const std::string& remedy) const {
  throw InputError({path.string(), fmt::format("{} '{}'", node.name(), name_of(node)), what, remedy});
}

pugi::xml_node XmlContext::property(const pugi::xml_node& node, const char* name) const {
  const pugi::xml_node own = node.child(name);
  return own ? own : defaults.child(node.name()).child(name);
}

std::string XmlContext::text(const pugi::xml_node& node, const char* name) const {
  const char* content = property(node, name).child_value();
  return std::string(trimmed(content));
}

std::vector<Real> XmlContext::numbers(const pugi::xml_node& node, const char* name) const {
  const std::string content = text(node, name);
  std::vector<Real> values;
  for (const std::string_view word : words_of(content)) {
    Real number = 0;
    // Ranges and limits may have no end, everything else has a size.
    const std::string_view key = name;
    const bool endless = key == "range" || key == "min_control" || key == "max_control";
    if (!parse_number(word, number) || std::isnan(number) || (std::isinf(number) && !endless))
      fail(node,
           fmt::format("<{}> holds '{}', which is {}", name, word.substr(0, 40),
                       std::isinf(number) ? "not finite" : "not a number"),
           "correct it");
    values.push_back(number);
  }
  return values;
}

Real XmlContext::number(const pugi::xml_node& node, const char* name, Real otherwise) const {
  const std::vector<Real> values = numbers(node, name);
  if (values.size() > 1) fail(node, fmt::format("<{}> holds {} numbers instead of one", name, values.size()), "");
  return values.empty() ? otherwise : values[0];
}

Vec3 XmlContext::vector(const pugi::xml_node& node, const char* name, const Vec3& otherwise) const {
  const std::vector<Real> values = numbers(node, name);
  if (values.empty()) return otherwise;
  if (values.size() != 3) fail(node, fmt::format("<{}> holds {} numbers instead of 3", name, values.size()), "");
  return {values[0], values[1], values[2]};
}

bool XmlContext::boolean(const pugi::xml_node& node, const char* name, bool otherwise) const {
  std::string content = text(node, name);
  if (content.empty()) return otherwise;
  // As Simbody reads them.
  std::transform(content.begin(), content.end(), content.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (content == "true" || content == "1") return true;
  if (content == "false" || content == "0") return false;
  fail(node, fmt::format("<{}> is '{}'; it must be true or false", name, content), "correct it");
}

std::string XmlContext::socket(const pugi::xml_node& node, const std::string& name, const char* old_name) const {
  for (const std::string& key : {"socket_" + name, "socket_" + name + "_connectee_name"})
    if (const pugi::xml_node child = node.child(key.c_str())) return std::string(trimmed(child.child_value()));
  for (const pugi::xml_node& connector : node.child("connectors").children())
    if (name_of(connector) == name) return std::string(trimmed(connector.child_value("connectee_name")));
  return std::string(trimmed(node.child_value(old_name)));
}

std::vector<pugi::xml_node> objects_of(const pugi::xml_node& parent, const char* set) {
  const pugi::xml_node below = parent.child(set);
  std::vector<pugi::xml_node> nodes;
  for (const pugi::xml_node& node : (below.child("objects") ? below.child("objects") : below).children())
    if (node.type() == pugi::node_element && std::string_view(node.name()) != "groups") nodes.push_back(node);
  return nodes;
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string name_of(const pugi::xml_node& node) { return node.attribute("name").value(); }

}  // namespace gracilis::opensim
