#include <gracilis/transfer/transfer_folder.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/toml_writer.hpp>
#include <gracilis/transfer/scene_tables.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

const Bone& template_bone(const Transferred& transferred, const FittedBone& bone) {
  return transferred.whole_template.bones[static_cast<std::size_t>(bone.match.of_template)];
}

void write_bones(const Transferred& transferred, const fs::path& folder) {
  for (const FittedBone& bone : transferred.skeleton.bones) {
    const std::string file = template_bone(transferred, bone).name + ".vtp";
    const TriangleMesh& mesh = transferred.subject.bones[bone.match.of_subject].mesh;
    write_surface(folder / "bones" / file, mesh.vertices, mesh.faces,
                  {{"fit_mm", 1000 * fit_distances(transferred, bone)}});
    const TriangleMesh laid = laid_bone(transferred, bone);
    write_surface(folder / "fit" / file, laid.vertices, laid.faces);
  }
}

void write_muscles(const Scene& scene, const fs::path& folder) {
  for (const Muscle& muscle : scene.muscles) {
    const TriangleMesh& surface = muscle.surface;
    write_surface(folder / "muscles" / (muscle.name + ".vtp"), surface.vertices, surface.faces);
    for (std::size_t s = 0; s < muscle.aponeuroses.size(); ++s) {
      const TriangleMesh& sheet = muscle.aponeuroses[s].surface;
      write_surface(folder / "muscles" / fmt::format("{}_sheet_{}.vtp", muscle.name, s), sheet.vertices, sheet.faces);
    }
    const std::pair<const Polylines*, const char*> lines[] = {
        {&muscle.given_fibers, ""}, {&muscle.tracts, "_tracts"}, {&muscle.given_surface_fibers, "_surface"}};
    for (const auto& [some, ending] : lines)
      if (some->count() > 0) {
        create_folder(folder / "fibers");
        write_polylines(folder / "fibers" / (muscle.name + ending + ".vtp"), *some);
      }
  }
}

