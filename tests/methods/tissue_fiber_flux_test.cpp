#include <gracilis/methods/tissue/fiber_flux.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::tissue {
namespace {

Vec3 middle_of(const Lattice& lattice, const Cell& cell) {
  return lattice.nodes.col(cell.nodes[0]) + Vec3::Constant(lattice.cell_size / 2);
}

/// The mean relative tension of cells that are mostly filled and that this holds for.
template <class Holds>
Real mean_tension(const PreparedTissue& muscle, const Holds& holds) {
  Real sum = 0;
  int count = 0;
  for (std::size_t c = 0; c < muscle.lattice.cells.size(); ++c) {
    const Cell& cell = muscle.lattice.cells[c];
    if (cell.fill > 0.5 && holds(middle_of(muscle.lattice, cell))) sum += muscle.relative_tension[c], ++count;
  }
  return sum / count;
}

/// The tests' tube as a spindle, 160 mm long; its ends, the last 10 mm of which are held, are so much narrower.
struct Spindle {
  Real width_at_ends;
  Real width(Real z) const {
    const Real wave = std::cos(pi / 2 * z / 0.08);
    return width_at_ends + (1 - width_at_ends) * wave * wave;
  }
  PreparedTissue prepared(Real cell_size) const {
    Scene scene = tube_scene();
    Points& vertices = scene.muscles[0].surface.vertices;
    const Eigen::Vector2d axis(0.0255, 0);
    for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v)
      vertices.col(v).head<2>() = axis + width(vertices(2, v)) * (vertices.col(v).head<2>() - axis);
    scene.method.settings = {{"cell_size", cell_size}};
    return prepare_tissue(scene, scene.muscles[0], {}, {});
  }
};

TEST(TissueFiberFlux, tension_grows_as_the_section_falls_also_in_a_tendon_of_a_twelfth_of_it) {
  for (const Real width_at_ends : {0.5, 0.15}) {
    const Spindle spindle{width_at_ends};
    const PreparedTissue muscle = spindle.prepared(width_at_ends > 0.3 ? 0.003 : 0.0015);
    const Real belly = mean_tension(muscle, [](const Vec3& p) { return std::abs(p.z()) < 0.005; });
    const Real tendon = mean_tension(muscle, [](const Vec3& p) { return std::abs(std::abs(p.z()) - 0.06) < 0.002; });
    const Real section = spindle.width(0.06) * spindle.width(0.06);
    EXPECT_NEAR(tendon / belly * section, 1, 0.15) << width_at_ends;
  }
}

TEST(TissueFiberFlux, tension_does_not_gather_at_the_rims_of_attachments) {
  Scene scene = tube_scene();
  Muscle& ball = scene.muscles[0];
  ball.surface = shapes::sphere(Vec3::Zero(), 0.03, 4);
  attach_by_height(ball, {"upper cap", AttachmentEnd::origin, 0, {}, false}, 0.022,
                   {"lower cap", AttachmentEnd::insertion, 1, {}, false}, -0.022);
  scene.method.settings = {{"cell_size", 0.0025}};
  const PreparedTissue muscle = prepare_tissue(scene, ball, {}, {});
  const auto beside_cap_at = [](Real from, Real to) {
    return [=](const Vec3& p) {
      const Real off_axis = p.head<2>().norm();
      return p.norm() > 0.026 && std::abs(p.z()) > 0.015 && off_axis > from && off_axis < to;
    };
  };
  const Real rim = std::sqrt(0.03 * 0.03 - 0.022 * 0.022);
  const Real at_rim = mean_tension(muscle, beside_cap_at(rim - 0.002, rim + 0.002));
  const Real inside = mean_tension(muscle, beside_cap_at(0, 0.75 * rim));
  EXPECT_LT(at_rim, inside);
}

TEST(TissueFiberFlux, a_muscle_that_is_held_at_one_end_has_no_fibers) {
  Scene scene = tube_scene();
  scene.muscles[0].attachments.pop_back();
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], {}, {});
  EXPECT_TRUE(muscle.directions.isZero(0));
  EXPECT_EQ(muscle.mean_section, 0);
}

TEST(TissueFiberFlux, a_piece_of_a_muscle_that_only_one_end_holds_has_no_fibers_and_the_other_pieces_have_theirs) {
  Scene scene = tube_scene();
  Muscle& muscle = scene.muscles[0];
  const Index whole = muscle.surface.vertex_count();
  TriangleMesh stump = shapes::cylinder(0.01, 0.04, 20, 10);
  stump.vertices.colwise() += Vec3(0.0755, 0, 0.04);
  muscle.surface = shapes::both(muscle.surface, stump);
  for (Index v = whole; v < muscle.surface.vertex_count(); ++v)
    if (muscle.surface.vertices(2, v) > 0.07) muscle.attachments[0].vertices.push_back(v);
  const PreparedTissue prepared = prepare_tissue(scene, muscle, {}, {});
  for (std::size_t c = 0; c < prepared.lattice.cells.size(); ++c) {
    const Cell& cell = prepared.lattice.cells[c];
    if (cell.fill < 0.5) continue;
    const bool has_fibers = !prepared.directions.col(static_cast<Index>(c)).isZero(0);
    EXPECT_EQ(has_fibers, middle_of(prepared.lattice, cell).x() < 0.05);
  }
}

}  // namespace
}  // namespace gracilis::tissue
