// One process at a time.
#pragma once

#include <filesystem>

namespace billow {

/// Holds a folder until it goes out of scope: another process that asks for it waits. Where the file system has no
/// locks, nobody waits. Throws OutputError when the folder cannot be opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace billow
