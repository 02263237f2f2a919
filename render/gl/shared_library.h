// A library that is looked for when it is needed.
#pragma once

#include <string>

namespace billow::render {

/// A loaded library; it stays loaded, because drivers do not survive being unloaded.
class SharedLibrary {
 public:
  /// Throws ResourceError with the loader's reason and `packages`, what to install; std::bad_alloc.
  SharedLibrary(const std::string& name, const std::string& packages);

  /// Throws ResourceError when it has no such function.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  std::string name_;
  void* handle_;
};

}  // namespace billow::render
