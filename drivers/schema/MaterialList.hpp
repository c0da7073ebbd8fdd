#pragma once
#include <string>

namespace suture {

/// The built-in materials: names, values and sources. Local.
/// \param format  "text", "markdown" (the page doc/materials_list.md) or "xml" (the file itself)
/// \throws InputError  the file is missing or has errors
std::string materialList(const std::string& format);

}  // namespace suture
