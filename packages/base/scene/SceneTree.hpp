#pragma once
#include <suture/base/Errors.hpp>

#include <list>
#include <string>
#include <vector>

namespace suture {

/// A parameter as written in the file or given by --set, not yet converted.
struct RawParameter {
  std::string name;
  std::string type;  ///< the attribute `type`; empty: not given
  std::string value;
  bool hasValue = true;
  bool isSet = false;    ///< by --set
  bool isAdded = false;  ///< from another file (SceneCompletion)
};

/// A list as written in the file. Names are unique within a list, over parameters and lists together.
struct RawList {
  std::string name;
  std::vector<RawParameter> parameters;
  std::list<RawList> lists;  ///< in the order of the file

  const RawParameter* parameter(const std::string& name) const;
  RawParameter* parameter(const std::string& name);
  const RawList* list(const std::string& name) const;
  RawList* list(const std::string& name);
};

/// "Contact/fault above": the path of an entry of a list; `list` is empty for the top list. Local.
std::string joinPath(const std::string& list, const std::string& entry);

/// Parses XML text to a tree. Duplicates, unknown elements, stray text, missing names and values go to `problems` and reading continues;
/// malformed XML ends it (the problem names the line) and gives an empty tree. Local.
RawList parseTree(const std::string& text, const std::string& path, Problems& problems);

/// Writes "Path/To/Parameter=value" into the tree; missing lists along the path are created. The path is checked with the tree. Local.
void applyOverride(RawList& top, const std::string& assignment, Problems& problems);

}  // namespace suture
