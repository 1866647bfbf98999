#pragma once

#include <tissue_blocks.hpp>
#include <tissue_closed_forms.hpp>

/// Load cases whose answer can be written down, each solved from rest by the tissue's own functions.
namespace gracilis::tissue {

constexpr Real wide = 0.02, tall = 0.06;  // m, of blocks and bars

struct Measured {
  Real closed_form = 0, ours = 0;
  Index cells = 0;
  Minimized done;
  Real seconds = 0;  ///< of preparing the metric and of minimizing
  Real error() const { return ours / closed_form - 1; }
};
inline Measured measured(Real closed_form, Real ours, const Block& block, const SettledBlock& settled) {
  return {closed_form, ours, block.muscle.lattice.cell_count(), settled.done, settled.seconds};
}

/// The defaults of `method = "tissue"`; as in its cells, shear and bulk modulus grow with tension.
inline CellLaw muscle_law(Real activation, const Vec3& direction = Vec3::UnitZ()) {
  const TissueSettings s;
  const Real pull = s.fiber_tension + activation * s.largest_active_stress;
  return {{std::max(s.matrix_shear_modulus, s.shear_per_tension * pull), s.matrix_lambda, s.matrix_stiffening},
          std::max(s.bulk_modulus, s.bulk_per_tension * pull),
          {s.fiber_tension, s.fiber_stiffness, activation * s.largest_active_stress, s.optimal_stretch},
          direction};
}
inline CellLaw matrix_law(Real bulk) {
  const TissueSettings s;
  return {{s.matrix_shear_modulus, s.matrix_lambda, s.matrix_stiffening}, bulk, {}, Vec3::Zero()};
}

inline Vec3 where_it_was(const Vec3& p) { return p; }

/// Two sides that slide, so that nothing moves rigidly; what is even does so anyway.
inline void slide_in_corner(Block& block) {
  for (const Index axis : {0, 1}) slide_side(block, axis, false, Vec3::Unit(axis), 0);
}

/// A bar whose ends slide, stretched or squeezed along its fibers: its force, N.
inline Measured stretched_bar(BlockFit fit, Real cell, const CellLaw& law, Real wanted) {
  Block block = make_block({wide, wide, tall}, cell, fit, law);
  const std::size_t low = slide_side(block, 2, false, Vec3::UnitZ(), 0);
  const std::size_t high = slide_side(block, 2, true, Vec3::UnitZ(), wanted * tall);
  slide_in_corner(block);
  const SettledBlock settled = settle(block, 1e-6, [&](const Vec3& p) { return Vec3(p.x(), p.y(), wanted * p.z()); });
  const Real stretch = stretch_between(block, settled, low, high);
  return measured(wide * wide * uniaxial(law, stretch).stress, force_on(block, settled, high).z(), block, settled);
}

/// A bar with active fibers alone between fixed ends: activation times largest stress times section, N.
inline Measured active_bar(BlockFit fit, Real cell, Real activation) {
  CellLaw law = muscle_law(activation);
  law.fibers.rest_tension = law.fibers.stiffness = 0;
  Block block = make_block({wide, wide, tall}, cell, fit, law);
  hold_side(block, 2, false, where_it_was);
  const std::size_t high = hold_side(block, 2, true, where_it_was);
  const SettledBlock settled = settle(block, 1e-6);
  return measured(activation * TissueSettings().largest_active_stress * wide * wide, force_on(block, settled, high).z(),
                  block, settled);
}

/// All sides of a cube held where simple shear has them: the shear stress and the stress across, Pa. Nodes begin there,
/// too, but those inside are off by up to a twentieth of the cube.
inline std::array<Measured, 2> sheared_cube(BlockFit fit, Real cell, const CellLaw& law, Real shear) {
  Block block = make_block({wide, wide, wide}, cell, fit, law);
  const auto place = [&](const Vec3& p) { return Vec3(p.x() + shear * p.z(), p.y(), p.z()); };
  for (const Index axis : {0, 1, 2})
    for (const bool is_high : {false, true}) hold_side(block, axis, is_high, place);
  const SettledBlock settled = settle(block, 1e-6, [&](const Vec3& p) {
    const Vec3 wave = (p * pi / wide).array().sin();
    return Vec3(place(p) + Vec3::Constant(wide / 20 * wave.prod()));
  });
  const Matrix3 expected = simple_shear(law, shear), found = mean_stress(block, settled);
  return {measured(expected(0, 2), found(0, 2), block, settled), measured(expected(2, 2), found(2, 2), block, settled)};
}

/// A cube pressed on a flat bone by a lid that slides: what the bone takes, N.
inline Measured cube_on_bone(BlockFit fit, Real cell, const CellLaw& law, Real wanted) {
  Block block = make_block({wide, wide, wide}, cell, fit, law);
  const std::size_t low = lay_on_bone(block);
  const std::size_t high = slide_side(block, 2, true, Vec3::UnitZ(), wanted * wide);
  slide_in_corner(block);
  const SettledBlock settled = settle(block, 1e-6);
  const Real stretch = stretch_between(block, settled, low, high);
  return measured(-wide * wide * uniaxial(law, stretch).stress, force_on(block, settled, low).z(), block, settled);
}

/// A bar twice as long as wide whose ends slide on planes, one of them turned a little: its moment, N m. Half of the
/// bar, which is its own mirror image, is solved for.
inline Measured bent_bar(BlockFit fit, Real cell, const CellLaw& law) {
  constexpr Real length = 2 * wide, turn = 0.005;
  Block block = make_block({wide / 2, wide, length}, cell, fit, law);
  // Points much stiffer than the method's own lock the cells that they lie in: by 1e12 N/m³ the moment of a bar of
  // eight cells across is 28 % too large.
  if (fit == BlockFit::anywhere) block.muscle.settings.neighbor_stiffness = TissueSettings().attachment_stiffness;
  const std::size_t low = slide_side(block, 2, false, Vec3::UnitZ(), 0);
  const Vec3 normal(0, std::sin(turn), std::cos(turn));
  slide_side(block, 2, true, normal, normal.dot(Vec3(0, wide / 2, length)));
  slide_side(block, 0, false, Vec3::UnitX(), 0);
  pin(block, Vec3(0, wide / 2, 0), 1);
  const SettledBlock settled = settle(block, 1e-9);
  Real moment = 0;
  for_each_force(block, settled, low,
                 [&](const Vec3&, const Vec3& p, const Vec3& force) { moment += 2 * (p.y() - wide / 2) * force.z(); });
  return measured(bending_moment(elastic(law), wide, turn / length), std::abs(moment), block, settled);
}

/// A clamped bar whose tip is moved aside a little: the force, N.
inline Measured clamped_bar(Real cell, const CellLaw& law, Real slenderness) {
  const Real length = slenderness * wide, way = 0.001;
  Block block = make_block({wide, wide, length}, cell, BlockFit::whole, law);
  hold_side(block, 2, false, where_it_was);
  const std::size_t tip = add_side(block, 2, true, -1);
  for (std::size_t p = block.sides[tip].begin; p < block.sides[tip].end; ++p)
    for (const Real sign : {1.0, -1.0})
      block.planes.push_back({static_cast<Index>(p), static_cast<Index>(tip), sign * Vec3::UnitY(),
                              sign * (block.muscle.points[p].rest.y() + way)});
  const SettledBlock settled = settle(block, 1e-9);
  return measured(tip_force(elastic(law), wide, length, way), force_on(block, settled, tip).y(), block, settled);
}

}  // namespace gracilis::tissue
