#pragma once
#include <suture/base/Errors.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace suture {

struct RawList;

/// Text of another file that a scene uses, or the reason why it cannot be read.
struct IncludedFile {
  std::string text;
  std::string failure;  ///< "" for a file that was read

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.text), each(self.failure);
  }
};

/// Files by path, as SceneCompletion::Reader was called with it.
using IncludedFiles = std::map<std::string, IncludedFile>;

/// Adds entries from other files to a scene before the scene is checked (Schema::completedBy()): the reader of the scene gives access to
/// the files, so that one rank can read them for all.
class SceneCompletion {
 public:
  using Reader = std::function<const IncludedFile&(const std::string& path)>;
  virtual ~SceneCompletion() = default;

  /// Local; depends on its arguments only, so that all ranks get the same result.
  /// \param scene  as written, with the assignments of --set; receives the entries
  /// \param folder  base folder of relative names in the scene
  /// \param problems  receives errors of the files and of the names that refer to them
  /// \param notes  receives notes for the user
  virtual void complete(RawList& scene, const std::string& folder, const Reader& read, Problems& problems,
                        std::vector<std::string>& notes) const = 0;
};

}  // namespace suture
