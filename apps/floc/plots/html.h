#pragma once

#include <string>

#include "floc/io/table.h"

namespace floc {

/// Returns a text with the special characters of html written as entities.
std::string html_text(const std::string& text);

/// Returns a text, with its special characters escaped, as an html element such as "li".
std::string html_text(const std::string& text, const std::string& element);

/// Returns a table as html. Numbers have four significant digits, and undefined values are a dash.
std::string html_table(const Table& table);

/// Returns an html figure that contains an svg picture as a data URL.
/// @param caption  description of the figure, which is also its alternative text for screen readers
std::string html_figure(const std::string& svg, const std::string& caption);

/// Returns a complete html page that refers to no other file. The page contains the style for screen and paper.
/// @param head  html that is added to the head element, such as styles and scripts
std::string html_page(const std::string& title, const std::string& body, const std::string& head = "");

}  // namespace floc
