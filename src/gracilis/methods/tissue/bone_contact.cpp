#include <gracilis/methods/tissue/bone_contact.hpp>

#include <limits>

namespace gracilis::tissue {

BoneDistance bone_distance(const DistanceField& field, const Vec3& p) {
  const Vec3 at = (p - field.origin).cwiseQuotient(field.cell_size);
  for (Index axis = 0; axis < 3; ++axis)
    if (!(at[axis] >= 0 && at[axis] < static_cast<Real>(field.nodes[static_cast<std::size_t>(axis)] - 1)))
      return {std::numeric_limits<Real>::infinity(), Vec3::Zero()};
  const auto i = static_cast<std::size_t>(at.x()), j = static_cast<std::size_t>(at.y()),
             k = static_cast<std::size_t>(at.z());
  const auto row = static_cast<std::size_t>(field.nodes[0]), slice = row * static_cast<std::size_t>(field.nodes[1]);
  const float* v = field.values.data() + i + row * j + slice * k;
  const Real x = at.x() - static_cast<Real>(i), y = at.y() - static_cast<Real>(j), z = at.z() - static_cast<Real>(k);
  const auto mix = [](Real from, Real to, Real share) { return from + share * (to - from); };
  // Along x first, on the four edges of the grid cell, then along y and z.
  const Real e0 = mix(v[0], v[1], x), e1 = mix(v[row], v[row + 1], x), e2 = mix(v[slice], v[slice + 1], x),
             e3 = mix(v[slice + row], v[slice + row + 1], x);
  const Real d0 = Real{v[1]} - v[0], d1 = Real{v[row + 1]} - v[row], d2 = Real{v[slice + 1]} - v[slice],
             d3 = Real{v[slice + row + 1]} - v[slice + row];
  const Real low = mix(e0, e1, y), high = mix(e2, e3, y);
  const Vec3 per_cell = {mix(mix(d0, d1, y), mix(d2, d3, y), z), mix(e1 - e0, e3 - e2, z), high - low};
  return {mix(low, high, z), per_cell.cwiseQuotient(field.cell_size)};
}

}  // namespace gracilis::tissue
