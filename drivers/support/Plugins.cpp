#include "Plugins.hpp"

#include <dlfcn.h>

#include <suture/base/Errors.hpp>

namespace suture {

void loadPlugins(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    // dlopen looks for a bare name in the system's folders; a user who names a file means the one beside him.
    const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
    if (!dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL)) throw CommandLineError("cannot load the plugin '" + path + "': " + dlerror());
  }
}

}  // namespace suture
