#pragma once

#include <gracilis/core/types.hpp>

#include <pugixml.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Reading of OpenSim's XML: elements by name with defaults, numbers, and complaints that name file and element.
namespace gracilis::opensim {

/// A parsed file. Document types and entities are not looked at; bytes that are not UTF-8 pass through.
struct XmlFile {
  std::filesystem::path path;
  std::shared_ptr<pugi::xml_document> document;
  pugi::xml_node root;  ///< OpenSimDocument
  int version = 0;      ///< of the document
};

/// Throws InputError with the line where the XML is broken, and where the file is no OpenSim document of version 1.0 or
/// later. One of a version below 3.0 is brought into that form (old_versions).
XmlFile read_xml(const std::filesystem::path& path);

/// A file being read, and what its `<defaults>` say about elements that leave something out.
struct XmlContext {
  std::filesystem::path path;
  pugi::xml_node defaults;
  int version = 0;

  /// Throws InputError about an element, named by its kind and name.
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what, const std::string& remedy) const;

  /// The child element, else that of the defaults for this kind of element; may be empty.
  pugi::xml_node property(const pugi::xml_node& node, const char* name) const;
  /// Its text without white space around it; empty where it is missing.
  std::string text(const pugi::xml_node& node, const char* name) const;
  /// One number; `otherwise` where it is missing, an InputError where it is something else.
  Real number(const pugi::xml_node& node, const char* name, Real otherwise) const;
  /// All of its numbers, none where it is missing; finite but for ranges.
  std::vector<Real> numbers(const pugi::xml_node& node, const char* name) const;
  /// Three numbers; as `number`.
  Vec3 vector(const pugi::xml_node& node, const char* name, const Vec3& otherwise) const;
  /// True or false, 1 or 0, in any case; as `number`.
  bool boolean(const pugi::xml_node& node, const char* name, bool otherwise) const;
  /// What a socket leads to: `<socket_NAME>` (4.x), a connector (3.3 to 4.0 betas) or `<NAME>` (3.x), in this order.
  std::string socket(const pugi::xml_node& node, const std::string& name, const char* old_name) const;
};

/// Elements below `<set><objects>`, or below `<set>` itself.
std::vector<pugi::xml_node> objects_of(const pugi::xml_node& parent, const char* set);

/// "/jointset/knee_r/knee_angle_r" becomes "knee_angle_r".
std::string last_name(const std::string& path);

/// Its attribute `name`; empty where it has none.
std::string name_of(const pugi::xml_node& node);

}  // namespace gracilis::opensim
