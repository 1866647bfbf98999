#include <gracilis/view/export/export_tables.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/recorded_corrections.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace gracilis {

namespace fs = std::filesystem;

static void append_object(std::string& text, const std::string& name, const TriangleMesh& mesh, Index before) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "o {0}\nusemtl {0}\n", name);
  for (const Vec3 v : mesh.vertices.colwise()) fmt::format_to(out, "v {:.10f} {:.10f} {:.10f}\n", v.x(), v.y(), v.z());
  for (const Eigen::Vector3i f : mesh.faces.colwise())
    fmt::format_to(out, "f {} {} {}\n", f[0] + before + 1, f[1] + before + 1, f[2] + before + 1);
}

void export_obj(const RecordedRun& run, const fs::path& folder, const std::vector<int>& frames) {
  create_folder(folder);
  std::string materials;
  const auto add_material = [&](const std::string& name, const Color& color) {
    materials += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", name, color.x(), color.y(), color.z());
  };
  for (const std::string& bone : run.bones) add_material(bone, bone_color());
  for (const std::string& muscle : run.muscles) add_material(muscle, muscle_color(muscle));
  write_text_atomically(folder / "run.mtl", materials);
  std::vector<std::string> names = run.bones;
  names.insert(names.end(), run.muscles.begin(), run.muscles.end());
  for (const int frame : frames) {
    std::string text = "# metres\nmtllib run.mtl\n";
    Index before = 0;
    for (const std::string& name : names) {
      const TriangleMesh mesh = recorded_surface(run, name, frame);
      append_object(text, name, mesh, before);
      before += mesh.vertex_count();
    }
    write_text_atomically(folder / fmt::format("frame_{:04}.obj", frame), text);
  }
}

static std::string csv_of(const Table& table) {
  std::string text = "time";
  for (const std::string& column : table.columns) text += "," + column;
  auto out = std::back_inserter(text);
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    fmt::format_to(out, "\n{}", table.times[static_cast<std::size_t>(row)]);
    for (const Real value : table.values.row(row)) fmt::format_to(out, ",{:.9g}", value);
  }
  return text + "\n";
}

/// How far each kind of constraint moved a muscle's vertices in every frame.
static std::string corrections_csv(const RecordedRun& run) {
  std::string text = "frame,muscle,kind,mean_mm,largest_mm\n";
  auto out = std::back_inserter(text);
  for (int frame = 1; frame < run.frame_count; ++frame)
    for (const std::string& muscle : run.muscles)
      for (const auto& [kind, moved] : recorded_corrections(run, muscle, frame)) {
        const Eigen::VectorXd lengths = 1e3 * moved.colwise().norm();
        fmt::format_to(out, "{},{},{},{:.6g},{:.6g}\n", frame, muscle, kind, lengths.mean(), lengths.maxCoeff());
      }
  return text;
}

void export_csv(const RecordedRun& run, const fs::path& folder, const std::vector<int>& frames) {
  create_folder(folder);
  write_text_atomically(folder / "measures.csv", read_text(run.folder / "measures.csv"));
  for (const std::string name : {"fiber_lengths", "moment_arms"}) {
    const fs::path table = run.folder / (name + ".sto");
    if (fs::exists(table)) write_text_atomically(folder / (name + ".csv"), csv_of(read_table(table)));
  }
  if (has_corrections(run)) write_text_atomically(folder / "corrections.csv", corrections_csv(run));
  for (const std::string& muscle : run.muscles) {
    std::string text = "frame,vertex,x_m,y_m,z_m\n";
    auto out = std::back_inserter(text);
    for (const int frame : frames) {
      const Points points = recorded_surface(run, muscle, frame).vertices;
      for (Index v = 0; v < points.cols(); ++v)
        fmt::format_to(out, "{},{},{:.10f},{:.10f},{:.10f}\n", frame, v, points(0, v), points(1, v), points(2, v));
    }
    if (!frames.empty()) write_text_atomically(folder / ("points_" + muscle + ".csv"), text);
  }
}

}  // namespace gracilis
