// Which springs must be held, and how fast each may lengthen.
#include "sim/step/strain_limit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"

namespace billow::sim {

namespace {

// Springs this near to their limit take part once any is beyond: others' pulls may push them over.
constexpr double nearness = 0.01;

// What may be left, of a spring's length a step.
constexpr double tolerance = 5e-4;

// Of what a spring is beyond its limit, and at most of its length, by how much it is brought back in a step. The first
// and the tolerance balance where springs are 0.25 % beyond.
constexpr double share_back = 0.2, most_back = 0.005;

// Below this many springs a second thread is not worth waking.
constexpr int least_springs_of_a_part = 16384;

double square(double x) { return x * x; }

// Springs beside may have to pull soon; looking for them costs as much as half an iteration.
bool is_time_to_grow(int iteration) { return iteration < 4 || iteration % 4 == 0; }

bool is_limited(SpringKind kind) { return kind == SpringKind::structural || kind == SpringKind::shear; }

}  // namespace

StrainLimit::StrainLimit(const Structure& structure, const std::vector<double>& limit)
    : structure_(structure), mover_(structure.particles(), -1) {
  list_springs(limit);
  list_rows();
  list_beside();
  near_square_.resize(static_cast<Eigen::Index>(spring_.size()));
  for (std::size_t s = 0; s < spring_.size(); ++s) near_square_(s) = square((1.0 - nearness) * spring_[s].longest);
  force_.assign(spring_.size(), 0.0);
  takes_part_.assign(spring_.size(), 0);
}

void StrainLimit::list_springs(const std::vector<double>& limit) {
  for (std::size_t b = 0; b < structure_.body.size(); ++b) {
    const Body& body = structure_.body[b];
    if (!std::isfinite(limit[b])) continue;
    const auto begin = static_cast<std::ptrdiff_t>(spring_.size());
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const int i = structure_.spring(s, 0), j = structure_.spring(s, 1);
      if (is_limited(structure_.kind[s]) && !(structure_.pinned(i) && structure_.pinned(j)))
        spring_.push_back({i, j, (1.0 + limit[b]) * structure_.rest_length(s)});
    }
    std::sort(spring_.begin() + begin, spring_.end(), [](const Spring& a, const Spring& b) {
      return std::pair(a.second - a.first, a.first) < std::pair(b.second - b.first, b.first);
    });
  }
}

// As long as they get; what is too short for a row goes to the springs without order before it.
void StrainLimit::list_rows() {
  constexpr int shortest = 8;
  const int count = static_cast<int>(spring_.size());
  const auto follows = [&](int s) {
    return spring_[s].first == spring_[s - 1].first + 1 && spring_[s].second == spring_[s - 1].second + 1;
  };
  for (int begin = 0, end; begin < count; begin = end) {
    for (end = begin + 1; end < count && follows(end);) ++end;
    if (end - begin >= shortest)
      row_.push_back({begin, end, spring_[begin].second - spring_[begin].first});
    else if (!row_.empty() && row_.back().stride == 0)
      row_.back().end = end;
    else
      row_.push_back({begin, end, 0});
  }
}

void StrainLimit::list_beside() {
  first_beside_.assign(mover_.size() + 1, 0);
  for (const Spring& s : spring_) ++first_beside_[s.first + 1], ++first_beside_[s.second + 1];
  std::partial_sum(first_beside_.begin(), first_beside_.end(), first_beside_.begin());
  beside_.resize(2 * spring_.size());
  std::vector<int> next = first_beside_;
  for (int s = 0; s < static_cast<int>(spring_.size()); ++s)
    beside_[next[spring_[s].first]++] = s, beside_[next[spring_[s].second]++] = s;
}

void StrainLimit::begin(State& /*state*/, double h) {
  h_ = h;
  work_ = 0.0;
  iterations_ = 0;
}

void StrainLimit::forget() {
  for (const int s : remembered_) force_[s] = 0.0;
  remembered_.clear();
}

void StrainLimit::apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) {
  if (move.by_old != 0.0) moved_ = state.position + move.by_old * state.velocity;
  const Motion motion{move.by_old != 0.0 ? moved_ : state.position, velocity};
  if (!find_near(motion)) return forget();
  solve(motion);
  take_over(velocity);
}

