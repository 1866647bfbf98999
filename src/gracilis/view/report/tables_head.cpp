#include <gracilis/view/report/tables_head.hpp>

#include <gracilis/view/report/html_text.hpp>

namespace gracilis {

namespace embedded {

extern const std::string_view tables_head_html;  // the file beside this one
extern const std::string_view tables_css;        // likewise

}  // namespace embedded

std::string tables_head(const std::string& title, const std::string& kind) {
  std::string head(embedded::tables_head_html.substr(0, embedded::tables_head_html.find_last_not_of('\n') + 1));
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(head, "style", embedded::tables_css);
  fill(head, "kind", kind);
  fill(head, "title", in_element(title));
  return head;
}

}  // namespace gracilis
