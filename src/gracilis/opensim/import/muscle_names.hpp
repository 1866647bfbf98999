#pragma once

#include <string>

namespace gracilis::opensim {

/// A muscle's name in small letters, without what tells sides ("_r", "_left", "r_" ...) and heads (numbers) apart and
/// without what joins words: "glut_max1_r" and "GlutMax2_l" are both "glutmax".
std::string plain_muscle_name(const std::string& name);

/// The name of the muscle that this is a head of, by its name: "glut_max_r" of "glut_max1_r", "addmag_l" of
/// "addmagProx_l". Heads have numbers, or are called Prox, Mid, Dist or Isch. Empty where it is called like no head.
std::string muscle_of_head(const std::string& name);

}  // namespace gracilis::opensim
