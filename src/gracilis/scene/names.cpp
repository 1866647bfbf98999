#include <gracilis/scene/names.hpp>

#include <algorithm>
#include <cctype>

namespace gracilis {

static bool fits_anywhere(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 && (std::isalnum(byte) || c == '_' || c == '-' || c == '.');
}

bool fits_file_name(std::string_view name) {
  return !name.empty() && name[0] != '.' && name.size() <= longest_name &&
         std::all_of(name.begin(), name.end(), fits_anywhere);
}

bool fits_column(std::string_view name) {
  const auto is_blank = [](char c) { return c == ' '; };
  const auto is_separator = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f || c == ',' || c == '"';
  };
  if (name.empty() || is_blank(name.front()) || is_blank(name.back())) return false;
  if (std::any_of(name.begin(), name.end(), is_separator)) return false;
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower != "time";
}

std::string file_name_of(std::string_view text) {
  std::string name(text.substr(0, longest_name));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !fits_anywhere(c); }, '_');
  if (name.starts_with('.')) name[0] = '_';
  return name.empty() ? "unnamed" : name;
}

std::string file_name_of(std::string_view text, std::set<std::string>& taken) {
  const std::string wanted = file_name_of(text);
  std::string name = wanted;
  for (int i = 2; !taken.insert(name).second; ++i) {
    const std::string number = "_" + std::to_string(i);
    name = wanted.substr(0, longest_name - number.size()) + number;
  }
  return name;
}

const std::vector<std::string>& measure_columns() {
  static const std::vector<std::string> columns = {"volume_ratio",
                                                   "edge_ratio_mean",
                                                   "edge_ratio_max",
                                                   "edge_ratio_max_free",
                                                   "edge_ratio_max_near",
                                                   "spike",
                                                   "thickening",
                                                   "thinning",
                                                   "dihedral_change_mean_deg",
                                                   "dihedral_change_max_deg",
                                                   "hinges_over_90",
                                                   "vertex_depth_mm",
                                                   "vertex_depth_beyond_rest_mm",
                                                   "midpoint_depth_beyond_rest_mm",
                                                   "muscle_depth_beyond_rest_mm",
                                                   "belly_off_place_mm",
                                                   "wrong_side_share",
                                                   "slack",
                                                   "activation",
                                                   "fiber_strain_mean",
                                                   "cross_section_cm2",
                                                   "physiological_cross_section_cm2",
                                                   "milliseconds"};
  return columns;
}

}  // namespace gracilis
