#include <gracilis/view/window/panels.hpp>

#include <gtest/gtest.h>

#include <vtkActor2D.h>
#include <vtkActor2DCollection.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <set>

namespace gracilis {

/// The left strip of a window of 800 × 600: pixels that the scene and the sliders leave to the list of muscles.
static constexpr int strip_left = 16, strip_right = 216, strip_top = 554, strip_bottom = 252;

static std::vector<vtkTextActor*> texts_in(vtkRenderer& renderer) {
  std::vector<vtkTextActor*> texts;
  for (int i = 0; i < renderer.GetActors2D()->GetNumberOfItems(); ++i)
    if (auto* text = vtkTextActor::SafeDownCast(renderer.GetActors2D()->GetItemAsObject(i))) texts.push_back(text);
  return texts;
}

/// A list of numbered muscles that are clicked on.
struct MuscleList {
  vtkNew<vtkRenderer> renderer;
  Overlay overlay{*renderer};
  std::vector<ListEntry> entries;
  std::size_t page = 0;
  int clicked = -1, turned = 0, end = 0;

  explicit MuscleList(int count) {
    for (int i = 0; i < count; ++i)
      entries.push_back({"muscle " + std::to_string(i), Color::Ones(), 1, [this, i] { clicked = i; }});
  }
  void lay_out() {
    overlay.clear();
    end = add_paged_list(
        strip_left, strip_top, strip_bottom, "muscles", page, entries, [this] { ++turned; }, overlay);
  }
};

TEST(MuscleList, of_92_names_stays_in_the_left_strip_and_turns_to_all_of_them) {
  MuscleList list(92);
  std::set<std::string> seen;
  for (int sheet = 0; sheet < 92 && seen.size() < 92; ++sheet) {
    list.lay_out();
    EXPECT_GE(list.end, strip_bottom);
    for (vtkTextActor* text : texts_in(*list.renderer)) {
      EXPECT_LT(text->GetPosition()[0], strip_right) << text->GetInput();
      EXPECT_GE(text->GetPosition()[1], strip_bottom) << text->GetInput();
      if (const std::string name = text->GetInput(); name.starts_with("muscle ")) seen.insert(name);
    }
    for (int y = 0; y < 600; y += 5) EXPECT_FALSE(list.overlay.press(strip_right, y)) << y;
    EXPECT_TRUE(list.overlay.press(strip_left, list.end + 2));
    EXPECT_EQ(list.turned, sheet + 1);
  }
  EXPECT_EQ(seen.size(), 92u);
  list.lay_out();
  EXPECT_EQ(list.page, 0u) << "behind the last page comes the first";
}

TEST(MuscleList, on_its_second_page_a_click_reaches_who_is_named_there) {
  MuscleList list(92);
  list.page = 1;
  list.lay_out();
  const std::string first = texts_in(*list.renderer)[0]->GetInput();
  EXPECT_TRUE(list.overlay.press(strip_left + 4, strip_top - 15));
  EXPECT_EQ("muscle " + std::to_string(list.clicked), first);
  EXPECT_GT(list.clicked, 0);
}

TEST(MuscleList, of_few_names_is_one_page) {
  MuscleList list(6);
  list.lay_out();
  EXPECT_EQ(texts_in(*list.renderer).size(), 6u);
  EXPECT_EQ(list.end, strip_top - 6 * 22);
}

}  // namespace gracilis
