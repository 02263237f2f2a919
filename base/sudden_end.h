// What a process still sees to when it must go at once: from a signal handler, or without memory.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace billow {

/// A file that must not outlive the process: tidy_up() removes it. Where more than a few hundred exist at once, the
/// others are left to the next run.
class UnfinishedFile {
 public:
  /// Opens a new file as open() does, with its errno on failure. Once tidying has begun it does not return: the process
  /// is about to end.
  UnfinishedFile(const std::filesystem::path& file, int flags, unsigned mode);
  /// Closes nothing, removes nothing.
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Negative where it could not be opened.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1, slot_ = -1;
};

/// Whether this process is writing a file of this name, whatever its folder, just now.
bool is_unfinished(std::string_view name);

/// A place in a file of this process's own that says how it is getting on. There is one at a time; while it lives,
/// tidy_up() writes there. Words are written over words, so that a full disk is no hindrance.
class StandingMark {
 public:
  /// What stands at `offset` of `file`, and what is to stand there: all of one length. Where the file has something
  /// else there by then, nothing is written.
  StandingMark(const std::filesystem::path& file, off_t offset, const std::string& present, const std::string& failed,
               const std::string& interrupted);
  ~StandingMark();
  StandingMark(const StandingMark&) = delete;
  StandingMark& operator=(const StandingMark&) = delete;
};

/// Why the process goes.
enum class SuddenEnd { failure, interruption };

/// Removes unfinished files and writes the standing mark's words. Only calls that are safe in signal handlers. Nothing
/// in a forked child, whose parent's they are.
void tidy_up(SuddenEnd why) noexcept;

/// Writes the mark's words alone; false where there is none, where the file has something else there, or where they
/// cannot be written.
bool mark(SuddenEnd why) noexcept;

/// Whether there is a mark and its file still has there what it had at first.
bool mark_stands() noexcept;

}  // namespace billow
