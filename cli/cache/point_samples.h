// The positions of a point cache, on their way to a file whose head says how many there are.
#pragma once

#include "base/spool.h"
#include "cli/cache/bytes.h"

namespace billow::cli {

/// Single-precision positions, frame after frame, in `order`.
template <ByteOrder order>
class PointSamples {
 public:
  /// For `file`, beside which they wait.
  explicit PointSamples(const std::filesystem::path& file) : file_(file), spool_(file) {}

  void add(const Eigen::MatrixX3f& position) {
    bytes_.clear();
    put_rows<order>(bytes_, position);
    spool_.append(bytes_.data(), bytes_.size());
    size_ += bytes_.size();
    ++count_;
  }
  std::int32_t count() const { return count_; }

  /// The file: `head`, then all of them.
  void write(std::string_view head) const {
    AtomicFile output(file_);
    output.append(head);
    spool_.copy_to(output, size_);
    output.commit();
  }

 private:
  std::filesystem::path file_;
  Spool spool_;
  std::string bytes_;  // of one frame
  std::size_t size_ = 0;
  std::int32_t count_ = 0;
};

}  // namespace billow::cli
