#include <gracilis/io/input_file.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include "app/program.hpp"
#include "io/test_files.hpp"
#include "view/walk_files.hpp"

#include <build_paths.hpp>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <unistd.h>

#include <cmath>
#include <regex>
#include <set>

/// What README.md tells a newcomer to type, typed one after the other; pictures are compared with small ones in
/// tests/view/thumbnails. With GRACILIS_THUMBNAILS=write in the environment these are written anew: look at them.
namespace gracilis {

namespace fs = std::filesystem;

namespace {

const fs::path root = build_paths::source_folder;
const fs::path thumbnails = root / "tests/view/thumbnails";
constexpr int thumbnail_width = 60;

/// Averages over as many blocks as fit; opaque.
PixelImage thumbnail_of(const fs::path& picture) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(picture.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  const int width = image.GetDimensions()[0], height = image.GetDimensions()[1];
  PixelImage small{thumbnail_width, std::max(1, thumbnail_width * height / std::max(width, 1)), {}};
  for (int row = 0; row < small.height; ++row)
    for (int column = 0; column < small.width; ++column) {
      const int left = column * width / small.width, right = (column + 1) * width / small.width;
      const int top = row * height / small.height, bottom = (row + 1) * height / small.height;
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int y = top; y < bottom; ++y)
          for (int x = left; x < right; ++x) sum += image.GetScalarComponentAsDouble(x, height - 1 - y, 0, k);
        small.rgba.push_back(static_cast<unsigned char>(std::lround(sum / ((bottom - top) * (right - left)))));
      }
      small.rgba.push_back(255);
    }
  return small;
}

/// How alike two pictures are: the correlation of their gray values, 1 where they are the same up to brightness.
Real likeness(const PixelImage& a, const PixelImage& b) {
  if (a.width != b.width || a.height != b.height) return -1;
  const auto gray = [](const PixelImage& image) {
    Eigen::VectorXd values(static_cast<Index>(image.rgba.size() / 4));
    for (Index i = 0; i < values.size(); ++i) {
      const unsigned char* pixel = image.rgba.data() + 4 * i;
      values[i] = 0.3 * pixel[0] + 0.59 * pixel[1] + 0.11 * pixel[2];
    }
    return Eigen::VectorXd(values.array() - values.mean());
  };
  const Eigen::VectorXd x = gray(a), y = gray(b);
  return x.dot(y) / (x.norm() * y.norm());
}

PixelImage mirrored_image(const PixelImage& image) {
  PixelImage mirrored = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int k = 0; k < 4; ++k)
        mirrored.rgba[static_cast<std::size_t>(4 * (y * image.width + x) + k)] =
            image.rgba[static_cast<std::size_t>(4 * (y * image.width + image.width - 1 - x) + k)];
  return mirrored;
}

void expect_like_its_thumbnail(const fs::path& picture, const std::string& name) {
  const PixelImage now = thumbnail_of(picture);
  const fs::path known = thumbnails / (name + ".png");
  if (std::getenv("GRACILIS_THUMBNAILS")) {
    fs::create_directories(thumbnails);
    write_png(known, now);
  }
  ASSERT_TRUE(fs::exists(known)) << known;
  const PixelImage stored = thumbnail_of(known);
  EXPECT_GT(likeness(now, stored), 0.97) << picture;
  EXPECT_LT(likeness(mirrored_image(now), stored), 0.9) << picture << " looks the same from the other side";
}

/// `gracilis ...` between backquotes.
std::set<std::string> commands_of_readme() {
  const std::string text = read_text(root / "README.md");
  static const std::regex command("`gracilis ([^`]*)`");
  std::set<std::string> found;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), command); match != std::sregex_iterator(); ++match)
    found.insert((*match)[1]);
  return found;
}

struct Step {
  std::string in_readme;  ///< without "gracilis"
  std::string typed;      ///< with names of what is there
  std::string picture = {};
  bool needs_display = false;
};

const std::vector<Step> steps = {
    {"demo elbow", "demo elbow --out elbow", "elbow/preview.png"},
    {"run my_hip.toml", "run out/my_hip.toml --out out/my_hip", "out/my_hip/preview.png"},
    {"run SCENE --corrections", "run out/my_hip.toml --corrections --no-fibers --no-pictures --out moved"},
    {"render RUN --arrows", "render moved --arrows --out arrows.png"},
    {"scene FOLDER --out leg.toml", "scene scans --out leg.toml", "leg.png"},
    {"new FILES...", "new scans/*.vtp --out new.toml", "new.png"},
    {"fibers SCENE", "fibers out/my_hip.toml --out fibers", "fibers/fibers.png"},
    {"rom SCENE --coord hip_flexion_r=-10:60:2 --reference published.csv",
     "rom out/my_hip.toml --coord hip_flexion_r=-10:60:10 --reference published.csv --out arms"},
    {"import MODEL.osim", "import tiny.osim --out model"},
    {"compare SCENE", "compare out/my_hip.toml --methods skinning,strings --out compared"},
    {"study run study.toml --shard 1/8", "study run study.toml --shard 1/2"},
    {"calibrate SCENE --targets targets.toml",
     "calibrate out/my_hip.toml --targets targets.toml --set method=skinning"},
    {"transfer TEMPLATE --bones SUBJECT/ --out scene",
     "transfer demo --bones scans --only adductor_longus_r --keep-overlaps --out carried"},
    {"view demo", "view demo --pictures . --keys 'p q'", "gracilis_0001.png", true},
    {"report RUN", "report out/demo"},
    {"prepare a.stl --bone hip.stl --unit mm",
     "prepare scans/adductor_longus_r.vtp --bone scans/hip_bone_r.vtp --unit m --out prepared"},
    {"prepare", "prepare --help"},
    {"verify RUN", "verify out/demo"}};

}  // namespace

TEST(ReadmeWalk, knows_every_command) {
  std::set<std::string> known;
  for (const Step& step : steps) known.insert(step.in_readme);
  EXPECT_EQ(commands_of_readme(), known) << "a command of README.md needs a step here";
}

TEST(ReadmeWalk, every_command_works_and_every_picture_looks_as_it_should) {
  const TestFolder folder;
  const fs::path out = folder.path() / "said";
  const auto type = [&](const std::string& words, bool in_window = false) {
    const std::string program = "'" + std::string(build_paths::program) + "' " + words;
    const std::string command = in_window ? "xvfb-run -a -s '-screen 0 1280x800x24' " + program : program;
    const int status =
        std::system(("cd '" + folder.path().string() + "' && " + command + " >'" + out.string() + "' 2>&1").c_str());
    EXPECT_EQ(status, 0) << words << "\n" << read_text(out);
  };
  type("demo --out out/demo");  // as ./demo.sh does
  expect_like_its_thumbnail(folder.path() / "out/demo/preview.png", "demo");
  write_walk_files(folder.path());
  for (const Step& step : steps) {
    if (step.needs_display && access("/usr/bin/xvfb-run", X_OK) != 0) continue;
    type(step.typed, step.needs_display);
    if (!step.picture.empty())
      expect_like_its_thumbnail(folder.path() / step.picture, step.typed.substr(0, step.typed.find(' ')) +
                                                                  (step.in_readme == "demo elbow" ? "_elbow" : ""));
  }
}

}  // namespace gracilis
