#include <gracilis/view/export/export_usd.hpp>

#include <gracilis/core/quoted_text.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace gracilis {

namespace {

constexpr Real fiber_width = 0.0006;  // m, as drawn

using Text = fmt::memory_buffer;

template <class... Arguments>
void add(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

/// What an identifier of USD may be: letters, digits and underscores, no digit at first, each once.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
  std::string word;
  for (const char c : name) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    word += allowed ? c : '_';
  }
  if (word.empty() || (word[0] >= '0' && word[0] <= '9')) word.insert(0, "_");
  std::string free = word;
  for (int number = 2; !taken.insert(free).second; ++number) free = fmt::format("{}_{}", word, number);
  return free;
}

template <class Columns>
void add_points(Text& text, const Columns& points) {
  add(text, "[");
  for (Index i = 0; i < points.cols(); ++i)
    add(text, "{}({:.7g}, {:.7g}, {:.7g})", i == 0 ? "" : ", ", points(0, i), points(1, i), points(2, i));
  add(text, "]");
}

template <class Numbers>
void add_numbers(Text& text, const Numbers& numbers) {
  add(text, "[{}]", fmt::join(numbers, ", "));
}

/// Vectors are rows in USD, so a transform is written transposed.
void add_matrix(Text& text, const Eigen::Matrix3d& linear, const Vec3& shift) {
  const Eigen::Matrix3d turn = linear.array() + 0.0;  // writes no negative zeros
  add(text, "(");
  for (int row = 0; row < 3; ++row)
    add(text, "({:.9g}, {:.9g}, {:.9g}, 0), ", turn(0, row), turn(1, row), turn(2, row));
  add(text, "({:.9g}, {:.9g}, {:.9g}, 1))", shift.x(), shift.y(), shift.z());
}

void add_extent(Text& text, const Points& points) {
  Points corners(3, 2);
  corners << points.rowwise().minCoeff(), points.rowwise().maxCoeff();
  add_points(text, corners);
}

/// Writes an attribute with one value for each frame.
template <class Value>
void add_samples(Text& text, const char* attribute, std::size_t frames, const Value& value) {
  add(text, "        {}.timeSamples = {{\n", attribute);
  for (std::size_t i = 0; i < frames; ++i) {
    add(text, "            {}: ", i);
    value(i);
    add(text, ",\n");
  }
  add(text, "        }}\n");
}

void begin_prim(Text& text, const char* type, const std::string& name, const std::string& own_name,
                const Color& color) {
  add(text, "\n    def {} \"{}\"\n    {{\n", type, name);
  add(text, "        custom string gracilis:name = {}\n", quoted_text(own_name));
  add(text, "        color3f[] primvars:displayColor = [({:.4g}, {:.4g}, {:.4g})]\n", color[0], color[1], color[2]);
}

void add_faces(Text& text, const Eigen::Matrix3Xi& faces) {
  add(text, "        uniform bool doubleSided = 1\n        uniform token subdivisionScheme = \"none\"\n");
  add(text, "        int[] faceVertexCounts = ");
  add_numbers(text, std::vector<int>(static_cast<std::size_t>(faces.cols()), 3));
  add(text, "\n        int[] faceVertexIndices = ");
  add_numbers(text, faces.reshaped());
  add(text, "\n");
}

/// What all prims of a run share.
struct UsdRun {
  const RecordedRun& run;
  const AnimationOptions& options;
  std::vector<int> frames;
  std::set<std::string> names;
};

void add_bone(Text& text, const std::string& name, UsdRun& usd) {
  const AnimatedSurface surface = animated_surface(usd.run, name, usd.options.bone_vertices);
  const std::vector<RigidTransform> motions = bone_motions(usd.run, name, usd.frames);
  begin_prim(text, "Mesh", identifier(name, usd.names), name, bone_color());
  add_faces(text, surface.faces);
  add(text, "        point3f[] points = ");
  add_points(text, surface.rest);
  add(text, "\n        float3[] extent = ");
  add_extent(text, surface.rest);
  add(text, "\n");
  add_samples(text, "matrix4d xformOp:transform", usd.frames.size(),
              [&](std::size_t i) { add_matrix(text, motions[i].linear(), motions[i].translation()); });
  add(text, "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }}\n");
}

void add_muscle(Text& text, const std::string& name, UsdRun& usd) {
  const AnimatedSurface surface = animated_surface(usd.run, name, usd.options.muscle_vertices);
  std::vector<Points> points;
  for (const int frame : usd.frames) points.push_back(points_in(usd.run, surface, frame));
  begin_prim(text, "Mesh", identifier(name, usd.names), name, muscle_color(name));
  add_faces(text, surface.faces);
  add_samples(text, "point3f[] points", points.size(), [&](std::size_t i) { add_points(text, points[i]); });
  add_samples(text, "float3[] extent", points.size(), [&](std::size_t i) { add_extent(text, points[i]); });
  add(text, "    }}\n");
}

void add_fibers(Text& text, const std::string& name, UsdRun& usd) {
  std::vector<Polylines> fibers;
  for (const int frame : usd.frames) fibers.push_back(placed_fibers(usd.run, name, frame));
  if (fibers.front().count() == 0) return;
  begin_prim(text, "BasisCurves", identifier(name + "_fibers", usd.names), name, muscle_color(name));
  add(text, "        uniform token type = \"linear\"\n        float[] widths = [{}] (\n", fiber_width);
  add(text, "            interpolation = \"constant\"\n        )\n");
  add_samples(text, "int[] curveVertexCounts", fibers.size(), [&](std::size_t i) {
    std::vector<Index> counts;
    for (Index line = 0; line < fibers[i].count(); ++line) counts.push_back(fibers[i].size(line));
    add_numbers(text, counts);
  });
  add_samples(text, "point3f[] points", fibers.size(), [&](std::size_t i) { add_points(text, fibers[i].points); });
  add(text, "    }}\n");
}

void add_head(Text& text, const UsdRun& usd, const std::string& root) {
  const std::string scene = usd.run.manifest.value("scene", "run");
  add(text, "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = {}\n", root,
      quoted_text(scene + ", written by Gracilis"));
  add(text, "    metersPerUnit = 1\n    upAxis = \"Y\"\n    startTimeCode = 0\n    endTimeCode = {}\n",
      usd.frames.size() - 1);
  add(text, "    timeCodesPerSecond = {0}\n    framesPerSecond = {0}\n)\n\n", usd.options.frames_per_second);
  add(text, "def Xform \"{}\" (\n    kind = \"component\"\n)\n{{\n    matrix4d xformOp:transform = ", root);
  const Eigen::Matrix3d turn = upright_turn(usd.run);
  add_matrix(text, turn, turn * usd.run.place);
  add(text, "\n    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n");
}

}  // namespace

void export_usd(const RecordedRun& run, const std::filesystem::path& path, const AnimationOptions& options) {
  UsdRun usd{run, options, spread_frames(run.frame_count, std::max(2, options.frames)), {}};
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    Text text;
    const auto write = [&] {
      file.write(text.data(), static_cast<std::streamsize>(text.size()));
      if (!file) throw_write_error(path, std::strerror(errno));
      text.clear();
    };
    add_head(text, usd, "run");
    for (const std::string& bone : run.bones) add_bone(text, bone, usd), write();
    for (const std::string& muscle : run.muscles) add_muscle(text, muscle, usd), write();
    for (const std::string& muscle : run.muscles) add_fibers(text, muscle, usd), write();
    add(text, "}}\n");
    write();
    file.close();
    if (!file) throw_write_error(path, std::strerror(errno));
  });
}

}  // namespace gracilis
