#include <gracilis/anatomy/builtin/builtin_hip_muscles.hpp>

#include <gracilis/anatomy/builtin/builtin_hip_bones.hpp>

#include <cassert>

namespace gracilis::builtin_hip_shapes {

namespace {

/// Height and mass of the average person of Handsfield et al. 2014.
constexpr Real height = 1.71, mass = 71.8;

// Nets read from origin (first row) to insertion (last row); columns in the order that each comment names.

// clang-format off

/// Columns from the front of the ilium to its back; beneath gluteus medius.
MusclePlan gluteus_minimus() {
  return {"gluteus_minimus_r", {4, 5, {
      thick(40, 66, 36, 6), thick(25, 76, 31, 6), thick(6, 80, 16, 6), thick(-14, 80, 2, 6), thick(-32, 68, -10, 6),
      thick(31, 44, 33, 8), thick(18, 48, 31, 9), thick(4, 50, 23, 9), thick(-12, 50, 14, 8), thick(-24, 46, 4, 7),
      thick(17, 16, 43, 7), thick(9, 18, 42, 8), thick(-1, 20, 39, 8), thick(-10, 20, 34, 7), thick(-18, 20, 29, 6),
      thick(9, -22, 58, 6), thick(4, -16, 58, 6), thick(-2, -11, 57, 6), thick(-8, -6, 55, 6), thick(-13, -2, 52, 5),
  }}, 0, 1800, 0.0035, 0.55, 0.8};
}

/// Columns from the front of the ilium to its back.
MusclePlan gluteus_medius() {
  return {"gluteus_medius_r", {4, 5, {
      thick(53, 82, 47, 7), thick(36, 108, 51, 8), thick(6, 130, 30, 8), thick(-26, 136, 2, 8), thick(-48, 116, -18, 7),
      thick(42, 56, 53, 9), thick(26, 76, 52, 11), thick(4, 86, 38, 13), thick(-21, 86, 20, 12), thick(-39, 74, 4, 9),
      thick(21, 22, 62, 8), thick(10, 28, 63, 10), thick(-6, 30, 57, 11), thick(-20, 30, 47, 10), thick(-31, 30, 36, 8),
      thick(3, -35, 62, 8), thick(-6, -28, 63, 9), thick(-14, -20, 62, 9), thick(-22, -13, 59, 9), thick(-29, -7, 54, 8),
  }}, 0, 2200, 0.005, 0.5, 0.8};
}

/// Columns from the upper to the lower fibers.
MusclePlan gluteus_maximus() {
  return {"gluteus_maximus_r", {5, 5, {
      thick(-50, 132, -22, 8), thick(-66, 112, -39, 9), thick(-80, 78, -56, 9), thick(-86, 40, -68, 9), thick(-82, 14, -76, 9),
      thick(-50, 94, 14, 13), thick(-76, 66, -10, 15), thick(-92, 32, -32, 17), thick(-98, 0, -50, 16), thick(-93, -24, -60, 13),
      thick(-48, 42, 46, 15), thick(-74, 14, 24, 17), thick(-87, -18, 4, 18), thick(-91, -48, -16, 17), thick(-87, -63, -31, 14),
      thick(-36, -12, 65, 13), thick(-51, -38, 56, 15), thick(-58, -64, 43, 17), thick(-59, -91, 27, 15), thick(-56, -104, 14, 12),
      thick(-18, -48, 62, 9), thick(-13, -70, 55, 8), thick(-9, -95, 50, 8), thick(-4, -116, 46, 8), thick(0, -138, 42, 8),
  }}, 0, 3000, 0.0055, 0.3, 0.75, 45};  // flexion presses it onto the ischial tuberosity
}

/// Columns from the lateral to the medial fibers.
MusclePlan iliacus() {
  return {"iliacus_r", {6, 4, {
      thick(56, 88, 39, 6), thick(32, 122, 35, 7), thick(0, 138, 10, 7), thick(-25, 128, -12, 6),
      thick(55, 67, 27, 8), thick(35, 88, 20, 9), thick(11, 98, -3, 9), thick(-9, 92, -20, 7),
      thick(51, 44, 14, 8), thick(43, 50, 6, 9), thick(32, 54, -8, 9), thick(22, 50, -19, 7),
      thick(44, 10, 11, 8), thick(45, 9, 3, 9), thick(44, 8, -6, 9), thick(41, 8, -14, 7),
      thick(26, -32, 17, 7), thick(26, -33, 10, 8), thick(23, -34, 3, 8), thick(19, -35, -2, 7),
      thick(2, -70, 22, 6), thick(-5, -69, 17, 7), thick(-11, -67, 13, 7), thick(-17, -64, 10, 6),
  }}, 0, 2000, 0.0045, 0.5, 0.8};
}

/// Columns from the upper to the lower fibers.
MusclePlan adductor_brevis() {
  return {"adductor_brevis_r", {4, 3, {
      thick(38, -33, -61, 6), thick(30, -43, -64, 7), thick(20, -51, -65, 6),
      thick(24, -52, -40, 9), thick(18, -65, -44, 11), thick(9, -77, -46, 9),
      thick(8, -70, -8, 9), thick(4, -90, -12, 11), thick(0, -112, -14, 9),
      thick(-4, -82, 24, 6), thick(-2, -110, 24, 6), thick(2, -142, 22, 6),
  }}, 0, 1500, 0.0035, 0.25, 0.75};
}

/// Columns from the upper to the lower fibers.
MusclePlan adductor_longus() {
  return {"adductor_longus_r", {5, 3, {
      thick(50, -19, -61, 7), thick(48, -27, -68, 7), thick(43, -36, -73, 7),
      thick(47, -60, -46, 9), thick(44, -74, -53, 11), thick(39, -87, -59, 9),
      thick(33, -110, -16, 10), thick(30, -126, -23, 12), thick(25, -142, -29, 10),
      thick(18, -146, 6, 8), thick(15, -174, 0, 9), thick(12, -202, -6, 8),
      thick(5, -168, 19, 6), thick(5, -210, 15, 6), thick(4, -250, 11, 6),
  }}, 0, 1800, 0.0035, 0.2, 0.75};
}

// clang-format on

}  // namespace

std::vector<MusclePlan> hip_muscle_plans() {
  std::vector<MusclePlan> plans = {gluteus_minimus(), gluteus_medius(),  gluteus_maximus(),
                                   iliacus(),         adductor_brevis(), adductor_longus()};
  for (MusclePlan& plan : plans)
    plan.volume = literature_volume(plan.name.substr(0, plan.name.size() - 2), height, mass);
  return plans;
}

Real literature_volume(const std::string& name, Real person_height, Real person_mass) {
  struct Row {
    const char* name;
    Real share, constant;  // cm³
  };
  static constexpr Row table[] = {{"gluteus_maximus", 0.123, -25.4}, {"gluteus_medius", 0.0478, -16.9},
                                  {"gluteus_minimus", 0.0129, 12.6}, {"iliacus", 0.0248, 0.383},
                                  {"adductor_brevis", 0.0137, 6.2},  {"adductor_longus", 0.0259, -21.9}};
  const Real all = 47 * person_height * person_mass + 1285;
  for (const Row& row : table)
    if (name == row.name) return 1e-6 * (row.share * all + row.constant);
  assert(false && "not a muscle of the built-in hip");
  return 0;
}

}  // namespace gracilis::builtin_hip_shapes
