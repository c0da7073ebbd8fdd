// The schema as text (console), markdown (documentation) and xml (template of a scene).
#include "SchemaDocument.hpp"

#include <algorithm>
#include <vector>

#include <suture/base/Errors.hpp>
#include "Xml.hpp"

namespace suture {
namespace {

std::string quoted(const Schema::Parameter& parameter) {
  const std::string value = valueText(*parameter.fallback);
  return parameter.kind == Schema::Kind::Text && value.empty() ? "\"\"" : value;
}

std::string defaultText(const Schema::Parameter& parameter) {
  if (parameter.fallback) return quoted(parameter);
  if (parameter.optional) return "optional";
  return parameter.with ? "required with " + parameter.with->first + " " + parameter.with->second : "required";
}

/// Range or names of a value; "" if anything is allowed.
std::string allowedText(const Schema::Parameter& parameter) {
  const std::string range = parameter.range.text() == "any" ? "" : parameter.range.text();
  const auto bars = [](const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " | ") + name;
    return all;
  };
  if (parameter.numberToo) return bars(parameter.words) + " | number" + (range.empty() ? "" : " " + range);
  return parameter.allowed.empty() ? range : bars(parameter.allowed);
}

/// "(double, default 1e-08, > 0, stress) meaning"
std::string sentence(const Schema::Parameter& parameter) {
  std::string text = "(" + typeName(parameter.kind) + ", " + (parameter.fallback ? "default " : "") + defaultText(parameter);
  const std::string allowed = allowedText(parameter);
  if (!allowed.empty()) text += ", " + allowed;
  if (!parameter.unit.empty()) text += ", " + parameter.unit;
  return text + ") " + parameter.doc;
}

std::string placeholder(const std::string& name) { return "<" + name + ">"; }

// text ------------------------------------------------------------------------------------------------------------------------------

void appendText(std::string& out, const Schema& schema, int depth) {
  const std::string blanks = indentation(depth);
  for (const Schema::Parameter& parameter : schema.parameters()) {
    out += blanks + parameter.name + "  " + sentence(parameter) + "\n";
    for (std::size_t i = 0; i < parameter.allowedDocs.size(); ++i)
      out += blanks + "    " + parameter.allowed[i] + ": " + parameter.allowedDocs[i] + "\n";
  }
  if (const Schema::Parameter* any = schema.userParameter())
    out += blanks + placeholder(any->name) + "  (" + typeName(any->kind) + ", named by you) " + any->doc + "\n";
  for (const auto& [name, inner] : schema.lists()) {
    out += blanks + name + "/" + (schema.requiredList(name) ? "  (required) " : "  ") + inner.doc() + "\n";
    appendText(out, inner, depth + 1);
  }
  if (schema.userLists()) {
    out += blanks + placeholder(schema.userListPlaceholder()) + "/  (named by you, at least " + std::to_string(schema.leastUserLists()) +
           ") " + schema.userLists()->doc() + "\n";
    appendText(out, *schema.userLists(), depth + 1);
  }
}

// markdown --------------------------------------------------------------------------------------------------------------------------

std::string cell(const std::string& text) {
  std::string all;
  for (const char c : text) all += c == '|' ? std::string("\\|") : c == '<' ? std::string("&lt;") : std::string(1, c);
  return all;
}

void appendMarkdown(std::string& out, const Schema& schema, const std::string& path) {
  out += "## " + (path.empty() ? "(top)" : cell(path)) + "\n\n" + schema.doc() + "\n\n";
  if (!schema.parameters().empty() || schema.userParameter()) {
    out += "| parameter | type | default | allowed | unit | meaning |\n|---|---|---|---|---|---|\n";
    for (const Schema::Parameter& parameter : schema.parameters()) {
      std::string doc = parameter.doc;
      for (std::size_t i = 0; i < parameter.allowedDocs.size(); ++i)
        doc += " *" + parameter.allowed[i] + "*: " + parameter.allowedDocs[i] + ".";
      out += "| " + parameter.name + " | " + typeName(parameter.kind) + " | " + cell(defaultText(parameter)) + " | " +
             cell(allowedText(parameter)) + " | " + cell(parameter.unit) + " | " + cell(doc) + " |\n";
    }
    if (const Schema::Parameter* any = schema.userParameter())
      out += "| " + cell(placeholder(any->name)) + " | " + typeName(any->kind) + " | named by you | | | " + cell(any->doc) + " |\n";
    out += "\n";
  }
  const std::string slash = path.empty() ? "" : path + "/";
  for (const auto& [name, inner] : schema.lists()) appendMarkdown(out, inner, slash + name);
  if (schema.userLists()) appendMarkdown(out, *schema.userLists(), slash + placeholder(schema.userListPlaceholder()));
}

// xml -------------------------------------------------------------------------------------------------------------------------------

/// Two hyphens in a row are not allowed inside an XML comment.
std::string commentable(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.replace(at, 2, "- -");
  return text;
}

/// A scene with every default, or the example's value. Names and values that the user must give, and that the example lacks, are placed in
/// a comment, which contains no other comment.
class XmlScene {
 public:
  explicit XmlScene(const SceneExample& example) : example_(example) {}

