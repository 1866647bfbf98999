#include <gracilis/anatomy/builtin_hip_bones.hpp>
#include <gracilis/anatomy/builtin_hip_muscles.hpp>

#include <cassert>

namespace gracilis::builtin_hip_shapes {

namespace {

/// Height and mass of the average person of Handsfield et al. 2014.
constexpr Real height = 1.71, mass = 71.8;

// Nets read from origin (first row) to insertion (last row); columns in the order that each comment names.

/// Columns from the front of the ilium to its back; beneath gluteus medius.
MusclePlan gluteus_minimus() {
  return {"gluteus_minimus_r",
          {4,
           5,
           {
               thick(38, 66, 37, 4),  thick(24, 74, 32, 4),  thick(6, 78, 19, 4),   thick(-14, 76, 6, 4),
               thick(-31, 66, -7, 4), thick(30, 44, 35, 7),  thick(18, 48, 32, 8),  thick(4, 50, 25, 8),
               thick(-12, 50, 16, 8), thick(-24, 46, 6, 6),  thick(16, 20, 44, 7),  thick(9, 23, 42, 8),
               thick(-1, 25, 38, 8),  thick(-10, 25, 32, 7), thick(-18, 24, 28, 6), thick(8, -16, 60, 4),
               thick(4, -11, 60, 4),  thick(-2, -7, 59, 4),  thick(-7, -3, 57, 4),  thick(-12, 0, 54, 4),
           }},
          0,
          1800,
          0.55,
          0.85};
}

/// Columns from the front of the ilium to its back.
MusclePlan gluteus_medius() {
  return {"gluteus_medius_r",
          {4,
           5,
           {
               thick(52, 80, 49, 5),    thick(34, 110, 52, 6),  thick(4, 130, 30, 6),  thick(-28, 134, 4, 6),
               thick(-50, 112, -16, 5), thick(42, 56, 54, 9),   thick(25, 76, 52, 11), thick(2, 86, 38, 13),
               thick(-22, 86, 20, 12),  thick(-40, 74, 4, 8),   thick(20, 24, 62, 8),  thick(10, 30, 62, 10),
               thick(-6, 32, 56, 11),   thick(-20, 32, 46, 10), thick(-31, 32, 34, 7), thick(0, -28, 68, 4),
               thick(-7, -20, 69, 5),   thick(-15, -12, 67, 5), thick(-23, -6, 63, 5), thick(-29, -1, 57, 4),
           }},
          0,
          2200,
          0.5,
          0.85};
}

/// Columns from the upper to the lower fibers.
MusclePlan gluteus_maximus() {
  return {"gluteus_maximus_r",
          {5,
           5,
           {
               thick(-50, 132, -18, 6), thick(-66, 112, -34, 7),  thick(-82, 78, -52, 7),   thick(-92, 40, -66, 7),
               thick(-84, 4, -74, 6),   thick(-58, 88, 10, 12),   thick(-80, 62, -12, 15),  thick(-95, 30, -32, 17),
               thick(-101, 0, -48, 16), thick(-93, -30, -60, 10), thick(-60, 40, 38, 13),   thick(-79, 12, 20, 17),
               thick(-91, -18, 2, 19),  thick(-94, -46, -16, 17), thick(-86, -68, -32, 10), thick(-48, -8, 60, 12),
               thick(-60, -34, 52, 16), thick(-66, -60, 40, 17),  thick(-66, -88, 24, 15),  thick(-60, -106, 10, 9),
               thick(-22, -44, 62, 5),  thick(-18, -66, 58, 6),   thick(-14, -92, 53, 6),   thick(-9, -118, 47, 6),
               thick(-3, -144, 43, 5),
           }},
          0,
          3000,
          0.25,
          0.8};
}

/// Columns from the lateral to the medial fibers.
MusclePlan iliacus() {
  return {"iliacus_r",
          {6,
           4,
           {
               thick(52, 88, 35, 4),  thick(28, 118, 30, 5), thick(-4, 134, 4, 5),  thick(-22, 118, -12, 4),
               thick(53, 66, 25, 7),  thick(34, 86, 20, 9),  thick(12, 94, -2, 9),  thick(-2, 86, -16, 6),
               thick(50, 44, 14, 7),  thick(43, 50, 6, 9),   thick(32, 54, -8, 9),  thick(22, 50, -18, 6),
               thick(44, 10, 11, 7),  thick(45, 9, 3, 9),    thick(44, 8, -6, 9),   thick(41, 8, -14, 7),
               thick(27, -32, 16, 7), thick(27, -32, 10, 8), thick(25, -33, 3, 8),  thick(21, -34, -3, 7),
               thick(2, -66, 19, 4),  thick(-5, -65, 13, 5), thick(-12, -63, 8, 5), thick(-19, -61, 6, 4),
           }},
          0,
          2000,
          0.5,
          0.8};
}

/// Columns from the upper to the lower fibers.
MusclePlan adductor_brevis() {
  return {"adductor_brevis_r",
          {4,
           3,
           {
               thick(37, -33, -62, 4),
               thick(29, -43, -66, 5),
               thick(19, -51, -65, 4),
               thick(24, -50, -40, 8),
               thick(18, -64, -44, 11),
               thick(9, -76, -46, 9),
               thick(8, -68, -8, 9),
               thick(4, -88, -12, 11),
               thick(0, -110, -14, 9),
               thick(-7, -82, 22, 4),
               thick(-3, -110, 22, 5),
               thick(2, -142, 20, 4),
           }},
          0,
          1500,
          0.25,
          0.8};
}

/// Columns from the upper to the lower fibers.
MusclePlan adductor_longus() {
  return {"adductor_longus_r",
          {5,
           3,
           {
               thick(51, -22, -64, 4),
               thick(50, -28, -69, 4),
               thick(46, -34, -73, 4),
               thick(46, -62, -44, 9),
               thick(43, -74, -52, 11),
               thick(38, -86, -58, 9),
               thick(33, -110, -16, 10),
               thick(30, -126, -23, 12),
               thick(25, -142, -29, 10),
               thick(19, -146, 6, 8),
               thick(16, -174, 0, 9),
               thick(12, -202, -6, 7),
               thick(6, -168, 17, 4),
               thick(5, -210, 13, 4),
               thick(4, -250, 9, 4),
           }},
          0,
          1800,
          0.2,
          0.8};
}

}  // namespace

std::vector<MusclePlan> muscle_plans() {
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
