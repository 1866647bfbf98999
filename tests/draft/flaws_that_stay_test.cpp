#include "made_body.hpp"

#include <gmock/gmock.h>

namespace gracilis {

TEST(FlawsThatStay, are_told_with_why) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const TriangleMesh whole = hip().muscles[0].surface;
  TriangleMesh inner = whole, half = whole;
  const Vec3 middle = whole.vertices.rowwise().mean();
  for (TriangleMesh* each : {&inner, &half})
    each->vertices = (middle.replicate(1, whole.vertex_count()) + 0.5 * (whole.vertices.colwise() - middle)).eval();
  const TriangleMesh nested = shapes::both(whole, inner);
  write_surface(folder.path() / "hip" / "muscles" / "piriformis_r.vtp", nested.vertices, nested.faces);
  const auto text = [&](const MendFunction& mend) {
    DraftOptions options;
    options.mend = mend;
    const SceneDraft draft = draft_scene(folder.path() / "hip", options);
    return draft_text(draft, "scene.toml", {});
  };
  const std::string stays = "its surface stays as it is in piriformis_r, though a closed piece lies in another: ";
  EXPECT_THAT(text([](const std::string&, const TriangleMesh&) -> MendedSurface {
                throw InputError({"", "", "out of time", ""});
              }),
              testing::HasSubstr(stays + "out of time"));
  EXPECT_THAT(text([](const std::string&, const TriangleMesh& mesh) { return MendedSurface{mesh}; }),
              testing::HasSubstr(stays + "mended, a closed piece lies in another"));
  EXPECT_THAT(text([&](const std::string&, const TriangleMesh&) { return MendedSurface{half}; }),
              testing::HasSubstr(stays + "mended, 12 % of it would be left"));
}

}  // namespace gracilis
