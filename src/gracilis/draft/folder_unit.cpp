#include <gracilis/draft/folder_unit.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/median.hpp>
#include <gracilis/geometry/measures.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

struct Unit {
  const char* name;
  Real length;
};
constexpr std::array<Unit, 3> units = {{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}}};

/// Grown people's bones are 0.75 to 1.3 times as long as the dictionary says, a newborn's 0.25.
constexpr Real smallest_size = 0.22, largest_size = 1.8;

Real largest_extent(const Points& points) {
  if (points.cols() == 0) return 0;
  return bounding_box(points).sizes().maxCoeff();
}

/// Of each bone of the dictionary how much larger it is than a grown person's, were the files in metres; `failed` is
/// told of those whose surface tells no size.
std::vector<Real> sizes_of_bones(const FolderFiles& files, std::vector<Problem>& failed) {
  std::vector<Real> ratios;
  for (const NamedSurfaceFile& each : files.surfaces) {
    if (!is_surely_a_bone(each)) continue;
    try {
      const Real ratio = largest_extent(files.meshes->read(each.file, 1, each.part).vertices) / each.bone.known->length;
      if (ratio > 0 && std::isfinite(ratio))
        ratios.push_back(ratio);
      else
        failed.push_back({each.file.string(), "", "has no size: its vertices lie in one point, or are not finite",
                          "export the surface again"});
    } catch (const InputError& error) {
      failed.insert(failed.end(), error.problems().begin(), error.problems().end());
    }
  }
  return ratios;
}

[[noreturn]] void refuse_without_size(const FolderFiles& files, const fs::path& folder, std::vector<Problem> failed) {
  Problem first = {folder.string(), "", "holds no bone whose name is known",
                   "name bones as in femur_r.ply or 'left scapula.stl', in English or Latin, with _r or _l"};
  if (!failed.empty()) first = {folder.string(), "", "no bone whose name is known can be read", "see what each lacks"};
  failed.insert(failed.begin(), first);
  for (const std::string& line : files.unreadable) failed.push_back({"left out", "", line, ""});
  throw InputError(failed);
}

void choose_unit(const FolderFiles& files, const fs::path& folder, FoundFolder& found) {
  std::vector<Problem> failed;
  std::vector<Real> sizes = sizes_of_bones(files, failed);
  if (sizes.empty()) refuse_without_size(files, folder, std::move(failed));
  const Real size = median(std::move(sizes));
  const auto off = [&](const Unit& unit) { return std::abs(std::log(size * unit.length)); };
  const Unit& best =
      *std::min_element(units.begin(), units.end(), [&](const Unit& a, const Unit& b) { return off(a) < off(b); });
  found.unit = best.name;
  found.unit_length = best.length;
  found.size = size * best.length;
  if (found.size >= smallest_size && found.size <= largest_size) return;
  throw InputError(
      {folder.string(), "",
       fmt::format("the bones are {:.3g} times as large as a grown person's in {}, and in no unit of m, cm "
                   "and mm as large as bones are",
                   found.size, best.name),
       "scale the surfaces to one of these units"});
}

/// The unit as given.
void take_unit(const FolderFiles& files, const std::string& name, FoundFolder& found) {
  for (const Unit& unit : units)
    if (unit.name == name) found.unit_length = unit.length;
  found.unit = name;
  std::vector<Problem> told_where_read;
  std::vector<Real> sizes = sizes_of_bones(files, told_where_read);
  if (!sizes.empty()) found.size = median(std::move(sizes)) * found.unit_length;
}

}  // namespace

void set_unit(const FolderFiles& files, const fs::path& subject, const std::string& unit, FoundFolder& found) {
  if (unit.empty())
    choose_unit(files, subject, found);
  else
    take_unit(files, unit, found);
}

}  // namespace gracilis
