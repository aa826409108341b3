// See page.h. The texts of report/page/ are part of the program (cmake/embed_pages.cmake).
#include "report/page.h"

#include "report/page_texts.h"

namespace whittle {
namespace {

/// Plain text as HTML has it.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// JSON inside a <script>: nothing in it may end that, whatever a scene is called.
std::string inScript(const nlohmann::ordered_json& data) {
  std::string out;
  for (const char c : data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))
    out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

}  // namespace

std::string pageText(const std::string& title, const std::string& script,
                     const nlohmann::ordered_json& data) {
  const auto& texts = pageTexts();
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         // An empty icon: browsers would ask for one.
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + texts.at("page.css") +
         "</style>\n</head>\n<body>\n<main></main>\n<script type=\"application/json\" id=\"data\">" +
         inScript(data) + "</script>\n<script>\n" + texts.at("chart.js") + texts.at(script) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace whittle
