#include <gracilis/view/report/report.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/view/report/report_data.hpp>
#include <gracilis/view/report/report_shapes.hpp>

#include <string>
#include <string_view>

namespace gracilis {

namespace embedded {

// The files beside this one, and Debian's three.js: see gracilis_embed.cmake.
extern const std::string_view three_js, report_html, report_css, orbit_js, stage_js, chart_js, text_js, main_js;

}  // namespace embedded

using Json = nlohmann::ordered_json;

/// RFC 4648.
static std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (const int shift : {18, 12, 6, 0}) text += digits[(three >> shift) & 63];
  }
  for (std::size_t i = bytes.size(); i % 3 != 0; ++i) text[text.size() - 3 + i % 3] = '=';
  return text;
}

/// JSON inside a script element: nothing in it may look like the element's end.
static std::string in_script(const Json& json) {
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

/// Text inside an element.
static std::string in_element(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

/// Puts a text where the template says {{name}}.
static void fill(std::string& page, const std::string& name, std::string_view text) {
  const std::string place = "{{" + name + "}}";
  page.replace(page.find(place), place.size(), text);
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
  for (const std::string_view script :
       {embedded::orbit_js, embedded::stage_js, embedded::chart_js, embedded::text_js, embedded::main_js})
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
