// Building, refitting and pairing trees of boxes.
#include "sim/contact/box_tree.h"

#include <algorithm>
#include <numeric>

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
  if (part.faces > 0) build(middle, 0, part.faces);
  face_box_.resize(order_.size());
}

void BoxTree::build(std::vector<Eigen::Vector3d>& middle, int first, int count) {
  const auto number = node_.size();
  node_.push_back({.first = first, .count = count});
  if (count <= leaf_faces) return;
  const auto at = [&](int f) -> const Eigen::Vector3d& { return middle[f - first_face_]; };
  Box box;
  for (int k = first; k < first + count; ++k) box.add(at(order_[k]));
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const int left = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + left, begin + count, [&](int f, int g) {
    const double x = at(f)(axis), y = at(g)(axis);
    return x != y ? x < y : f < g;
  });
  build(middle, first, left);
  node_[number].right = static_cast<int>(node_.size());
  build(middle, first + left, count - left);
}

void BoxTree::refit(const Points& x, const std::vector<double>& reach) {
  for_each_range(static_cast<int>(order_.size()), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    for (int k = begin; k < end; ++k) {
      Box box;
      double most = 0.0;
      for (const int v : surface_.face[order_[k]]) {
        box.add(x[v]);
        most = std::max(most, reach[v]);
      }
      box.low -= most, box.high += most;
      face_box_[k] = box;
    }
  });
  for (std::size_t n = node_.size(); n-- > 0;) {
    Node& node = node_[n];
    node.box = {};
    if (node.right != 0) {
      node.box.add(node_[n + 1].box);
      node.box.add(node_[node.right].box);
    } else {
      for (int k = node.first; k < node.first + node.count; ++k) node.box.add(face_box_[k]);
    }
  }
}

// The larger node is opened first; a node with itself falls into its halves and the pair of both.
bool BoxTree::descends_a(const Task& task) {
  if (task.a->is_leaf(task.node_a)) return false;
  if (task.b->is_leaf(task.node_b)) return true;
  return task.a->node_[task.node_a].count >= task.b->node_[task.node_b].count;
}

template <class Visit>
void BoxTree::visit_children(const Task& task, double gap, const Visit& visit) {
  const auto consider = [&](int node_a, int node_b) {
    const bool same = task.a == task.b && node_a == node_b;
    if (same || task.a->node_[node_a].box.near(task.b->node_[node_b].box, gap))
      visit(Task{task.a, task.b, node_a, node_b});
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

void BoxTree::split(const BoxTree& a, const BoxTree& b, double gap, std::vector<Task>& tasks) {
  if (a.order_.empty() || b.order_.empty()) return;
  if (&a != &b && !a.box().near(b.box(), gap)) return;
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
      visit_children(task, gap, [&](const Task& child) { next.push_back(child); });
    }
    level.swap(next);
  }
  tasks.insert(tasks.end(), level.begin(), level.end());
}

void BoxTree::pairs(const Task& start, double gap, std::vector<FacePair>& out) {
  std::vector<Task> stack{start};
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    if (!task.a->is_leaf(task.node_a) || !task.b->is_leaf(task.node_b)) {
      visit_children(task, gap, [&](const Task& child) { stack.push_back(child); });
      continue;
    }
    const Node &a = task.a->node_[task.node_a], &b = task.b->node_[task.node_b];
    const bool same = task.a == task.b && task.node_a == task.node_b;
    for (int k = a.first; k < a.first + a.count; ++k)
      for (int l = same ? k + 1 : b.first; l < b.first + b.count; ++l)
        if (task.a->face_box_[k].near(task.b->face_box_[l], gap))
          out.emplace_back(task.a->order_[k], task.b->order_[l]);
  }
}

}  // namespace billow::sim
