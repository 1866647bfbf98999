#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/window/frame_maker.hpp>
#include <gracilis/view/window/window_scene.hpp>

#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace gracilis {

/// One muscle with a bump, and one fiber, whose actors are the renderer's first two.
class OneMuscleScene : public testing::Test {
 protected:
  OneMuscleScene() {
    TriangleMesh muscle = shapes::sphere(Vec3::Zero(), 0.03, 2);
    muscle.vertices.col(7) *= 1.1;
    shown.muscles = {"gluteus_medius_r"};
    FrameMaker maker({muscle}, {}, shown);
    ShownFrame frame;
    maker.fill({muscle.vertices}, {}, false, frame);
    Points line(3, 3);
    line << -0.02, 0, 0.02, 0, 0.001, 0, 0, 0, 0;
    maker.fill_fibers({join({line})}, frame);
    frame.activation = {0};
    history.append(frame);
    frame.volume = {1.02};
    history.append(std::move(frame));
    scene.emplace(shown, history, *renderer);
    state.muscles = {MuscleState::solid};
    state.fibers = true;
  }

  void show(WindowColor by, int frame = 0) {
    state.color_by = by;
    scene->show(frame, state, {}, true);
  }
  vtkActor& actor(int number) { return *vtkActor::SafeDownCast(renderer->GetActors()->GetItemAsObject(number)); }
  /// How far the muscle comes from its middle where it is drawn, mm.
  Real highest() {
    vtkDataSet& drawn = *actor(0).GetMapper()->GetInputAsDataSet();
    Real found = 0;
    for (vtkIdType v = 0; v < drawn.GetNumberOfPoints(); ++v)
      found = std::max(found, 1000 * Vec3(drawn.GetPoint(v)).norm());
    return found;
  }
  Color fiber_color() { return Color(actor(1).GetProperty()->GetColor()); }

  ShownShapes shown;
  ShapeHistory history;
  vtkNew<vtkRenderer> renderer;
  std::optional<WindowScene> scene;
  WindowState state;
};

TEST_F(OneMuscleScene, fibers_have_their_muscles_color_and_that_of_flesh_where_it_looks_like_flesh) {
  show(WindowColor::muscle);
  EXPECT_TRUE(fiber_color().isApprox(muscle_color("gluteus_medius_r"), 1e-12));
  show(WindowColor::natural);
  EXPECT_TRUE(fiber_color().isApprox(fiber_paint("gluteus_medius_r"), 1e-12));
}

TEST_F(OneMuscleScene, a_muscle_is_pale_and_unlike_bone_where_its_fibers_carry_the_colors) {
  show(WindowColor::fiber_strain);
  vtkDataArray* colors = actor(0).GetMapper()->GetInputAsDataSet()->GetPointData()->GetScalars();
  ASSERT_NE(colors, nullptr);
  const Color seen = Color(colors->GetTuple3(0)) / 255;
  EXPECT_LT((seen - flesh_color()).cwiseAbs().maxCoeff(), 0.5 / 255 + 1e-9);
  EXPECT_GT((seen - Color(0.72, 0.74, 0.75)).norm(), 0.1);
}

TEST_F(OneMuscleScene, bumps_are_smoothed_out_where_nothing_drawn_tells_where_vertices_are) {
  show(WindowColor::natural);
  EXPECT_LT(highest(), 32);
  show(WindowColor::muscle);
  EXPECT_LT(highest(), 32);
  show(WindowColor::edge_stretch);
  EXPECT_NEAR(highest(), 33, 1e-3);
  state.style = SurfaceStyle::edges;
  show(WindowColor::natural);
  EXPECT_NEAR(highest(), 33, 1e-3);
}

TEST_F(OneMuscleScene, a_scale_says_that_values_go_beyond_it_once_some_were_shown) {
  show(WindowColor::volume);
  EXPECT_THAT(scene->ticks(WindowColor::volume), testing::ElementsAre("-1", "0", "+1"));
  show(WindowColor::volume, 1);
  EXPECT_THAT(scene->ticks(WindowColor::volume), testing::ElementsAre("-1", "0", "≥ +1"));
  show(WindowColor::volume);
  EXPECT_THAT(scene->ticks(WindowColor::volume), testing::ElementsAre("-1", "0", "≥ +1")) << "as long as it is open";
  EXPECT_THAT(scene->ticks(WindowColor::edge_stretch), testing::ElementsAre("0.5", "1", "2"));
}

}  // namespace gracilis
