#include "plots/html.h"

#include <fmt/format.h>

#include <cmath>

namespace floc {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 "DejaVu Sans", Verdana, sans-serif; color: #202020; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #bbb; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.8em; } th, td { padding: 0.15em 0.7em; border-bottom: 1px solid #e2e2e2; }
th { text-align: left; } td { white-space: nowrap; } td.number { text-align: right; font-variant-numeric: tabular-nums; }
figure { margin: 1.5em 0; } figure img { max-width: 100%; height: auto; } figcaption { font-size: 0.85em; color: #555; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; } .plots figure { flex: 1 1 26em; margin: 0.5em 0; }
pre { font-size: 0.75em; background: #f5f5f5; padding: 1em; overflow-x: auto; white-space: pre-wrap; }
.warnings li { margin: 0.2em 0; }
@media print {
  body { max-width: none; margin: 0; font-size: 10px; } figure, tr { break-inside: avoid; } h2 { break-after: avoid; }
  figure img { max-height: 105mm; }
  .plots figure { flex-basis: 45%; max-width: 48%; } .wide { overflow: visible; } td { white-space: normal; }
}
@page { margin: 15mm; }
)";

struct CellText {
  std::string operator()(std::monostate) const { return "<td>–</td>"; }
  std::string operator()(bool value) const { return value ? "<td>yes</td>" : "<td>no</td>"; }
  std::string operator()(std::int64_t value) const {
    return fmt::format("<td class=\"number\">{}</td>", value);
  }
  std::string operator()(double value) const {
    return std::isfinite(value) ? fmt::format("<td class=\"number\">{:.4g}</td>", value) : "<td>–</td>";
  }
  std::string operator()(const std::string& value) const { return "<td>" + html_text(value) + "</td>"; }
};

/// Returns bytes in the encoding of a data URL (RFC 3986): % and two hexadecimal digits for each byte that is not one
/// of a few plain characters.
std::string percent_encoded(const std::string& text) {
  constexpr std::string_view kPlain = "-_.~ /:;=,()+*!'";
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       kPlain.find(c) != std::string_view::npos;
    if (plain)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string html_text(const std::string& text, const std::string& element) {
  return "<" + element + ">" + html_text(text) + "</" + element + ">\n";
}

std::string html_table(const Table& table) {
  std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const std::string& column : table.columns) out += "<th>" + html_text(column) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const TableValue& value : row) out += std::visit(CellText{}, value);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string html_figure(const std::string& svg, const std::string& caption) {
  const std::string text = html_text(caption);
  return "<figure><img alt=\"" + text + "\" src=\"data:image/svg+xml;charset=utf-8," + percent_encoded(svg) +
         "\"><figcaption>" + text + "</figcaption></figure>\n";
}

std::string html_page(const std::string& title, const std::string& body, const std::string& head) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title) + "</title>\n<style>" + kStyle + "</style>\n" + head + "</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

}  // namespace floc
