// Reverse Cuthill-McKee.
#include "sim/pass/locality.h"

#include <algorithm>
#include <cstdlib>

namespace billow::sim {

namespace {

using Graph = std::vector<std::vector<int>>;

Graph graph_of(const std::vector<std::pair<int, int>>& pairs, int particles) {
  Graph graph(static_cast<std::size_t>(particles));
  for (const auto& [i, j] : pairs) {
    graph[static_cast<std::size_t>(i)].push_back(j);
    graph[static_cast<std::size_t>(j)].push_back(i);
  }
  return graph;
}

std::size_t degree(const Graph& graph, int particle) { return graph[static_cast<std::size_t>(particle)].size(); }

// Appends the component of `start` in breadth-first order, neighbours of low degree first; marks it with `mark`.
void append_breadth_first(Graph& graph, int start, char mark, std::vector<char>& seen, std::vector<int>& order) {
  std::size_t next = order.size();
  order.push_back(start);
  seen[static_cast<std::size_t>(start)] = mark;
  for (; next < order.size(); ++next) {
    std::vector<int>& neighbours = graph[static_cast<std::size_t>(order[next])];
    std::sort(neighbours.begin(), neighbours.end(),
              [&](int a, int b) { return std::pair(degree(graph, a), a) < std::pair(degree(graph, b), b); });
    for (const int j : neighbours)
      if (seen[static_cast<std::size_t>(j)] != mark) {
        seen[static_cast<std::size_t>(j)] = mark;
        order.push_back(j);
      }
  }
}

std::vector<int> reverse_cuthill_mckee(Graph graph) {
  std::vector<int> order;
  std::vector<char> seen(graph.size(), 0);
  for (int i = 0; i < static_cast<int>(graph.size()); ++i) {
    if (seen[static_cast<std::size_t>(i)] == 2) continue;
    // The last that a first search reaches is at an end of the component: the second starts there.
    std::vector<int> reached;
    append_breadth_first(graph, i, 1, seen, reached);
    append_breadth_first(graph, reached.back(), 2, seen, order);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

int reach(const std::vector<std::pair<int, int>>& pairs, const std::vector<int>& rank) {
  int most = 0;
  for (const auto& [i, j] : pairs) {
    const std::size_t a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    most = std::max(most, rank.empty() ? std::abs(j - i) : std::abs(rank[b] - rank[a]));
  }
  return most;
}

}  // namespace

std::vector<int> ranks(const std::vector<int>& order) {
  std::vector<int> rank(order.size());
  for (std::size_t r = 0; r < order.size(); ++r) rank[static_cast<std::size_t>(order[r])] = static_cast<int>(r);
  return rank;
}

std::vector<int> local_order(const std::vector<std::pair<int, int>>& pairs, int particles) {
  std::vector<int> order = reverse_cuthill_mckee(graph_of(pairs, particles));
  return 2 * reach(pairs, ranks(order)) <= reach(pairs, {}) ? order : std::vector<int>{};
}

}  // namespace billow::sim
