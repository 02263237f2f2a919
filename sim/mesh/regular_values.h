// Values of a regular mesh, made equal where they were meant to be.
#pragma once

#include <Eigen/Core>

namespace billow::sim {

/// A regular mesh has a few different lengths and areas, but a file's decimals and a reader's single precision leave
/// each of them in many copies that differ in their last digits. Where positive `values` are at most 64 different ones,
/// each in copies within 1e-4 of one another and clear of the next by as much, every copy becomes the middle of its
/// own. All others are left as they are.
void make_regular(Eigen::Ref<Eigen::VectorXd> values);

}  // namespace billow::sim
