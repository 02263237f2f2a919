// Another array of variables in the place of the process's own: unlike setenv(), this moves nothing that another thread
// may be reading.
#include "base/temporary_environment.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <string_view>

extern char** environ;

namespace billow {
namespace {

struct KeptEnvironment {
  std::vector<std::string> set;
  std::vector<char*> variables;  // ends with a null
};

bool is_of(const char* variable, const std::string& name) {
  const std::string_view text = variable;
  return text.size() > name.size() && text.substr(0, name.size()) == name && text[name.size()] == '=';
}

KeptEnvironment changed_environment(char** before, const std::vector<TemporaryEnvironment::Change>& changes) {
  KeptEnvironment kept;
  for (const auto& [name, value] : changes)
    if (value) kept.set.push_back(name + '=' + *value);
  const auto is_changed = [&](const char* variable) {
    return std::any_of(changes.begin(), changes.end(),
                       [&](const TemporaryEnvironment::Change& change) { return is_of(variable, change.first); });
  };
  for (char** variable = before; variable && *variable; ++variable)
    if (!is_changed(*variable)) kept.variables.push_back(*variable);
  for (std::string& text : kept.set) kept.variables.push_back(text.data());
  kept.variables.push_back(nullptr);
  return kept;
}

// Moving leaves the strings where they are, in their vector's array.
char** keep_environment(KeptEnvironment environment) {
  static std::mutex mutex;
  static std::list<KeptEnvironment>* const all = new std::list<KeptEnvironment>;  // also after static destructors
  const std::lock_guard lock(mutex);
  all->push_back(std::move(environment));
  return all->back().variables.data();
}

}  // namespace

TemporaryEnvironment::TemporaryEnvironment(const std::vector<Change>& changes) : before_(environ) {
  environ = keep_environment(changed_environment(before_, changes));
}

TemporaryEnvironment::~TemporaryEnvironment() { environ = before_; }

}  // namespace billow
