#pragma once
#include <string>

namespace suture {

/// A text as it may stand between double quotes in XML. Local.
std::string escaped(const std::string& text);

/// `<Parameter name="..." type="..." value="..."/>` in one line, indented by `depth` steps. Local.
std::string parameterElement(int depth, const std::string& name, const std::string& type, const std::string& value);

/// The blanks before a line at a depth. Local.
std::string indentation(int depth);

}  // namespace suture