/// Rows of what, name, measure, value, unit.
class FitTable {
 public:
  void add(const std::string& what, const std::string& name, const std::string& measure, Real value,
           const std::string& unit) {
    text_ += fmt::format("{},{},{},{:.6g},{}\n", what, name, measure, value, unit);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_ = "what,name,measure,value,unit\n";
};

std::string fit_table(const Transferred& transferred) {
  FitTable table;
  for (const FittedBone& bone : transferred.skeleton.bones) {
    const std::string& name = template_bone(transferred, bone).name;
    const BoneFit& fit = bone.registered.fit;
    const auto add = [&](const char* measure, Real value, const char* unit) {
      table.add("bone", name, measure, value, unit);
    };
    add("scale", bone.registered.similarity.scale, "1");
    add("similar_rms", 1000 * bone.registered.similar, "mm");
    add("rms_to_subject", 1000 * fit.to_subject, "mm");
    add("rms_to_template", 1000 * fit.to_template, "mm");
    add("p95", 1000 * fit.p95, "mm");
    add("worst", 1000 * fit.worst, "mm");
    add("rms_with_trimmed", 1000 * fit.all, "mm");
    add("trimmed_of_template", 100 * fit.trimmed_template, "%");
    add("trimmed_of_subject", 100 * fit.trimmed_subject, "%");
  }
  for (std::size_t j = 0; j < transferred.joints.size(); ++j)
    table.add("joint", transferred.scene.joints[j].name, "center_from_warp", 1000 * transferred.joints[j].from_warp,
              "mm");
  for (const AttachmentFit& each : transferred.muscles.attachments) {
    const std::string name = each.muscle + " " + each.attachment;
    table.add("attachment", name, "vertices", each.vertices, "1");
    table.add("attachment", name, "on_bone", each.on_bone, "1");
    table.add("attachment", name, "brought_mean", 1000 * each.brought, "mm");
    table.add("attachment", name, "brought_most", 1000 * each.brought_most, "mm");
    table.add("attachment", name, "from_bone", 1000 * each.from_bone, "mm");
  }
  for (const MuscleFit& each : transferred.muscles.muscles) {
    table.add("muscle", each.muscle, "template_volume", 1e6 * each.template_volume, "cm3");
    table.add("muscle", each.muscle, "warped_volume", 1e6 * each.warped_volume, "cm3");
    table.add("muscle", each.muscle, "volume", 1e6 * each.volume, "cm3");
  }
  return table.text();
}

nlohmann::ordered_json hashes_of(const std::vector<fs::path>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::set<fs::path> done;
  for (const fs::path& file : files)
    if (done.insert(file).second) list.push_back({{"file", file.string()}, {"sha256", content_hash(file)}});
  return list;
}

std::string manifest_text(const TemplateScene& origin, const Transferred& transferred, const TransferRecord& record,
                          const std::vector<std::string>& left_out) {
  nlohmann::ordered_json json;
  json["gracilis"] = record.version;
  json["command"] = record.command;
  json["template"] = origin.name;
  json["mirrored"] = transferred.is_mirrored;
  json["unit_of_subject"] = transferred.subject.unit;
  for (const FittedBone& bone : transferred.skeleton.bones) {
    const FoundBone& found = transferred.subject.bones[bone.match.of_subject];
    const BoneFit& fit = bone.registered.fit;
    json["bones"].push_back({{"template", template_bone(transferred, bone).name},
                             {"subject", with_part(found.file.string(), found.part)},
                             {"rms_to_subject_mm", 1000 * fit.to_subject},
                             {"rms_to_template_mm", 1000 * fit.to_template},
                             {"within_95_mm", 1000 * fit.p95},
                             {"template_without_counterpart", fit.trimmed_template},
                             {"subject_without_counterpart", fit.trimmed_subject}});
  }
  for (const Guess& guess : transferred.guesses) json["guessed"].push_back(guess.subject + ": " + to_string(guess));
  json["doubtful"] = transferred.skeleton.doubtful;
  for (const AttachmentFit& each : transferred.muscles.attachments)
    if (!each.on_bone) json["doubtful"].push_back(each.muscle + " " + each.attachment + ": on no bone of the subject");
  json["left_out"] = left_out;
  std::vector<fs::path> subject;
  for (const FittedBone& bone : transferred.skeleton.bones)
    subject.push_back(transferred.subject.bones[bone.match.of_subject].file);
  json["inputs"] = {{"template", hashes_of(origin.loaded.inputs)},
                    {"subject", hashes_of(subject)},
                    {"options", hashes_of(record.inputs)}};
  return json_text(json);
}

}  // namespace

TriangleMesh laid_bone(const Transferred& transferred, const FittedBone& bone) {
  const TriangleMesh& surface = template_bone(transferred, bone).surface;
  return {bone.registered.map.at(surface.vertices), surface.faces};
}

Eigen::VectorXd fit_distances(const Transferred& transferred, const FittedBone& bone) {
  const NearestTriangle laid(laid_bone(transferred, bone));
  const Points& vertices = transferred.subject.bones[bone.match.of_subject].mesh.vertices;
  Eigen::VectorXd distances(vertices.cols());
  parallel_for(static_cast<Index>(vertices.cols()), 256, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) distances[v] = laid.query(vertices.col(v)).distance;
  });
  return distances;
}

std::vector<std::string> write_transfer_folder(const TemplateScene& origin, const Transferred& transferred,
                                               const TransferRecord& record, const fs::path& folder) {
  for (const char* part : {"bones", "muscles", "fit"}) create_folder(folder / part);
  write_bones(transferred, folder);
  write_muscles(transferred.scene, folder);
  std::vector<std::string> left_out = transferred.left_out;
  const toml::table tables = subject_tables(origin, transferred, folder, left_out);
  std::error_code ignored;
  fs::remove(folder / "tables", ignored);  // where nothing lies in it
  write_text_atomically(folder / "fit.csv", fit_table(transferred));
  write_text_atomically(folder / "transfer.json", manifest_text(origin, transferred, record, left_out));
  std::string text = fmt::format(
      "# Made by 'gracilis transfer' of {}{}: its muscles and joints on other bones. transfer.html tells how well\n"
      "# they fit, fit.csv has the numbers; 'gracilis print-config' explains every key.\n",
      origin.name, transferred.is_mirrored ? ", mirrored" : "");
  for (const std::string& line : left_out) text += "# Left out: " + line + "\n";
  write_text_atomically(folder / "scene.toml", text + toml_of(tables));
  return left_out;
}

}  // namespace gracilis