// Into near_; whether any will be too long. The one pass over all springs.
bool StrainLimit::find_near(const Motion& motion) {
  const Eigen::Index particles = motion.position.rows();
  predicted_.resize(particles, 3);
  for_each_range(static_cast<int>(particles), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    for (int axis = 0; axis < 3; ++axis)
      predicted_.col(axis).segment(begin, end - begin) = motion.position.col(axis).segment(begin, end - begin) +
                                                         h_ * motion.velocity.col(axis).segment(begin, end - begin);
  });
  near_.resize(static_cast<std::size_t>(most_parts()));
  for (auto& part : near_) part.clear();
  std::vector<char> any(near_.size(), 0);
  for_each_range(static_cast<int>(spring_.size()), 1, least_springs_of_a_part,
                 [&](int part, int begin, int end) { any[part] = find_near(begin, end, near_[part]); });
  return std::find(any.begin(), any.end(), 1) != any.end();
}

bool StrainLimit::find_near(int begin, int end, std::vector<int>& near) const {
  bool any = false;
  auto row = std::upper_bound(row_.begin(), row_.end(), begin, [](int s, const Row& r) { return s < r.end; });
  for (; row != row_.end() && row->begin < end; ++row) {
    const int from = std::max(begin, row->begin), to = std::min(end, row->end);
    any = (row->stride > 0 ? find_in_row(row->stride, from, to, near) : find_scattered(from, to, near)) || any;
  }
  return any;
}

// By blocks, most of which have no spring near its limit: their largest excess says so, which vectors find.
bool StrainLimit::find_in_row(int stride, int begin, int end, std::vector<int>& near) const {
  constexpr int block = 64;
  bool any = false;
  for (int s = begin; s < end; s += block) {
    const int count = std::min(block, end - s), i = spring_[s].first;
    const auto column = [&](int axis, int first) {
      return Eigen::Map<const Eigen::ArrayXd>(predicted_.col(axis).data() + first, count);
    };
    const double excess =
        ((column(0, i + stride) - column(0, i)).square() + (column(1, i + stride) - column(1, i)).square() +
         (column(2, i + stride) - column(2, i)).square() - near_square_.segment(s, count))
            .maxCoeff();
    if (excess <= 0.0) continue;
    for (int k = 0; k < count; ++k) any = note_if_near(s + k, near) || any;
  }
  return any;
}

bool StrainLimit::find_scattered(int begin, int end, std::vector<int>& near) const {
  bool any = false;
  for (int s = begin; s < end; ++s) any = note_if_near(s, near) || any;
  return any;
}

// Whether it is too long.
bool StrainLimit::note_if_near(int spring, std::vector<int>& near) const {
  const double *x = predicted_.col(0).data(), *y = predicted_.col(1).data(), *z = predicted_.col(2).data();
  const int i = spring_[spring].first, j = spring_[spring].second;
  const double length_square = square(x[j] - x[i]) + square(y[j] - y[i]) + square(z[j] - z[i]);
  if (length_square <= near_square_(spring)) return false;
  near.push_back(spring);
  return length_square > square(spring_[spring].longest);
}

// Where all springs were within their limits nothing may put energy in, as springs that turn could together.
void StrainLimit::solve(const Motion& motion) {
  pulls_.clear(), pulled_.clear(), pulled_particle_.clear();
  beyond_ = false;
  for (const auto& part : near_)
    for (const int s : part) add(s, motion);
  pulls_.start();
  double least = INFINITY;
  for (const int s : pulled_) least = std::min(least, spring_[s].longest);
  for (bool done = false; !done && iterations_ < most_iterations; ++iterations_) {
    done = pulls_.iterate(tolerance * least / h_);
    if (done || is_time_to_grow(iterations_)) done = !grow(motion) && done;
  }
  if (!beyond_) pulls_.take_no_energy();
  work_ = pulls_.pin_work() + work_of_shortening(motion);
}

// What pulls times how far springs shorten [J], where that is more than what lengthening springs take out.
double StrainLimit::work_of_shortening(const Motion& motion) const {
  double work = 0.0;
  for (int k = 0; k < pulls_.count(); ++k) {
    const Pull& p = pulls_.pull(k);
    if (p.impulse == 0.0) continue;
    const Spring& s = spring_[pulled_[k]];
    const Eigen::Vector3d apart = motion.position.row(s.second) - motion.position.row(s.first);
    const Eigen::Vector3d then = apart + h_ * (pulls_.velocity(p.second) - pulls_.velocity(p.first));
    work += p.impulse / h_ * (apart.norm() - then.norm());
  }
  return std::max(work, 0.0);
}

