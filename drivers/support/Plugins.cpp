#include "Plugins.hpp"

#include <dlfcn.h>

#include <suture/base/Errors.hpp>

namespace suture {

void loadPlugins(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    // dlopen searches a bare name in system folders; users expect the current folder.
    const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
    if (!dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL)) throw CommandLineError("cannot load the plugin '" + path + "': " + dlerror());
  }
}

}  // namespace suture
