#include "SceneTree.hpp"

#include <Teuchos_StringInputStream.hpp>
#include <Teuchos_XMLObject.hpp>
#include <Teuchos_XMLParser.hpp>
#include <algorithm>

#include <suture/base/Numbers.hpp>

namespace suture {
namespace {

/// Teuchos' parser is strict and counts lines; the user needs only "line N: what" of its message.
std::string complaint(const std::string& what) {
  const std::string mark = "XML parse error at ";
  const std::size_t at = what.find(mark);
  if (at == std::string::npos) return "this is not valid XML: " + trimmed(what.substr(what.find_last_of('\n', what.size() - 2) + 1));
  return "this is not valid XML: " + trimmed(what.substr(at + mark.size(), what.find('\n', at) - at - mark.size()));
}

constexpr int deepest = 50;  // nesting of lists; scenes have up to five levels

/// Line of the first element nested deeper than `deepest`, or 0. Parsers recurse once per level, so such a text must not reach them.
int tooDeep(const std::string& text) {
  int depth = 0;
  std::size_t at = 0;
  const auto behind = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  while ((at = text.find('<', at)) != std::string::npos) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = behind("-->", at + 4);
    } else if (text.compare(at, 9, "<![CDATA[") == 0) {
      at = behind("]]>", at + 9);
    } else if (text.compare(at, 2, "<?") == 0 || text.compare(at, 2, "<!") == 0) {
      at = behind(">", at);
    } else {
      const bool closes = text.compare(at, 2, "</") == 0;
      const std::size_t begin = at;
      for (++at; at < text.size() && text[at] != '>'; ++at)
        if (text[at] == '"' || text[at] == '\'') at = std::min(text.find(text[at], at + 1), text.size() - 1);
      if (closes)
        depth = std::max(0, depth - 1);
      else if (at == 0 || at >= text.size() || text[at - 1] != '/')
        ++depth;
      if (depth > deepest) return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    }
  }
  return 0;
}

class TreeBuilder {
 public:
  explicit TreeBuilder(Problems& problems) : problems_(problems) {}

  void fill(const Teuchos::XMLObject& xml, const std::string& path, RawList& list) {
    refuseText(xml, path);
    for (int i = 0; i < xml.numChildren(); ++i) {
      const Teuchos::XMLObject& child = xml.getChild(i);
      const std::string& tag = child.getTag();
      if (tag != "Parameter" && tag != "ParameterList") {
        problems_.add(path, "no such element <" + tag + ">." + suggestion(tag, {"Parameter", "ParameterList"}));
        continue;
      }
      std::string name;
      if (!readName(child, path, name)) continue;
      const std::string here = joinPath(path, name);
      if (list.parameter(name) || list.list(name)) {
        problems_.add(here, "is given twice; remove one of them");
      } else if (tag == "ParameterList") {
        list.lists.emplace_back().name = name;
        fill(child, here, list.lists.back());
      } else {
        readParameter(child, here, name, list);
      }
    }
  }

 private:
  bool readName(const Teuchos::XMLObject& xml, const std::string& path, std::string& name) {
    const std::string what = xml.getTag() == "Parameter" ? "a parameter" : "a list";
    if (!xml.hasAttribute("name")) {
      problems_.add(path, what + " without the attribute name");
      return false;
    }
    name = xml.getAttribute("name");
    if (trimmed(name).empty()) {
      problems_.add(path, what + " whose name is empty");
      return false;
    }
    // These would make paths ambiguous: in messages, in --set and in the names of Teuchos' lists.
    for (const char* taken : {"/", "=", "->"}) {
      if (name.find(taken) == std::string::npos) continue;
      problems_.add(path, "the name '" + name + "' contains '" + taken + "', which is reserved for paths");
      return false;
    }
    return true;
  }

  void readParameter(const Teuchos::XMLObject& xml, const std::string& path, const std::string& name, RawList& list) {
    refuseText(xml, path);
    if (xml.numChildren() > 0) problems_.add(path, "a parameter must be an empty element, found <" + xml.getChild(0).getTag() + ">");
    RawParameter parameter;
    parameter.name = name;
    if (xml.hasAttribute("type")) parameter.type = xml.getAttribute("type");
    // Kept even without a value, to avoid a second message that the parameter is missing.
    parameter.hasValue = xml.hasAttribute("value");
    if (parameter.hasValue)
      parameter.value = xml.getAttribute("value");
    else
      problems_.add(path, "has no attribute 'value'");
    list.parameters.push_back(parameter);
  }

