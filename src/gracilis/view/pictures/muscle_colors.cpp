#include <gracilis/view/pictures/muscle_colors.hpp>

#include <gracilis/core/state_hash.hpp>
#include <gracilis/view/pictures/muscle_groups.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>

namespace gracilis {

namespace {

// CIE 1976 L*, 9 or more apart: lightness is what survives gray print and every kind of color blindness. Lighter lines
// would hardly be seen on white.
constexpr std::array<Real, 6> shades = {26, 36, 46, 56, 66, 75};

Color from_hsl(Real hue, Real saturation, Real lightness) {
  const Real a = saturation * std::min(lightness, 1 - lightness);
  const auto channel = [&](Real n) {
    const Real k = std::fmod(n + hue / 30, 12);
    return lightness - a * std::max(Real(-1), std::min({k - 3, 9 - k, Real(1)}));
  };
  return {channel(0), channel(8), channel(4)};
}

/// L*, 0 black ... 100 white.
Real perceived_lightness(const Color& color) {
  const auto linear = [](Real c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const Real luminance = Vec3(0.2126, 0.7152, 0.0722).dot(color.unaryExpr(linear));
  return luminance > 216.0 / 24389 ? 116 * std::cbrt(luminance) - 16 : luminance * 24389 / 27;
}

/// Of this hue and saturation, as light as that; found by halving, since lighter HSL colors look lighter.
Color shaded(Real hue, Real saturation, Real shade) {
  Real low = 0, high = 1;
  for (int i = 0; i < 30; ++i) {
    const Real middle = (low + high) / 2;
    (perceived_lightness(from_hsl(hue, saturation, middle)) < shade ? low : high) = middle;
  }
  return from_hsl(hue, saturation, low);
}

/// In lower case, words joined by '_', without the side: a muscle has one color on both.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name)
    plain += c == ' ' || c == '-' || c == '.' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view side : {"_right", "_left", "_r", "_l"})
    if (plain.size() > side.size() && plain.ends_with(side)) return plain.substr(0, plain.size() - side.size());
  return plain;
}

/// Whether the name is this muscle's or a part's of it, as glut_max1 or triceps_long_proximal.
bool begins_with_words(std::string_view name, std::string_view muscle) {
  if (!name.starts_with(muscle)) return false;
  return name.size() == muscle.size() || std::isalpha(static_cast<unsigned char>(name[muscle.size()])) == 0;
}

struct MuscleMatch {
  const MuscleGroup* group = nullptr;
  const NamedMuscle* muscle = nullptr;
  std::size_t length = 0;  ///< of the name that was found
};

MuscleMatch find(std::string_view name) {
  MuscleMatch found;
  for (const MuscleGroup& group : muscle_groups())
    for (const NamedMuscle& muscle : group.muscles)
      for (const std::string_view each : muscle.names)
        if (each.size() > found.length && begins_with_words(name, each)) found = {&group, &muscle, each.size()};
  return found;
}

/// Of what follows the muscle's name: 1 to 9 by a number or by words; 0: the whole muscle.
std::size_t part_number(std::string_view words) {
  if (words.empty()) return 0;
  if (std::isdigit(static_cast<unsigned char>(words.back())) != 0) return static_cast<std::size_t>(words.back() - '0');
  return 1 + hash_of(words) % 9;  // the same on every machine, unlike std::hash
}

struct PartShift {
  Real shade = 0, turn = 0;  ///< L*; degrees of hue
};

/// Parts stay within half their muscle's step, or they would take colors of the muscles beside it. Light and dark
/// alternate, too.
PartShift shift_of_part(std::size_t number) {
  constexpr std::array<PartShift, 3> shifts = {{{5, 8}, {-5, -8}, {0, 0}}};
  if (number == 0) return {};
  const std::size_t round = (number - 1) / 3;
  const PartShift& shift = shifts[(number - 1) % 3];
  return {shift.shade, shift.turn + 3 * static_cast<Real>(round)};
}

}  // namespace

Color muscle_color(std::string_view name) {
  const std::string plain = plain_name(name);
  const MuscleMatch found = find(plain);
  const std::string_view words = std::string_view(plain).substr(found.length);
  if (!found.muscle) {
    const std::uint64_t hash = hash_of(words);
    return shaded(Real(hash % 12) * 30, 0.45, shades[hash / 12 % shades.size()]);
  }
  const PartShift part = shift_of_part(part_number(words));
  return shaded(std::fmod(found.group->hue + part.turn + 360, 360), found.group->saturation,
                shades[static_cast<std::size_t>(found.muscle->shade)] + part.shade);
}

}  // namespace gracilis
