#pragma once

#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <set>
#include <string>

/// What the readers of a model's parts share.
namespace gracilis::opensim {

/// A file being read into a model.
struct ModelReading {
  XmlContext context;
  Model& model;
  std::set<std::string> told{model.unsupported.begin(), model.unsupported.end()};  ///< so that nothing is told twice

  /// What a path such as "/bodyset/femur_r" or "femur_r_offset" names, seen from inside `owner`.
  PlacedFrame frame(const pugi::xml_node& node, const std::string& reference, const std::string& owner) const;
  /// Whether the reference names a frame that has been read.
  bool knows_frame(const pugi::xml_node& node, const std::string& reference) const;
  /// Index of the coordinate that a name or path names.
  Index coordinate(const pugi::xml_node& node, const std::string& reference) const;
  /// Remembers that something of an element is not taken over.
  void leave_out(const pugi::xml_node& node, const std::string& what);
};

}  // namespace gracilis::opensim
