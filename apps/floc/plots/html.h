#pragma once

#include <string>

#include "floc/io/table.h"

namespace floc {

/// Text with the characters that mean something in html written as entities.
std::string html_text(const std::string& text);

/// The same as an element, such as "li".
std::string html_text(const std::string& text, const std::string& element);

/// A table; numbers with four significant digits, undefined values as a dash.
std::string html_table(const Table& table);

/// A figure that carries its svg within itself, as a data address.
/// @param caption  what it shows; it is read out in its place too
std::string html_figure(const std::string& svg, const std::string& caption);

/// A whole page that needs nothing else: style for screen and paper included.
/// @param head  what goes into its head besides: further style, scripts
std::string html_page(const std::string& title, const std::string& body, const std::string& head = "");

}  // namespace floc
