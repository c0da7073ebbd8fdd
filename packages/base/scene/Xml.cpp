#include "Xml.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <suture/base/Errors.hpp>
#include "SceneReader.hpp"

namespace suture {
namespace {

template <typename T>
std::vector<T> entries(const Teuchos::ParameterEntry& entry) {
  return Teuchos::getValue<Teuchos::Array<T>>(entry).toVector();
}

std::string parameterLine(int depth, const std::string& name, const Teuchos::ParameterEntry& entry) {
  const auto line = [&](Schema::Kind kind, const Schema::Value& value) {
    return parameterElement(depth, name, typeName(kind), valueText(value));
  };
  using Kind = Schema::Kind;
  if (entry.isType<int>()) return line(Kind::Integer, static_cast<long long>(Teuchos::getValue<int>(entry)));
  if (entry.isType<double>()) return line(Kind::Real, Teuchos::getValue<double>(entry));
  if (entry.isType<bool>()) return line(Kind::Boolean, Teuchos::getValue<bool>(entry));
  if (entry.isType<std::string>()) return line(Kind::Text, Teuchos::getValue<std::string>(entry));
  if (entry.isType<Teuchos::Array<double>>()) return line(Kind::Reals, entries<double>(entry));
  if (entry.isType<Teuchos::Array<int>>()) return line(Kind::Integers, entries<int>(entry));
  if (entry.isType<Teuchos::Array<std::string>>()) return line(Kind::Texts, entries<std::string>(entry));
  throw InternalError("parameter '" + name + "' has a type that a scene file cannot represent");
}

void append(std::string& xml, int depth, const std::string& name, const Parameters& list) {
  xml += indentation(depth) + "<ParameterList name=\"" + escaped(name) + "\">\n";
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& inner = list.name(it);
    if (list.isSublist(inner))
      append(xml, depth + 1, inner, list.sublist(inner));
    else
      xml += parameterLine(depth + 1, inner, list.entry(it));
  }
  xml += indentation(depth) + "</ParameterList>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '>':
        all += "&gt;";
        break;
      case '"':
        all += "&quot;";
        break;
      default:
        all += c;
    }
  }
  return all;
}

std::string indentation(int depth) { return std::string(2 * static_cast<std::size_t>(depth), ' '); }

std::string parameterElement(int depth, const std::string& name, const std::string& type, const std::string& value) {
  return indentation(depth) + "<Parameter name=\"" + escaped(name) + "\" type=\"" + type + "\" value=\"" + escaped(value) + "\"/>\n";
}

std::string toXml(const Parameters& parameters) {
  std::string xml;
  append(xml, 0, parameters.name(), parameters);
  return xml;
}

}  // namespace suture
