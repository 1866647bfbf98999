#include <gracilis/view/report/report.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/view/report/html_text.hpp>
#include <gracilis/view/report/report_data.hpp>
#include <gracilis/view/report/report_shapes.hpp>

#include <string>
#include <string_view>

namespace gracilis {

namespace embedded {

// The files beside this one, and Debian's three.js: see gracilis_embed.cmake.
extern const std::string_view three_js, report_html, report_css, orbit_js, colors_js, evened_surface_js, stage_js,
    chart_js, text_js, main_js;

}  // namespace embedded

using Json = nlohmann::ordered_json;

/// JSON inside a script element: nothing in it may look like the element's end.
static std::string in_script(const Json& json) {
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

void write_report(const std::filesystem::path& path, const std::vector<RecordedRun>& runs,
                  const ReportOptions& options) {
  Json data = Json::array();
  std::string shapes, title;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    data.push_back(report_data(runs[i]));
    const ReportShapes each = report_shapes(runs[i], options.shape_bytes / runs.size());
    data.back()["shapes"] = each.description;
    shapes +=
        "<script type=\"text/plain\" id=\"shapes-" + std::to_string(i) + "\">" + base64(each.bytes) + "</script>\n";
    title += (i == 0 ? "" : " and ") + data.back()["name"].get<std::string>();
  }
  std::string scripts;
  for (const std::string_view script : {embedded::orbit_js, embedded::colors_js, embedded::evened_surface_js,
                                        embedded::stage_js, embedded::chart_js, embedded::text_js, embedded::main_js})
    scripts += script;
  std::string page(embedded::report_html);
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(page, "scripts", scripts);
  fill(page, "three", embedded::three_js);
  fill(page, "shapes", shapes);
  fill(page, "data", in_script(data));
  fill(page, "css", embedded::report_css);
  fill(page, "title", in_element(title));
  write_text_atomically(path, page);
}

}  // namespace gracilis
