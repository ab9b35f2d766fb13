// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_page.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "viewer/page_template.h"
#include "viewer/view_json.h"

namespace phongpd {
namespace {

// JSON within <script>: nothing in it may end the element.
std::string ForScript(const nlohmann::ordered_json& json) {
  std::string text;
  // Names may come from files with bytes that are no UTF-8.
  for (const char c : JsonText(json)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

void RequireViewer() {
  if (!internal::PageTemplate().empty()) return;
  throw InputError(
      "page: this program was built without its viewer for want of three.js; "
      "install the Debian package libjs-three and build again");
}

std::string ViewPage(const View& view, std::size_t most_triangles) {
  RequireViewer();
  const std::string_view page = internal::PageTemplate();
  const auto mark = [page](std::string_view text) {
    const std::size_t found = page.find(text);
    if (found == std::string_view::npos) {
      throw std::logic_error("the page has no " + std::string(text));
    }
    return found;
  };
  constexpr std::string_view kTitle = "@VIEW_TITLE@", kData = "@VIEW_DATA@";
  const std::size_t title = mark(kTitle), data = mark(kData);
  std::string text(page.substr(0, title));
  text += Escaped(view.title);
  text += page.substr(title + kTitle.size(), data - title - kTitle.size());
  text += ForScript(ViewJson(view, most_triangles));
  text += page.substr(data + kData.size());
  return text;
}

}  // namespace phongpd
