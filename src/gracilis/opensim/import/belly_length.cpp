#include <gracilis/opensim/import/belly_length.hpp>

#include <gracilis/io/parse_toml.hpp>
#include <gracilis/opensim/import/muscle_names.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace gracilis::embedded {
extern const std::string_view belly_lengths_toml;
}

namespace gracilis::opensim {

/// The published belly on a muscle's line, as a share of the muscle's rest length.
static std::map<std::string, Real> read_shares() {
  std::map<std::string, Real> shares;
  const toml::table table = parse_toml(std::string(embedded::belly_lengths_toml), "belly_lengths.toml");
  for (const toml::node& row : *table["muscles"].as_array()) {
    const toml::node_view<const toml::node> muscle(row);
    const Real length = *muscle["muscle_mm"].value<double>();
    const Real before_line = (length - muscle["fiber_mm"].value_or(length)) / 2;
    const Real share = (length - before_line) / *muscle["rest_mm"].value<double>();
    for (const toml::node& name : *muscle["names"].as_array()) shares[*name.value<std::string>()] = share;
  }
  return shares;
}

static Real rest_length(const Muscle& muscle) {
  return muscle.optimal_fiber_length * std::cos(muscle.pennation_angle_at_optimal) + muscle.tendon_slack_length;
}

/// The published belly's share of the muscle's rest length.
static std::optional<Real> published_share(const Muscle& muscle) {
  static const std::map<std::string, Real> shares = read_shares();
  const auto known = shares.find(plain_muscle_name(muscle.name));
  return known == shares.end() ? std::nullopt : std::optional(known->second);
}

bool has_published_belly(const Muscle& muscle) { return published_share(muscle).has_value(); }

Real belly_length(const Muscle& muscle, Real specific_tension) {
  if (const auto share = published_share(muscle)) return *share * rest_length(muscle);
  const Real pennation = muscle.pennation_angle_at_optimal;
  const Real width = std::sqrt(muscle.max_isometric_force / specific_tension);
  return muscle.optimal_fiber_length * std::cos(pennation) + width / std::sin(std::max(pennation, radians(10)));
}

Real belly_on_line(const Muscle& muscle, Real specific_tension, Real line) {
  return std::clamp(belly_length(muscle, specific_tension), 0.2 * line, 0.9 * line);
}

}  // namespace gracilis::opensim
