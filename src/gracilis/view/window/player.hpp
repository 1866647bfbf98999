#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Which frame is shown, and how it moves on while time goes by.
struct Player {
  int frame = 0;
  bool playing = false;
  Real speed = 0.5;             ///< 1: as fast as it happened
  Real frames_per_second = 60;  ///< as it happened
  bool loops = true;            ///< after the last frame comes the first; otherwise it stops there

  /// Plays from now on (s), or stops.
  void play(bool on, Real now);
  /// To the frame that is due, of begin ... end - 1; true when it is another one. Slow pictures skip frames.
  bool advance(Real now, int begin, int end);
  /// Stops and shows a frame of begin ... end - 1.
  void jump(int to, int begin, int end);
  /// Within 1/64 and 8.
  void change_speed(Real factor);

  Real last = 0;  ///< s, when `due` was last counted
  Real due = 0;   ///< part of a frame
};

}  // namespace gracilis
