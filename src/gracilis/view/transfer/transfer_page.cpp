#include <gracilis/view/transfer/transfer_page.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/transfer/transfer_folder.hpp>
#include <gracilis/view/pictures/color_scale.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/report/html_text.hpp>
#include <gracilis/view/report/tables_head.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gracilis {

namespace embedded {

extern const std::string_view transfer_html;  // the file beside this one

}  // namespace embedded

namespace {

/// From none to 2 mm: where a bone's surface is about known.
const ColorScale& fit_scale() {
  static const ColorScale scale = [] {
    ColorScale result = color_scale(ColorBy::activation);
    result.title = "bones apart, mm";
    result.low = 0;
    result.high = 0.002;
    result.ticks = {"0", "1", "≥ 2"};
    return result;
  }();
  return scale;
}

PaintedSurface painted_bone(const Transferred& transferred, const FittedBone& bone) {
  const TriangleMesh& mesh = transferred.subject.bones[bone.match.of_subject].mesh;
  const Eigen::VectorXd distances = fit_distances(transferred, bone);
  PaintedSurface surface{"", mesh};
  surface.colors.resize(3, mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) surface.colors.col(v) = color_at(fit_scale(), distances[v]);
  return surface;
}

std::string row(const std::string& name, std::initializer_list<std::string> cells) {
  std::string text = "<tr><td>" + in_element(name) + "</td>";
  for (const std::string& cell : cells) text += "<td>" + in_element(cell) + "</td>";
  return text + "</tr>\n";
}

std::string table(std::initializer_list<const char*> heads, const std::string& rows) {
  std::string text = "<table><tr>";
  for (const char* head : heads) text += fmt::format("<th>{}</th>", head);
  return text + "</tr>\n" + rows + "</table>";
}

std::string mm(Real length) { return fmt::format("{:.2f}", 1000 * length); }
std::string percent(Real share) { return fmt::format("{:.1f}", 100 * share); }

std::string bone_table(const Transferred& transferred) {
  std::string rows;
  for (const FittedBone& bone : transferred.skeleton.bones) {
    const RegisteredBone& it = bone.registered;
    rows += row(transferred.whole_template.bones[static_cast<std::size_t>(bone.match.of_template)].name,
                {transferred.subject.bones[bone.match.of_subject].file.filename().string(),
                 fmt::format("{:.3f}", it.similarity.scale), mm(it.similar), mm(it.fit.to_subject),
                 mm(it.fit.to_template), mm(it.fit.p95), mm(it.fit.worst), mm(it.fit.all),
                 percent(it.fit.trimmed_template), percent(it.fit.trimmed_subject)});
  }
  return table({"Bone", "Subject's file", "Scale", "Undeformed", "To subject", "To template", "95 %", "Worst",
                "With trimmed", "Trimmed of template, %", "of subject, %"},
               rows);
}

std::string joint_table(const Transferred& transferred) {
  std::string rows;
  for (std::size_t j = 0; j < transferred.joints.size(); ++j) {
    const JointTransfer& joint = transferred.joints[j];
    std::string captures;
    for (const std::string& capture : joint.captures) captures += (captures.empty() ? "" : "; ") + capture;
    rows += row(transferred.scene.joints[j].name, {mm(joint.from_warp), to_string(joint.guess), captures});
  }
  return table({"Joint", "Center from where the warp alone puts it, mm", "How", "Capture pose"}, rows);
}

std::string attachment_table(const Transferred& transferred) {
  std::string rows;
  for (const AttachmentFit& each : transferred.muscles.attachments)
    rows += row(each.muscle + " " + each.attachment, {fmt::format("{}", each.vertices), each.on_bone ? "yes" : "no",
                                                      mm(each.brought), mm(each.brought_most), mm(each.from_bone)});
  return table({"Attachment", "Vertices", "On its bone", "Brought", "At most", "From the bone"}, rows);
}

std::string volume_table(const Transferred& transferred) {
  std::string rows;
  const auto cm3 = [](Real volume) { return fmt::format("{:.1f}", 1e6 * volume); };
  for (const MuscleFit& each : transferred.muscles.muscles)
    rows += row(each.muscle, {cm3(each.template_volume), cm3(each.warped_volume), cm3(each.volume)});
  return table({"Muscle", "Template, cm³", "Warped, cm³", "Subject, cm³"}, rows);
}

std::string guess_table(const Transferred& transferred) {
  std::string rows;
  for (const Guess& guess : transferred.guesses) rows += row(guess.subject, {to_string(guess)});
  return table({"What", "How"}, rows);
}

std::string trouble_list(const Transferred& transferred, const TransferPage& page) {
  std::string text;
  const auto add = [&](const char* kind, const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      text += fmt::format("<p><span class=\"trouble\">{}</span> {}</p>\n", kind, in_element(line));
  };
  add("look at", transferred.skeleton.doubtful);
  add("left out", page.left_out);
  add("warning", page.warnings);
  return text;
}

}  // namespace

Picture transfer_picture(const Transferred& transferred, const Scene& scene) {
  const Vec3 forward = scene.axes.anterior, right = scene.axes.right();
  const std::array<std::pair<const char*, Vec3>, 4> views = {
      {{"from the front", -forward}, {"from the right", -right}, {"from behind", forward}, {"from the left", right}}};
  Picture picture;
  picture.title = scene.name + ": how the template's bones fit; its muscles on the subject's bones";
  picture.columns = static_cast<int>(views.size());
  picture.panel_width = 480;
  picture.scale_bar = true;
  picture.color_bar = ColorBar{fit_scale().title, fit_scale().colors, fit_scale().ticks};
  std::vector<PaintedSurface> bones, muscles;
  for (const FittedBone& bone : transferred.skeleton.bones) bones.push_back(painted_bone(transferred, bone));
  for (const Bone& bone : scene.bones) muscles.push_back({"", bone.surface});
  for (const Muscle& muscle : scene.muscles) muscles.push_back({"", muscle.surface, muscle_color(muscle.name)});
  for (const std::vector<PaintedSurface>* surfaces : {&bones, &muscles})
    for (const auto& [caption, looking] : views) {
      Panel panel;
      panel.caption = caption;
      panel.looking = looking;
      panel.up = scene.axes.superior;
      panel.surfaces = *surfaces;
      picture.panels.push_back(std::move(panel));
    }
  return picture;
}

void write_transfer_page(const std::filesystem::path& path, const Transferred& transferred, const TransferPage& page) {
  std::string text(embedded::transfer_html);
  const Scene& scene = transferred.scene;
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(text, "guesses", guess_table(transferred));
  fill(text, "volumes", volume_table(transferred));
  fill(text, "attachments", attachment_table(transferred));
  fill(text, "joints", joint_table(transferred));
  fill(text, "bones", bone_table(transferred));
  fill(text, "picture",
       page.picture.empty() ? ""
                            : "<img alt=\"bones colored by fit errors, muscles\" src=\"data:image/png;base64," +
                                  base64(page.picture) + "\">");
  fill(text, "trouble", trouble_list(transferred, page));
  fill(text, "summary",
       in_element(fmt::format("{} bones, {} joints and {} muscles carried from {}{}.", scene.bones.size(),
                              scene.joints.size(), scene.muscles.size(), page.origin,
                              transferred.is_mirrored ? ", mirrored" : "")));
  fill(text, "heading", "Transfer to " + in_element(scene.name));
  fill(text, "head", tables_head(scene.name, "transfer"));
  write_text_atomically(path, text);
}

}  // namespace gracilis