  std::string write(const Schema& schema) {
    out_ = "<ParameterList name=\"Suture\">\n";
    remark(1, schema.doc());
    body(schema, 1, "");
    return out_ + "</ParameterList>\n";
  }

 private:
  void remark(int depth, const std::string& text) {
    if (!inComment_ && !text.empty()) out_ += indentation(depth) + "<!-- " + commentable(text) + " -->\n";
  }

  /// Runs `content` inside a comment that begins with `why`.
  template <typename Content>
  void comment(int depth, const std::string& why, Content content) {
    const bool outer = inComment_;
    if (!outer) out_ += indentation(depth) + "<!-- " + commentable(why) + ":\n";
    inComment_ = true;
    content();
    inComment_ = outer;
    if (!outer) out_ += indentation(depth) + "-->\n";
  }

  void element(int depth, const std::string& name, Schema::Kind kind, const std::string& value) {
    const std::string line = parameterElement(depth, name, typeName(kind), value);
    out_ += inComment_ ? commentable(line) : line;
  }

  /// Names of the example's lists below a path, sorted; none within a comment.
  std::vector<std::string> examples(const std::string& path) const {
    std::vector<std::string> names;
    if (inComment_) return names;
    for (const auto& [key, value] : example_) {
      if (key.rfind(path, 0) != 0) continue;
      const std::size_t end = key.find('/', path.size());
      if (end == std::string::npos) continue;
      const std::string name = key.substr(path.size(), end - path.size());
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }

  void list(int depth, const std::string& name, const Schema& schema, const std::string& path) {
    out_ += indentation(depth) + "<ParameterList name=\"" + escaped(name) + "\">\n";
    remark(depth + 1, schema.doc());
    body(schema, depth + 1, path + name + "/");
    out_ += indentation(depth) + "</ParameterList>\n";
  }

  /// \param path  of the list, with a slash at its end
  void body(const Schema& schema, int depth, const std::string& path) {
    for (const Schema::Parameter& parameter : schema.parameters()) {
      remark(depth, parameter.name + " " + sentence(parameter));
      for (std::size_t i = 0; i < parameter.allowedDocs.size(); ++i) remark(depth, parameter.allowed[i] + ": " + parameter.allowedDocs[i]);
      const auto given = example_.find(path + parameter.name);
      if (!inComment_ && given != example_.end())
        element(depth, parameter.name, parameter.kind, given->second);
      else if (parameter.fallback)
        element(depth, parameter.name, parameter.kind, valueText(*parameter.fallback));
      else
        comment(depth, parameter.optional ? "optional" : "required", [&] { element(depth, parameter.name, parameter.kind, ""); });
    }
    if (const Schema::Parameter* any = schema.userParameter()) {
      comment(depth, "any number of entries, " + any->doc, [&] { element(depth, placeholder(any->name), any->kind, "0"); });
    }
    for (const auto& [name, inner] : schema.lists()) list(depth, name, inner, path);
    if (!schema.userLists()) return;
    for (const std::string& name : examples(path))
      if (std::none_of(schema.lists().begin(), schema.lists().end(), [&](const auto& list) { return list.first == name; }))
        list(depth, name, *schema.userLists(), path);
    {
      comment(depth, "any number of lists, at least " + std::to_string(schema.leastUserLists()) + ", " + schema.userLists()->doc(),
              [&] { list(depth, placeholder(schema.userListPlaceholder()), *schema.userLists(), path); });
    }
  }

  const SceneExample& example_;
  std::string out_;
  bool inComment_ = false;
};

}  // namespace

std::string documentOf(const Schema& schema, const std::string& format, const SceneExample& example) {
  std::string out;
  if (format == "text") {
    out = schema.doc() + "\n";
    appendText(out, schema, 1);
  } else if (format == "markdown") {
    appendMarkdown(out, schema, "");
  } else if (format == "xml") {
    out = XmlScene(example).write(schema);
  } else {
    throw CommandLineError(unknownName("format", format, {"text", "xml", "markdown"}));
  }
  return out;
}

}  // namespace suture
