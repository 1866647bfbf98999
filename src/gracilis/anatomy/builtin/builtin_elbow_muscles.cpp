#include <gracilis/anatomy/builtin/builtin_elbow_muscles.hpp>

#include <gracilis/anatomy/builtin/builtin_elbow_bones.hpp>

namespace gracilis::builtin_elbow_shapes {

namespace {

// Bodies in the order of the scene.
constexpr Index scapula = 0, humerus = 1, ulna = 2, radius = 3;

// Volumes in m³: Holzbaur et al. 2007; biceps halved between its heads, triceps shared by strength times fiber length
// of its heads (Holzbaur et al. 2005).
constexpr Real biceps = 143.7e-6, brachialis_volume = 143.7e-6, brachioradialis_volume = 65.1e-6, triceps = 372.1e-6;
constexpr Real long_head = 798.5 * 0.134, other_head = 624.3 * 0.114;
constexpr Real long_share = long_head / (long_head + 2 * other_head), other_share = (1 - long_share) / 2;

// Nets read from origin (first row) to insertion (last row); columns in the order that each comment names.

// clang-format off

/// Columns from the lateral to the medial side.
MusclePlan brachialis() {
  return {"brachialis_r", {9, 3, {
      thick(5, 158, 3, 5), thick(8, 158, -6, 6), thick(5, 158, -15, 5),
      thick(7, 125, 8, 8), thick(12, 125, -6, 9), thick(7, 125, -20, 8),
      thick(8, 90, 10, 8), thick(14, 90, -5, 11), thick(8, 90, -23, 9),
      thick(9, 55, 10, 8), thick(15, 55, -5, 11), thick(8, 55, -23, 10),
      thick(15, 22, 7, 8), thick(19, 22, -5, 10), thick(15, 22, -19, 9),
      thick(18, -3, 0, 6), thick(19, -3, -6, 7), thick(18, -3, -13, 6),
      thick(14, -15, -2, 5), thick(14, -15, -7, 5.5), thick(14, -15, -12, 5),
      thick(10, -25, -3, 5), thick(10, -25, -7, 5.5), thick(10, -25, -11, 5),
      thick(6, -35, -4, 5), thick(6, -35, -7, 5.5), thick(6, -35, -9, 5),
  }}, brachialis_volume, 2000, 0.0035, 0.44, 0.78, 30, humerus, ulna, 0, 0.68};
}

/// Columns from the lateral to the medial side.
MusclePlan triceps_medial() {
  return {"triceps_brachii_medial_r", {6, 3, {
      thick(-16, 178, -1, 4), thick(-19, 178, -8, 5), thick(-16, 178, -15, 4),
      thick(-18, 140, 5, 7), thick(-23, 140, -6, 8), thick(-18, 140, -18, 7),
      thick(-19, 105, 8, 8), thick(-24, 105, -6, 9), thick(-19, 105, -21, 8),
      thick(-20, 70, 10, 8), thick(-25, 70, -6, 9), thick(-20, 70, -24, 8),
      thick(-22, 42, 5, 7), thick(-26, 42, -6, 8), thick(-22, 42, -18, 7),
      thick(-17, 22, 2, 6.5), thick(-20, 22.5, -8, 6.5), thick(-17, 22, -18, 6.5),
  }}, triceps * other_share, 1800, 0.0035, 0.6, 0.88, 30, humerus, ulna, 0, 0.86};
}

/// Over the humeral head and through the groove between its tubercles. Columns from the lateral to the medial side.
MusclePlan biceps_long() {
  return {"biceps_brachii_long_r", {17, 2, {
      thick(-17, 314, -51, 5), thick(-23, 314, -51, 5),
      thick(-14, 314, -38, 4.8), thick(-19, 314, -39, 4.8),
      thick(-11, 314, -25, 4.2), thick(-12, 314, -26, 4.2),
      thick(3, 304, -7, 4.2), thick(2, 304, -8, 4.2),
      thick(16, 291, -1, 4.2), thick(16, 291, -2, 4.2),
      thick(21, 276, 1, 4.2), thick(21, 276, 0, 4.2),
      thick(19, 250, 2, 4.2), thick(19, 250, 1, 4.2),
      thick(18, 225, 3, 4.5), thick(18, 225, 1, 4.5),
      thick(23, 198, 8, 7), thick(24, 198, 3, 7),
      thick(31, 168, 12, 10), thick(32, 168, 6, 10),
      thick(36, 130, 14, 11), thick(37, 130, 7, 11),
      thick(37, 95, 13, 10.5), thick(38, 95, 6, 10.5),
      thick(36, 60, 10, 7.5), thick(37, 60, 6, 7.5),
      thick(33, 25, 9, 4.6), thick(33, 25, 7, 4.6),
      thick(26, -5, 9, 4.4), thick(26, -5, 8, 4.4),
      thick(12.5, -25, 6, 4.4), thick(10, -25, 4, 4.4),
      thick(9.8, -38.5, 5.3, 5), thick(5.5, -38.5, 2.7, 5),
  }}, biceps / 2, 3100, 0.0025, 0.12, 0.945, 30, scapula, radius, 0.44, 0.79};
}

/// Columns from the lateral to the medial side.
MusclePlan biceps_short() {
  return {"biceps_brachii_short_r", {14, 2, {
      thick(27, 307, -34, 4.8), thick(26, 307, -36, 4.8),
      thick(28, 296, -31, 4.8), thick(27, 296, -33, 4.8),
      thick(23, 268, -29, 4.5), thick(23, 268, -31, 4.5),
      thick(23, 240, -24, 4.8), thick(23, 240, -27, 4.8),
      thick(25, 210, -18, 7), thick(25, 210, -23, 7),
      thick(31, 170, -9, 10.5), thick(30, 170, -17, 10.5),
      thick(35, 130, -8, 11.5), thick(34, 130, -16, 11.5),
      thick(37, 95, -8, 11), thick(36, 95, -15, 11),
      thick(38, 60, -6, 7.5), thick(37, 60, -11, 7.5),
      thick(36, 25, -4, 4.8), thick(36, 25, -6, 4.8),
      thick(32, -6, -3, 4.4), thick(32, -6, -4, 4.4),
      thick(23, -32, 0, 4.4), thick(23, -32, -1, 4.4),
      thick(15, -43, 2.5, 4.6), thick(13.5, -43, 1, 4.6),
      thick(9, -53, 5.3, 5.4), thick(5.5, -53, 3, 5.4),
  }}, biceps / 2, 3100, 0.0025, 0.12, 0.9, 30, scapula, radius, 0.25, 0.67};
}

/// Columns from the lateral to the medial side.
MusclePlan triceps_long() {
  return {"triceps_brachii_long_r", {10, 2, {
      thick(-33, 254, -51.5, 6.5), thick(-43, 242, -62, 6.5),
      thick(-29, 236, -42, 7), thick(-37, 236, -46, 7),
      thick(-31, 200, -27, 11), thick(-40, 200, -31, 11),
      thick(-36, 160, -18, 13), thick(-44, 160, -26, 12),
      thick(-39, 120, -16, 13), thick(-46, 120, -24, 12),
      thick(-42, 80, -14, 11), thick(-45, 80, -22, 10),
      thick(-40, 45, -12, 7), thick(-40, 45, -19, 7),
      thick(-34, 20, -12, 5), thick(-34, 20, -17, 5),
      thick(-31, 4, -12, 5), thick(-31, 4, -16, 5),
      thick(-29, -10, -11, 5), thick(-29, -10, -15, 5),
  }}, triceps * long_share, 2200, 0.0035, 0.15, 0.8, 30, scapula, ulna, 0.09, 0.72};
}

/// Columns from the lateral to the medial side.
MusclePlan triceps_lateral() {
  return {"triceps_brachii_lateral_r", {9, 2, {
      thick(-13, 240, 8, 5), thick(-19, 240, 0, 5),
      thick(-17, 200, 13, 9), thick(-25, 200, 3, 9),
      thick(-19, 160, 20, 11), thick(-31, 160, 8, 11),
      thick(-22, 120, 24, 12), thick(-35, 120, 10, 12),
      thick(-27, 80, 22, 11), thick(-38, 80, 8, 10),
      thick(-35, 45, 14, 8), thick(-40, 45, 4, 7),
      thick(-34, 20, 4, 5), thick(-35, 20, -1, 5),
      thick(-31, 4, 2, 5.5), thick(-32, 4, -3, 5.5),
      thick(-29, -10, 2, 5.5), thick(-30, -10, -3, 5.5),
  }}, triceps * other_share, 1900, 0.0035, 0.5, 0.8, 30, humerus, ulna, 0, 0.7};
}

/// Columns from the front to the back.
MusclePlan brachioradialis() {
  return {"brachioradialis_r", {11, 2, {
      thick(-2, 105, 10, 6.5), thick(-10, 105, 10, 6.5),
      thick(3, 70, 17, 8), thick(-8, 70, 14, 8),
      thick(9, 35, 27, 9), thick(-2, 35, 27, 9),
      thick(16, 0, 32, 8.5), thick(7, 0, 36, 8.5),
      thick(14, -40, 31, 8), thick(6, -40, 36, 8),
      thick(11, -80, 34, 6.5), thick(6, -80, 37, 6.5),
      thick(10, -120, 38, 5), thick(5, -120, 40, 5),
      thick(9, -165, 42, 4.5), thick(5, -165, 43, 4.5),
      thick(5, -205, 47, 4.5), thick(1, -205, 48, 4.5),
      thick(3, -222, 50, 4.8), thick(-1, -222, 51, 4.8),
      thick(2, -237, 53, 4.8), thick(-2, -237, 54, 4.8),
  }}, brachioradialis_volume, 2200, 0.003, 0.22, 0.85, 30, humerus, radius, 0, 0.58};
}

// clang-format on

}  // namespace

std::vector<MusclePlan> elbow_muscle_plans() {
  return {brachialis(),   triceps_medial(),  biceps_long(),    biceps_short(),
          triceps_long(), triceps_lateral(), brachioradialis()};
}

}  // namespace gracilis::builtin_elbow_shapes
