// Passes, and rigid motions around them.
#include "sim/filter/filter.h"

#include <algorithm>
#include <stdexcept>

#include "sim/filter/level_filter.h"
#include "sim/filter/neighbour_filter.h"

namespace billow::sim {

Filter::Filter(const Structure& structure, FilterOptions options)
    : structure_(&structure), options_(std::move(options)) {
  if (options_.kernel == FilterKernel::levels) {
    auto levels = std::make_shared<LevelFilter>(structure, options_);
    options_.level_shares = levels->shares();
    operator_ = std::move(levels);
  } else {
    operator_ = std::make_shared<NeighbourFilter>(structure, options_);
  }
  restores_momenta_ =
      operator_->nonnegative() && std::any_of(structure.body.begin(), structure.body.end(),
                                              [&](const Body& body) { return is_free(structure, body); });
}

// Into a second field, which then changes places with the first.
void Filter::apply_once(Eigen::MatrixX3d& field, FilterScratch& scratch) const {
  scratch.filtered.resize(field.rows(), 3);
  operator_->run(columns_of(field, scratch.filtered), scratch);
  field.swap(scratch.filtered);
}

void Filter::apply(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                   FilterScratch& scratch) const {
  take_rigid_motion(position, field, scratch);
  operator_->prepare(position, time, scratch);
  for (int pass = 0; pass < options_.passes; ++pass) apply_once(field, scratch);
  put_rigid_motion(position, field, scratch);
}

// With P the projection onto rigid motions, which is orthogonal in the masses' inner product, a conserving
// filter of a free body is (I - P) F (I - P) + P: rigid motions pass as they are, and it stays self-adjoint.
void Filter::take_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field,
                               FilterScratch& scratch) const {
  scratch.before.clear();
  if (!restores_momenta_) return;
  for (const Body& body : structure_->body) {
    scratch.before.push_back(body_motion(*structure_, body, position, field));
    if (is_free(*structure_, body)) set_momenta(*structure_, body, position, BodyMotion{}, field);
  }
}

void Filter::put_rigid_motion(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& field,
                              const FilterScratch& scratch) const {
  for (std::size_t b = 0; b < scratch.before.size(); ++b)
    if (is_free(*structure_, structure_->body[b]))
      set_momenta(*structure_, structure_->body[b], position, scratch.before[b], field);
}

// The last pass writes where `columns` say.
void Filter::apply_last(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, FilterColumns columns,
                        FilterScratch& scratch) const {
  operator_->prepare(position, time, scratch);
  for (int pass = 1; pass < options_.passes; ++pass) apply_once(field, scratch);
  for (int axis = 0; axis < 3; ++axis) columns.in[axis] = field.col(axis).data();
  operator_->run(columns, scratch);
}

void Filter::apply_and_move(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field, double h,
                            Eigen::MatrixX3d& velocity, Eigen::MatrixX3d& moved, FilterScratch& scratch) const {
  if (restores_momenta_) {
    apply(position, time, field, scratch);
    velocity = field;
    moved += h * velocity;
    return;
  }
  FilterColumns columns = columns_of(field, velocity);
  columns.move_step = h;
  for (int axis = 0; axis < 3; ++axis) columns.moved[axis] = moved.col(axis).data();
  apply_last(position, time, field, columns, scratch);
}

void Filter::apply_and_kick(const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field,
                            const Eigen::MatrixX3d& velocity, double h, Eigen::MatrixX3d& kicked,
                            FilterScratch& scratch) const {
  if (restores_momenta_) {
    apply(position, time, field, scratch);
    kicked = velocity + h * field;
    return;
  }
  kicked.resize(field.rows(), 3);
  FilterColumns columns = columns_of(field, kicked);
  columns.kick_step = h;
  for (int axis = 0; axis < 3; ++axis) columns.base[axis] = velocity.col(axis).data();
  apply_last(position, time, field, columns, scratch);
}

Filter Filter::frozen(double time) const {
  Filter result = *this;
  result.options_ = frozen_options(options_, time);
  result.operator_ = operator_->frozen(time);
  return result;
}

Filter Filter::adjoint() const {
  if (!constant_weights()) throw std::logic_error("only a filter with constant weights has one adjoint");
  Filter result = *this;
  result.operator_ = operator_->adjoint();
  return result;
}

}  // namespace billow::sim
