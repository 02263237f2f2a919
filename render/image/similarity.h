// How alike the structure of two images is.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace billow::render {

/// Structural similarity of the luma (Wang, Bovik, Sheikh, Simoncelli: "Image quality assessment: from error visibility
/// to structural similarity", IEEE Trans. Image Processing 13(4), 2004), with a Gaussian window of 11 x 11, sigma 1.5.
/// Rows go in from the top; eleven are held.
class Similarity {
 public:
  Similarity(Eigen::Index width, Eigen::Index height);
  /// The luma of the next row of both, 0 to 255, and 1 for the pixels that count, 0 for others.
  void add_row(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, const Eigen::ArrayXd& count);
  /// Once all rows were added: the mean of the `pixels` that count.
  double finish(std::int64_t pixels);

 private:
  void judge();
  void add_similarity(Eigen::Index begin, Eigen::Index count);
  template <class Values, class Blurred>
  void blur_along(const Values& values, Blurred&& blurred) const;

  Eigen::Index width_, height_, added_ = 0, judged_ = 0;
  Eigen::ArrayXd inverse_weight_;
  Eigen::ArrayXXd waiting_, counts_, mean_;
  double sum_ = 0.0;
};

}  // namespace billow::render
