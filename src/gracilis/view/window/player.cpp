#include <gracilis/view/window/player.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

void Player::play(bool on, Real now) {
  playing = on;
  last = now;
  due = 0;
}

bool Player::advance(Real now, int begin, int end) {
  if (!playing) return false;
  due += (now - last) * frames_per_second * speed;
  last = now;
  const int steps = static_cast<int>(due);
  if (steps == 0) return false;
  due -= steps;
  const int before = frame;
  if (frame + steps < end)
    frame += steps;
  else if (loops)
    frame = begin + (frame + steps - begin) % (end - begin);
  else
    frame = end - 1, playing = false;
  return frame != before;
}

void Player::jump(int to, int begin, int end) {
  playing = false;
  frame = std::clamp(to, begin, end - 1);
}

void Player::change_speed(Real factor) { speed = std::clamp(speed * factor, 1.0 / 64, 8.0); }

}  // namespace gracilis
