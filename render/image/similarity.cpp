// SSIM = (2 mu_a mu_b + C1)(2 s_ab + C2) / ((mu_a^2 + mu_b^2 + C1)(s_a^2 + s_b^2 + C2)), averaged over the pixels that
// count. The window is a product, so each row is blurred along itself once and waits until the rows around it have
// come.
#include "render/image/similarity.h"

#include <algorithm>
#include <cmath>

namespace billow::render {
namespace {

constexpr int window_radius = 5;      // an 11 x 11 window
constexpr double window_sigma = 1.5;  // [pixel]

constexpr Eigen::Index moments = 4;  // of a pair of pixels: a, b, a^2 + b^2, a b
constexpr Eigen::Index window_rows = 2 * window_radius + 1;
constexpr Eigen::Index block = 512;  // [pixel] what the processor's first cache holds of all rows

double window_weight(int offset) { return std::exp(-0.5 * offset * offset / (window_sigma * window_sigma)); }

// The weights of those pixels of a window around `centre` that lie within `size` pixels, summed.
double weight_inside(Eigen::Index centre, Eigen::Index size) {
  double sum = 0.0;
  for (int offset = -window_radius; offset <= window_radius; ++offset)
    if (centre + offset >= 0 && centre + offset < size) sum += window_weight(offset);
  return sum;
}

Eigen::Index column(Eigen::Index moment, Eigen::Index row) { return moment * window_rows + row % window_rows; }

}  // namespace

Similarity::Similarity(Eigen::Index width, Eigen::Index height)
    : width_(width),
      height_(height),
      inverse_weight_(width),
      waiting_(width, moments * window_rows),
      counts_(width, window_rows),
      mean_(width, moments) {
  for (Eigen::Index x = 0; x < width; ++x) inverse_weight_(x) = 1.0 / weight_inside(x, width);
}

void Similarity::add_row(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, const Eigen::ArrayXd& count) {
  blur_along(a, waiting_.col(column(0, added_)));
  blur_along(b, waiting_.col(column(1, added_)));
  blur_along(a.square() + b.square(), waiting_.col(column(2, added_)));
  blur_along(a * b, waiting_.col(column(3, added_)));
  counts_.col(added_ % window_rows) = count;
  if (++added_ > window_radius) judge();
}

double Similarity::finish(std::int64_t pixels) {
  while (judged_ < height_) judge();
  return sum_ / static_cast<double>(pixels);
}

template <class Values, class Blurred>
void Similarity::blur_along(const Values& values, Blurred&& blurred) const {
  const Eigen::ArrayXd line = values;
  blurred.setZero();
  for (Eigen::Index begin = 0; begin < width_; begin += block)
    for (int offset = -window_radius; offset <= window_radius; ++offset) {
      const Eigen::Index from = std::max<Eigen::Index>(begin, -offset);
      const Eigen::Index to = std::min(std::min(begin + block, width_), width_ - offset);
      if (to > from) blurred.segment(from, to - from) += window_weight(offset) * line.segment(from + offset, to - from);
    }
  blurred *= inverse_weight_;
}

// The next row around which all rows are there that the image has.
void Similarity::judge() {
  const double scale = 1.0 / weight_inside(judged_, height_);
  for (Eigen::Index begin = 0; begin < width_; begin += block) {
    const Eigen::Index count = std::min(block, width_ - begin);
    for (Eigen::Index moment = 0; moment < moments; ++moment) {
      auto blurred = mean_.col(moment).segment(begin, count);
      blurred.setZero();
      for (int offset = -window_radius; offset <= window_radius; ++offset)
        if (const Eigen::Index row = judged_ + offset; row >= 0 && row < height_)
          blurred += scale * window_weight(offset) * waiting_.col(column(moment, row)).segment(begin, count);
    }
    add_similarity(begin, count);
  }
  ++judged_;
}

void Similarity::add_similarity(Eigen::Index begin, Eigen::Index count) {
  constexpr double c1 = (0.01 * 255.0) * (0.01 * 255.0), c2 = (0.03 * 255.0) * (0.03 * 255.0);
  const auto of = [&](Eigen::Index moment) { return mean_.col(moment).segment(begin, count); };
  const Eigen::ArrayXd product = of(0) * of(1), squares = of(0).square() + of(1).square();
  const Eigen::ArrayXd similarity =
      (2.0 * product + c1) * (2.0 * (of(3) - product) + c2) / ((squares + c1) * (of(2) - squares + c2));
  sum_ += (similarity * counts_.col(judged_ % window_rows).segment(begin, count)).sum();
}

}  // namespace billow::render
