#include <gracilis/opensim/import/muscle_names.hpp>

#include <gracilis/io/text_cells.hpp>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace gracilis::opensim {

namespace {

/// A name, in what tells sides apart and the rest, which is `count` characters from `begin`.
struct Sides {
  std::size_t begin = 0, count = 0;
};

}  // namespace

static Sides without_sides(const std::string& name) {
  const std::string text = lower_case(name);
  std::size_t begin = 0, end = text.size();
  for (const std::string_view side : {"right_", "left_", "r_", "l_"})
    if (text.starts_with(side)) {
      begin = side.size();
      break;
    }
  for (const std::string_view side : {"_right", "_left", "_r", "_l"})
    if (text.ends_with(side) && end - side.size() >= begin) {
      end -= side.size();
      break;
    }
  return {begin, end - begin};
}

std::string plain_muscle_name(const std::string& name) {
  const Sides sides = without_sides(name);
  std::string text = lower_case(name).substr(sides.begin, sides.count);
  std::erase_if(text, [](char c) { return c < 'a' || c > 'z'; });
  return text;
}

std::string muscle_of_head(const std::string& name) {
  const Sides sides = without_sides(name);
  const std::string own = name.substr(sides.begin, sides.count);
  std::string muscle = own;
  while (!muscle.empty() && std::isdigit(static_cast<unsigned char>(muscle.back()))) muscle.pop_back();
  for (const std::string_view head : {"prox", "mid", "dist", "isch"})
    if (muscle == own && lower_case(own).ends_with(head)) muscle.erase(muscle.size() - head.size());
  if (muscle != own && muscle.ends_with('_')) muscle.pop_back();
  return muscle == own || muscle.empty()
             ? ""
             : name.substr(0, sides.begin) + muscle + name.substr(sides.begin + sides.count);
}

}  // namespace gracilis::opensim
