#pragma once

#include <string>

#include "floc/io/table.h"

namespace floc {

/// Returns text with the special characters of html written as entities.
std::string html_text(const std::string& text);

/// Returns the escaped text as an element, such as "li".
std::string html_text(const std::string& text, const std::string& element);

/// Returns a table as html: numbers with four significant digits, undefined values as a dash.
std::string html_table(const Table& table);

/// Returns a figure that holds its svg as a data URL.
/// @param caption  description of the figure; also its alternative text, for screen readers
std::string html_figure(const std::string& svg, const std::string& caption);

/// Returns a page that refers to no other file; it includes the style for screen and paper.
/// @param head  further content of its head element: style, scripts
std::string html_page(const std::string& title, const std::string& body, const std::string& head = "");

}  // namespace floc
