#include <gracilis/view/window/shape_history.hpp>

#include <algorithm>

namespace gracilis {

void ShapeHistory::append(ShownFrame frame) {
  auto shared = std::make_shared<const ShownFrame>(std::move(frame));
  const std::lock_guard lock(mutex_);
  frames_.push_back(std::move(shared));
  if (static_cast<int>(frames_.size()) <= capacity_) return;
  frames_.pop_front();
  ++begin_;
}

void ShapeHistory::replace(int number, ShownFrame frame) {
  auto shared = std::make_shared<const ShownFrame>(std::move(frame));
  const std::lock_guard lock(mutex_);
  const auto place = static_cast<std::size_t>(number - begin_);
  if (number >= begin_ && place < frames_.size()) frames_[place] = std::move(shared);
}

void ShapeHistory::forget_passes(int number) {
  if (number < begin() || at(number)->passes.empty()) return;
  ShownFrame frame = *at(number);
  frame.passes.clear();
  replace(number, std::move(frame));
}

int ShapeHistory::begin() const {
  const std::lock_guard lock(mutex_);
  return begin_;
}

int ShapeHistory::end() const {
  const std::lock_guard lock(mutex_);
  return begin_ + static_cast<int>(frames_.size());
}

std::shared_ptr<const ShownFrame> ShapeHistory::at(int number) const {
  const std::lock_guard lock(mutex_);
  const auto place = std::clamp<std::ptrdiff_t>(number - begin_, 0, static_cast<std::ptrdiff_t>(frames_.size()) - 1);
  return frames_[static_cast<std::size_t>(place)];
}

}  // namespace gracilis
