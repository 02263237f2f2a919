// Gauss-Seidel over pulls, made faster by what the last iteration did.
#include "sim/step/pulls.h"

#include <algorithm>
#include <cmath>

namespace billow::sim {

void Pulls::clear() { mover_.clear(), pull_.clear(), unpulled_.clear(), last_change_.clear(); }

int Pulls::add_mover(const Eigen::Vector3d& velocity, double inverse_mass) {
  mover_.push_back({velocity, inverse_mass});
  unpulled_.push_back(velocity);
  last_change_.push_back(Eigen::Vector3d::Zero());
  return movers() - 1;
}

void Pulls::add(Pull pull) {
  const Mover &first = mover_[pull.first], &second = mover_[pull.second];
  const double v_first = pull.direction.dot(unpulled_[pull.first]);
  const double v_second = pull.direction.dot(unpulled_[pull.second]);
  pull.before = v_second - v_first;
  pull.of_pins = (second.inverse_mass == 0.0 ? v_second : 0.0) - (first.inverse_mass == 0.0 ? v_first : 0.0);
  pull.reduced_mass = 1.0 / (first.inverse_mass + second.inverse_mass);
  pull_.push_back(pull);
}

void Pulls::exert(const Pull& pull, double impulse) {
  Mover &first = mover_[pull.first], &second = mover_[pull.second];
  first.velocity += (first.inverse_mass * impulse) * pull.direction;
  second.velocity -= (second.inverse_mass * impulse) * pull.direction;
}

void Pulls::start() {
  double gain = 0.0;
  for (const Pull& p : pull_) {
    if (p.impulse == 0.0) continue;
    exert(p, p.impulse);
    gain += p.impulse * (p.before - p.allowed);
  }
  const double square = change_square();
  if (square > 0.0) scale(std::max(gain / square, 0.0));
}

bool Pulls::iterate(double enough) {
  start_impulse_.resize(pull_.size());
  for (std::size_t k = 0; k < pull_.size(); ++k) start_impulse_[k] = pull_[k].impulse;
  start_.resize(mover_.size());
  for (std::size_t k = 0; k < mover_.size(); ++k) start_[k] = mover_[k].velocity;
  double most = 0.0;
  for (Pull& p : pull_) most = std::max(most, visit(p));
  for (auto p = pull_.rbegin(); p != pull_.rend(); ++p) most = std::max(most, visit(*p));
  if (most <= enough) return true;  // what is left may be rounding, which shows no way to go on
  accelerate();
  return false;
}

double Pulls::visit(Pull& p) {
  const double excess = p.direction.dot(mover_[p.second].velocity - mover_[p.first].velocity) - p.allowed;
  const double change = std::max(excess * p.reduced_mass, -p.impulse);
  if (change == 0.0) return 0.0;
  p.impulse += change;
  exert(p, change);
  return std::abs(change) / p.reduced_mass;
}

// d is the step from the iteration's start to here, p the step of the last one; D and P are the changes of velocity
// that they made. Along lambda + x d + y p,
//   phi = const - x d.r - y p.r + (x^2 D.MD + 2 x y D.MP + y^2 P.MP) / 2,   r = v_n' - c,   d.r = -D.Mv' + d.(v_pins -
//   c),
// v_pins being what movers of infinite mass add to going apart: nothing has to be gathered from movers for it.
void Pulls::accelerate() {
  double dd = 0.0, dp = 0.0, pp = 0.0, dr = 0.0, pr = 0.0;
  for (std::size_t k = 0; k < mover_.size(); ++k) {
    const Mover& m = mover_[k];
    if (m.inverse_mass == 0.0) continue;
    const double mass = 1.0 / m.inverse_mass;
    const Eigen::Vector3d d = m.velocity - start_[k], &p = last_change_[k];
    dd += mass * d.squaredNorm(), dp += mass * d.dot(p), pp += mass * p.squaredNorm();
    dr -= mass * d.dot(m.velocity), pr -= mass * p.dot(m.velocity);
  }
  for (std::size_t k = 0; k < pull_.size(); ++k) {
    const Pull& p = pull_[k];
    dr += (p.impulse - start_impulse_[k]) * (p.of_pins - p.allowed), pr += p.step * (p.of_pins - p.allowed);
  }
  const double determinant = dd * pp - dp * dp;
  constexpr double independent = 1e-9;
  if (determinant > independent * dd * pp)
    go_on((dr * pp - pr * dp) / determinant, (pr * dd - dr * dp) / determinant);
  else
    go_on(dd > 0.0 ? dr / dd : 0.0, 0.0);
}

// As far as no impulse becomes negative: phi falls all the way.
void Pulls::go_on(double along_step, double along_last) {
  double share = 1.0;
  for (std::size_t k = 0; k < pull_.size(); ++k) {
    const Pull& p = pull_[k];
    const double change = along_step * (p.impulse - start_impulse_[k]) + along_last * p.step;
    if (p.impulse + share * change < 0.0) share = -p.impulse / change;
  }
  for (std::size_t k = 0; k < pull_.size(); ++k) {
    Pull& p = pull_[k];
    const double step = p.impulse - start_impulse_[k];
    p.impulse = std::max(p.impulse + share * (along_step * step + along_last * p.step), 0.0);
    p.step = p.impulse - start_impulse_[k];
  }
  for (std::size_t k = 0; k < mover_.size(); ++k) {
    Mover& m = mover_[k];
    m.velocity += share * (along_step * (m.velocity - start_[k]) + along_last * last_change_[k]);
    last_change_[k] = m.velocity - start_[k];
  }
}

// lambda^T A lambda [kg m^2/s^2]
double Pulls::change_square() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < mover_.size(); ++k)
    if (mover_[k].inverse_mass > 0.0) sum += (mover_[k].velocity - unpulled_[k]).squaredNorm() / mover_[k].inverse_mass;
  return sum;
}

// lambda^T v_n
double Pulls::lost() const {
  double sum = 0.0;
  for (const Pull& p : pull_) sum += p.impulse * p.before;
  return sum;
}

double Pulls::energy_rise() const { return 0.5 * change_square() - lost(); }

void Pulls::take_no_energy() {
  const double square = change_square(), by_impulses = lost();
  if (0.5 * square > by_impulses) scale(2.0 * std::max(by_impulses, 0.0) / square);
}

void Pulls::scale(double factor) {
  for (std::size_t k = 0; k < mover_.size(); ++k)
    mover_[k].velocity = unpulled_[k] + factor * (mover_[k].velocity - unpulled_[k]);
  for (Pull& p : pull_) p.impulse *= factor;
}

// What holds a mover exerts on it what the pull does not.
double Pulls::pin_work() const {
  double sum = 0.0;
  for (const Pull& p : pull_) sum += p.impulse * p.of_pins;
  return sum;
}

}  // namespace billow::sim
