// Work that several processes, on one machine or on many, share: each piece is claimed before it is begun.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

namespace billow {

/// Who is at a piece of work.
struct ClaimHolder {
  std::string host;      // empty where the claim does not say
  long process = 0;      // on that host
  std::string since;     // "2026-11-29 09:32:38 UTC"
  bool is_near = false;  // on this machine, which knows whether the process lives
};

/// A file that stands for being at a piece of work. It names the host, the process and when it was taken; only one can
/// create it (link(), or O_EXCL where there are no links: both hold on NFS). It is removed when this goes out of scope.
///
/// A claim counts as long as its holder lives. Of a process on this machine the kernel knows that. A holder elsewhere
/// gives signs of life by touching the file, and is taken for dead when the file has not been touched for `dead_after`,
/// by the file system's own clock.
class Claim {
 public:
  static constexpr std::chrono::seconds sign_interval{5}, dead_after{60};

  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&& other) noexcept;
  ~Claim();

  /// Gives a sign of life, which is due every sign_interval. False when the claim is another's by now, or was removed:
  /// then stop.
  bool renew() const;

 private:
  friend std::variant<Claim, ClaimHolder> take_claim(const std::filesystem::path& file);
  Claim(std::filesystem::path file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}
  void let_go() noexcept;

  std::filesystem::path file_;  // empty: holds nothing
  std::string text_;
};

/// Takes the claim `file`, also from a holder that is dead, or says who has it. Throws OutputError when the file cannot
/// be made, InputError when something that is no file is in its place.
std::variant<Claim, ClaimHolder> take_claim(const std::filesystem::path& file);

/// Removes the claim `file` where its holder was a process of this machine and is dead. Throws as take_claim.
void remove_dead_claim(const std::filesystem::path& file);

/// Who holds the claim `file` now, if anyone who may be alive does. Throws InputError as take_claim.
std::optional<ClaimHolder> claim_holder(const std::filesystem::path& file);

}  // namespace billow