void StrainLimit::add(int spring, const Motion& motion) {
  const Spring& s = spring_[spring];
  const Eigen::Vector3d apart = motion.position.row(s.second) - motion.position.row(s.first);
  const double length = apart.norm();
  if (!(length > 0.0)) return;  // it has no direction to pull in
  Pull pull;
  pull.first = mover_of(s.first, motion);
  pull.second = mover_of(s.second, motion);
  pull.direction = apart / length;
  pull.allowed = allowed(s, motion, pull.direction, length);
  pull.impulse = force_[spring] * h_;
  pulls_.add(pull);
  pulled_.push_back(spring);
  takes_part_[spring] = 1;
}

int StrainLimit::mover_of(int particle, const Motion& motion) {
  if (mover_[particle] < 0) {
    mover_[particle] = pulls_.add_mover(motion.velocity.row(particle), structure_.inverse_mass(particle));
    pulled_particle_.push_back(particle);
  }
  return mover_[particle];
}

// A spring of length l that lengthens at v and whose ends pass one another at b is sqrt((l + h v)^2 + (h b)^2) long
// when it has moved. One that turns at its limit, and so must shorten to stay there, may be turned round, no more: v'
// >= -v, as if it bounced.
double StrainLimit::allowed(const Spring& spring, const Motion& motion, const Eigen::Vector3d& direction,
                            double length) {
  const Eigen::Vector3d relative = motion.velocity.row(spring.second) - motion.velocity.row(spring.first);
  const double v = direction.dot(relative), aside = h_ * (relative - v * direction).norm();
  const double room = spring.longest - length;
  const double turned = std::sqrt(std::max(spring.longest * spring.longest - aside * aside, 0.0)) - spring.longest;
  const double speed = std::max((turned + std::max(room, 0.0)) / h_, -std::max(v, 0.0));
  if (room >= 0.0) return speed;
  beyond_ = true;
  return speed - std::min(-share_back * room, most_back * spring.longest) / h_;
}

// The springs beside those that pull which are too long by now; whether there are any.
bool StrainLimit::grow(const Motion& motion) {
  const int before = pulls_.count(), movers = pulls_.movers();
  for (int k = 0; k < movers; ++k) {
    const int i = pulled_particle_[k];
    if (structure_.pinned(i) || !pulls_.is_pulled(k)) continue;
    for (int n = first_beside_[i]; n < first_beside_[i + 1]; ++n)
      if (!takes_part_[beside_[n]] && is_pushed(beside_[n], i, motion)) add(beside_[n], motion);
  }
  return pulls_.count() > before;
}

bool StrainLimit::is_pushed(int spring, int particle, const Motion& motion) const {
  const Spring& s = spring_[spring];
  const int other = s.first == particle ? s.second : s.first;
  const Eigen::Vector3d apart = motion.position.row(other) - motion.position.row(particle);
  const Eigen::Vector3d relative = velocity_of(other, motion) - velocity_of(particle, motion);
  return (apart + h_ * relative).squaredNorm() > s.longest * s.longest;
}

Eigen::Vector3d StrainLimit::velocity_of(int particle, const Motion& motion) const {
  if (mover_[particle] >= 0) return pulls_.velocity(mover_[particle]);
  return motion.velocity.row(particle);
}

// Velocities, and the forces that the next step begins with.
void StrainLimit::take_over(Eigen::MatrixX3d& velocity) {
  for (int k = 0; k < pulls_.movers(); ++k) {
    velocity.row(pulled_particle_[k]) = pulls_.velocity(k);
    mover_[pulled_particle_[k]] = -1;
  }
  forget();
  for (int k = 0; k < pulls_.count(); ++k) {
    const int spring = pulled_[k];
    takes_part_[spring] = 0;
    if (pulls_.pull(k).impulse == 0.0) continue;
    force_[spring] = pulls_.pull(k).impulse / h_;
    remembered_.push_back(spring);
  }
}

}  // namespace billow::sim
