#pragma once
#include <string>

namespace suture {

/// A text escaped for use between double quotes in XML. Local.
std::string escaped(const std::string& text);

/// `<Parameter name="..." type="..." value="..."/>` in one line, indented by `depth` steps. Local.
std::string parameterElement(int depth, const std::string& name, const std::string& type, const std::string& value);

/// The blanks that indent a line by `depth` steps. Local.
std::string indentation(int depth);

}  // namespace suture
