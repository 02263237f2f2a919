// Building, refitting and pairing trees of boxes.
#include "sim/contact/box_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include "base/parallel.h"

namespace billow::sim {

namespace {

constexpr int leaf_faces = 4;
constexpr std::size_t enough_tasks = 96;

}  // namespace

BoxTree::BoxTree(const ContactSurface& surface, const SurfacePart& part)
    : surface_(surface), first_face_(part.first_face), order_(part.faces) {
  std::iota(order_.begin(), order_.end(), part.first_face);
  std::vector<Eigen::Vector3d> middle;
  for (const int f : order_) {
    const auto& face = surface.face[f];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int v : face) sum += surface.rest[v];
    middle.push_back(sum / 3.0);
  }
  place_.resize(order_.size()), leaf_.resize(order_.size()), face_box_.resize(order_.size());
  if (part.faces > 0) build(middle, 0, part.faces, -1);
}

void BoxTree::build(std::vector<Eigen::Vector3d>& middle, int first, int count, int parent) {
  const auto number = static_cast<int>(node_.size());
  node_.push_back({.parent = parent, .first = first, .count = count});
  if (count <= leaf_faces) {
    for (int k = first; k < first + count; ++k)
      place_[order_[k] - first_face_] = k, leaf_[order_[k] - first_face_] = number;
    return;
  }
  const auto at = [&](int f) -> const Eigen::Vector3d& { return middle[f - first_face_]; };
  Eigen::AlignedBox3d box;
  for (int k = first; k < first + count; ++k) box.extend(at(order_[k]));
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int left = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + left, begin + count, [&](int f, int g) {
    const double x = at(f)(axis), y = at(g)(axis);
    return x != y ? x < y : f < g;
  });
  build(middle, first, left, number);
  node_[number].right = static_cast<int>(node_.size());
  build(middle, first + left, count - left, number);
}

MovingBox BoxTree::box_of(int face, const Points& now, const Points& then, const std::vector<double>& reach) const {
  MovingBox box;
  const auto& [u, v, w] = surface_.face[face];
  const double most = std::max({reach[u], reach[v], reach[w]});
  constexpr double rounding = 1.5e-7;  // more than single precision's
  for (int k = 0; k < 6; ++k) {
    const Points& x = k < 3 ? now : then;
    const int axis = k % 3;
    const double low = std::min({x[u](axis), x[v](axis), x[w](axis)}) - most;
    const double high = std::max({x[u](axis), x[v](axis), x[w](axis)}) + most;
    box.low[k] = static_cast<float>(low - rounding * std::abs(low));
    box.high[k] = static_cast<float>(high + rounding * std::abs(high));
  }
  return box;
}

// Around its triangles or its children.
void BoxTree::fit(Node& node) {
  node.box = MovingBox::none();
  if (node.right != 0) {
    node.box.add((&node + 1)->box);
    node.box.add(node_[node.right].box);
  } else {
    for (int k = node.first; k < node.first + node.count; ++k) node.box.add(face_box_[k]);
  }
}

void BoxTree::refit(const Points& now, const Points& then, const std::vector<double>& reach) {
  for_each_range(static_cast<int>(order_.size()), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    for (int k = begin; k < end; ++k) face_box_[k] = box_of(order_[k], now, then, reach);
  });
  for (auto node = node_.rbegin(); node != node_.rend(); ++node) fit(*node);
}

// Children have greater numbers than their parents.
void BoxTree::refit_some(const std::vector<int>& faces, const Points& now, const Points& then,
                         const std::vector<double>& reach) {
  std::set<int, std::greater<>> changed;
  for (const int f : faces) {
    face_box_[place_[f - first_face_]] = box_of(f, now, then, reach);
    changed.insert(leaf_[f - first_face_]);
  }
  while (!changed.empty()) {
    Node& node = node_[*changed.begin()];
    changed.erase(changed.begin());
    fit(node);
    if (node.parent >= 0) changed.insert(node.parent);
  }
}

void BoxTree::add_meeting(const BoxTree& tree, int face, std::vector<int>& out) const {
  if (node_.empty()) return;
  const MovingBox& box = tree.face_box_[tree.place_[face - tree.first_face_]];
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const int number = stack.back();
    stack.pop_back();
    const Node& node = node_[number];
    if (!node.box.meets(box)) continue;
    if (!is_leaf(number)) {
      stack.push_back(node.right);
      stack.push_back(number + 1);
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k)
      if (face_box_[k].meets(box)) out.push_back(order_[k]);
  }
}

// The larger node is opened first; a node with itself falls into its halves and the pair of both.
bool BoxTree::descends_a(const Task& task) {
  if (task.a->is_leaf(task.node_a)) return false;
  if (task.b->is_leaf(task.node_b)) return true;
  return task.a->node_[task.node_a].count >= task.b->node_[task.node_b].count;
}

template <class Visit>
void BoxTree::visit_children(const Task& task, const Visit& visit) {
  const auto consider = [&](int node_a, int node_b) {
    const bool same = task.a == task.b && node_a == node_b;
    if (same || task.a->node_[node_a].box.meets(task.b->node_[node_b].box)) visit(Task{task.a, task.b, node_a, node_b});
  };
  const auto right_of = [](const BoxTree& tree, int node) { return tree.node_[node].right; };
  if (task.a == task.b && task.node_a == task.node_b) {
    const int left = task.node_a + 1, right = right_of(*task.a, task.node_a);
    consider(left, left);
    consider(left, right);
    consider(right, right);
  } else if (descends_a(task)) {
    consider(task.node_a + 1, task.node_b);
    consider(right_of(*task.a, task.node_a), task.node_b);
  } else {
    consider(task.node_a, task.node_b + 1);
    consider(task.node_a, right_of(*task.b, task.node_b));
  }
}

void BoxTree::split(const BoxTree& a, const BoxTree& b, std::vector<Task>& tasks) {
  if (a.order_.empty() || b.order_.empty()) return;
  if (&a != &b && !a.node_[0].box.meets(b.node_[0].box)) return;
  std::vector<Task> level{{&a, &b, 0, 0}}, next;
  bool opened = true;
  while (opened && level.size() < enough_tasks) {
    opened = false;
    next.clear();
    for (const Task& task : level) {
      if (a.is_leaf(task.node_a) && b.is_leaf(task.node_b)) {
        next.push_back(task);
        continue;
      }
      opened = true;
      visit_children(task, [&](const Task& child) { next.push_back(child); });
    }
    level.swap(next);
  }
  tasks.insert(tasks.end(), level.begin(), level.end());
}

void BoxTree::pairs(const Task& start, std::vector<FacePair>& out) {
  std::vector<Task> stack{start};
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    if (!task.a->is_leaf(task.node_a) || !task.b->is_leaf(task.node_b)) {
      visit_children(task, [&](const Task& child) { stack.push_back(child); });
      continue;
    }
    const Node &a = task.a->node_[task.node_a], &b = task.b->node_[task.node_b];
    const bool same = task.a == task.b && task.node_a == task.node_b;
    for (int k = a.first; k < a.first + a.count; ++k)
      for (int l = same ? k + 1 : b.first; l < b.first + b.count; ++l)
        if (task.a->face_box_[k].meets(task.b->face_box_[l])) out.emplace_back(task.a->order_[k], task.b->order_[l]);
  }
}

}  // namespace billow::sim