  void refuseText(const Teuchos::XMLObject& xml, const std::string& path) {
    for (int i = 0; i < xml.numContentLines(); ++i) {
      const std::string text = trimmed(xml.getContentLine(i));
      if (!text.empty()) problems_.add(path, "text outside of any attribute: '" + text + "'");
    }
  }

  Problems& problems_;
};

}  // namespace

const RawParameter* RawList::parameter(const std::string& wanted) const {
  for (const RawParameter& one : parameters) {
    if (one.name == wanted) return &one;
  }
  return nullptr;
}

RawParameter* RawList::parameter(const std::string& wanted) {
  return const_cast<RawParameter*>(static_cast<const RawList&>(*this).parameter(wanted));
}

const RawList* RawList::list(const std::string& wanted) const {
  for (const RawList& one : lists) {
    if (one.name == wanted) return &one;
  }
  return nullptr;
}

RawList* RawList::list(const std::string& wanted) { return const_cast<RawList*>(static_cast<const RawList&>(*this).list(wanted)); }

std::string joinPath(const std::string& list, const std::string& entry) {
  return list.empty() ? entry : entry.empty() ? list : list + "/" + entry;
}

RawList parseTree(const std::string& text, const std::string& path, Problems& problems) {
  RawList top;
  const std::string mark = "\xEF\xBB\xBF";  // some editors begin UTF-8 files with it
  const std::string plain = text.compare(0, mark.size(), mark) == 0 ? text.substr(mark.size()) : text;
  if (trimmed(plain).empty()) {
    problems.add(path, "the file is empty");
    return top;
  }
  if (const int line = tooDeep(plain); line > 0) {
    problems.add(path, "line " + std::to_string(line) + ": elements are nested more than " + std::to_string(deepest) + " deep");
    return top;
  }
  Teuchos::XMLObject xml;
  try {
    xml = Teuchos::XMLParser(Teuchos::rcp(new Teuchos::StringInputStream(plain))).parse();
  } catch (const std::exception& error) {
    problems.add(path, complaint(error.what()));
    return top;
  }
  if (xml.isEmpty() || xml.getTag() != "ParameterList") {
    problems.add(path, "the outermost element must be <ParameterList>, found " + (xml.isEmpty() ? "none" : "<" + xml.getTag() + ">"));
    return top;
  }
  if (xml.hasAttribute("name")) top.name = xml.getAttribute("name");
  TreeBuilder(problems).fill(xml, "", top);
  return top;
}

void applyOverride(RawList& top, const std::string& assignment, Problems& problems) {
  const std::size_t equals = assignment.find('=');
  const std::string path = trimmed(assignment.substr(0, equals));
  if (equals == std::string::npos || path.empty()) {
    problems.add("--set", "'" + assignment + "' is not of the form Path/To/Parameter=value");
    return;
  }
  RawList* list = &top;
  std::string walked;
  std::size_t begin = 0;
  for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', begin)) {
    const std::string name = trimmed(path.substr(begin, slash - begin));
    begin = slash + 1;
    walked = joinPath(walked, name);
    if (name.empty() || list->parameter(name)) {
      problems.add("--set",
                   "'" + assignment + "': " + (name.empty() ? "an empty name in the path" : "'" + walked + "' is a parameter, not a list"));
      return;
    }
    if (!list->list(name)) list->lists.emplace_back().name = name;
    list = list->list(name);
  }
  const std::string name = trimmed(path.substr(begin));
  if (name.empty() || list->list(name)) {
    problems.add("--set",
                 "'" + assignment + "': " + (name.empty() ? "an empty name in the path" : "'" + path + "' is a list, not a parameter"));
    return;
  }
  RawParameter* known = list->parameter(name);
  if (known && known->isSet) {
    problems.add(path, "is set twice on the command line");
    return;
  }
  if (!known) known = &list->parameters.emplace_back();
  *known = {name, "", assignment.substr(equals + 1), true, true, false};
}

}  // namespace suture
