// Which of the files that a scene, a study or a mesh names may be read, and what of them messages may show.
//
// What a command reads first is the file that its user named. That file names others, and whoever wrote it may be a
// stranger: it can name any file that the user can read. Messages end up in logs that others see, so a file that the
// user did not name, outside of the folder of the one that he did, is not quoted before it has proved to be what it is
// said to be. --untrusted goes further: such files are not even looked at.
#pragma once

#include <filesystem>

namespace billow {

/// What may be done with files outside of the named file's folder.
enum class Outside { readable, refused };

/// The file that the user named, whose folder, links followed, everything below it included, is trusted. For the whole
/// process, like umask: call it before the first file is read. Throws InputError where outside files are refused and
/// `named` is itself a link that leads out of its folder.
void trust_folder_of(const std::filesystem::path& named, Outside outside);

/// Throws InputError, with the true reason, where outside files are refused and `file` is one, links followed. Says the
/// same whether or not there is such a file.
void require_trusted(const std::filesystem::path& file);

/// Whether `path` is `folder` or in it or below; both as the system resolves them.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Whether messages may show what stands in `file`: it is the named one or below its folder, or nothing was named.
bool may_be_quoted(const std::filesystem::path& file);

}  // namespace billow
