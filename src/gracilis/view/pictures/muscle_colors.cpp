#include <gracilis/view/pictures/muscle_colors.hpp>

#include <gracilis/core/state_hash.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>

namespace gracilis {

namespace {

/// Muscles that lie and work together: one hue, and a lightness for each in turn.
struct MuscleGroup {
  Real hue;         ///< degrees
  Real saturation;  ///< of the HSL color
  std::vector<std::string_view> muscles;
};

/// Latin names as anatomists write them and OpenSim's short ones; neighbors stand beside each other.
const std::vector<MuscleGroup>& muscle_groups() {
  static const std::vector<MuscleGroup> groups = {
      {4,
       0.60,
       {"gluteus_maximus", "gluteus_medius", "gluteus_minimus", "glut_max", "glut_med", "glut_min", "glmax", "glmed",
        "glmin"}},
      {318, 0.40, {"iliacus", "psoas_major", "psoas_minor", "psoas", "iliopsoas"}},
      {28,
       0.68,
       {"adductor_brevis", "adductor_longus", "adductor_magnus", "adductor_minimus", "pectineus", "gracilis",
        "add_brev", "add_long", "add_mag", "pect", "grac", "addbrev", "addlong", "addmag"}},
      {212,
       0.52,
       {"rectus_femoris", "vastus_lateralis", "vastus_intermedius", "vastus_medialis", "sartorius",
        "tensor_fasciae_latae", "rect_fem", "vas_lat", "vas_int", "vas_med", "sar", "tfl", "recfem", "vaslat", "vasint",
        "vasmed"}},
      {150,
       0.42,
       {"semimembranosus", "semitendinosus", "biceps_femoris_long", "biceps_femoris_short", "biceps_femoris", "semimem",
        "semiten", "bifemlh", "bifemsh", "bflh", "bfsh"}},
      {48,
       0.62,
       {"piriformis", "gemellus_superior", "superior_gemellus", "obturator_internus", "gemellus_inferior",
        "inferior_gemellus", "obturator_externus", "quadratus_femoris", "peri", "gem", "quad_fem", "piri"}},
      {182,
       0.48,
       {"gastrocnemius_medial", "gastrocnemius_lateral", "gastrocnemius", "soleus", "plantaris", "popliteus", "med_gas",
        "lat_gas", "gasmed", "gaslat"}},
      {268,
       0.34,
       {"tibialis_anterior",
        "tibialis_posterior",
        "fibularis_longus",
        "fibularis_brevis",
        "fibularis_tertius",
        "peroneus_longus",
        "peroneus_brevis",
        "peroneus_tertius",
        "extensor_digitorum_longus",
        "extensor_hallucis_longus",
        "flexor_digitorum_longus",
        "flexor_hallucis_longus",
        "tib_ant",
        "tib_post",
        "per_long",
        "per_brev",
        "per_tert",
        "ext_dig",
        "ext_hal",
        "flex_dig",
        "flex_hal",
        "tibant",
        "tibpost",
        "perlong",
        "perbrev",
        "edl",
        "ehl",
        "fdl",
        "fhl"}},
      {232,
       0.20,
       {"erector_spinae", "external_oblique", "internal_oblique", "rectus_abdominis", "quadratus_lumborum", "ercspn",
        "extobl", "intobl"}},
      {4,
       0.60,
       {"biceps_brachii_long", "biceps_brachii_short", "biceps_brachii", "biceps_long", "biceps_short", "biceps",
        "brachialis", "brachioradialis", "bic_long", "bic_brev", "biclong", "bicshort", "bra", "brd"}},
      {212,
       0.52,
       {"triceps_brachii_long", "triceps_brachii_lateral", "triceps_brachii_medial", "anconeus", "triceps_brachii",
        "triceps", "triceps_long", "triceps_lateral", "triceps_medial", "tri_long", "tri_lat", "tri_med", "trilong",
        "trilat", "trimed"}},
      {28,
       0.68,
       {"deltoid", "supraspinatus", "infraspinatus", "subscapularis", "teres_minor", "teres_major", "coracobrachialis",
        "pectoralis_major", "latissimus_dorsi"}}};
  return groups;
}

// Dark and light alternate: lightness is what survives gray print and every kind of color blindness.
constexpr std::array<Real, 6> lightnesses = {0.40, 0.67, 0.30, 0.57, 0.36, 0.75};

Color from_hsl(Real hue, Real saturation, Real lightness) {
  const Real a = saturation * std::min(lightness, 1 - lightness);
  const auto channel = [&](Real n) {
    const Real k = std::fmod(n + hue / 30, 12);
    return lightness - a * std::max(Real(-1), std::min({k - 3, 9 - k, Real(1)}));
  };
  return {channel(0), channel(8), channel(4)};
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

struct FoundMuscleColor {
  const MuscleGroup* group = nullptr;
  std::size_t place = 0, length = 0;
};

FoundMuscleColor find(std::string_view name) {
  FoundMuscleColor found;
  for (const MuscleGroup& group : muscle_groups())
    for (std::size_t i = 0; i < group.muscles.size(); ++i)
      if (group.muscles[i].size() > found.length && begins_with_words(name, group.muscles[i]))
        found = {&group, i, group.muscles[i].size()};
  return found;
}

/// Of what follows the muscle's name: 1 to 9 by a number or by words; 0: the whole muscle.
std::size_t part_number(std::string_view words) {
  if (words.empty()) return 0;
  if (std::isdigit(static_cast<unsigned char>(words.back())) != 0) return static_cast<std::size_t>(words.back() - '0');
  return 1 + hash_of(words) % 9;  // the same on every machine, unlike std::hash
}

struct PartShift {
  Real lightness = 0, turn = 0;  ///< of the HSL color, degrees
};

/// Parts stay within their muscle's own step, or they would take colors of the muscles beside it. Light and dark
/// alternate, too.
PartShift shift_of_part(std::size_t number) {
  constexpr std::array<Real, 3> steps = {0.06, -0.06, 0};
  if (number == 0) return {};
  return {steps[(number - 1) % 3], 3 * static_cast<Real>((number - 1) / 3)};
}

}  // namespace

Color muscle_color(std::string_view name) {
  const std::string plain = plain_name(name);
  const FoundMuscleColor found = find(plain);
  const std::string_view words = std::string_view(plain).substr(found.length);
  if (!found.group) {
    const std::uint64_t hash = hash_of(words);
    return from_hsl(Real(hash % 12) * 30, 0.45, lightnesses[hash / 12 % lightnesses.size()]);
  }
  const PartShift part = shift_of_part(part_number(words));
  const std::size_t shade = found.place % lightnesses.size();
  // Every third leans to the side in hue, and so do those of a large group for which lightnesses begin again.
  const std::size_t turns = found.place % 3 + 2 * (found.place / lightnesses.size() % 3);
  const Real turn = 9 * static_cast<Real>(turns) + part.turn;
  return from_hsl(std::fmod(found.group->hue + turn, 360), found.group->saturation,
                  lightnesses[shade] + part.lightness);
}

}  // namespace gracilis
