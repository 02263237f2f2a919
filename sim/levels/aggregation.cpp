// Greedy neighbourhoods, in the order of the nodes.
#include "sim/levels/aggregation.h"

#include <algorithm>
#include <map>

namespace billow::sim {

namespace {

constexpr int nobody = -1;

void sort_and_unite(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

bool all_ungathered(const std::vector<int>& nodes, const std::vector<int>& gathered) {
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](int j) { return gathered[static_cast<std::size_t>(j)] == nobody; });
}

// The neighbourhood that most neighbours of a node are in; the one with the smaller number of two. nobody where none is
// in any.
int commonest(const std::vector<int>& neighbours, const std::vector<int>& gathered) {
  std::map<int, int> count;
  for (const int j : neighbours)
    if (const int where = gathered[static_cast<std::size_t>(j)]; where != nobody) ++count[where];
  int best = nobody, most = 0;
  for (const auto& [where, times] : count)
    if (times > most) best = where, most = times;
  return best;
}

// The number of each node's neighbourhood; nobody for those that are not there.
std::vector<int> gather(const Adjacency& graph, const std::vector<bool>& present, int& neighbourhoods) {
  std::vector<int> gathered(graph.size(), nobody);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (!present[i] || gathered[i] != nobody || !all_ungathered(graph[i], gathered)) continue;
    gathered[i] = neighbourhoods;
    for (const int j : graph[i]) gathered[static_cast<std::size_t>(j)] = neighbourhoods;
    ++neighbourhoods;
  }
  const std::vector<int> first_pass = gathered;
  for (std::size_t i = 0; i < graph.size(); ++i)
    if (present[i] && gathered[i] == nobody) gathered[i] = commonest(graph[i], first_pass);
  return gathered;
}

SparseRows neighbours_mean(const Adjacency& graph, const std::vector<bool>& present, const std::vector<int>& gathered) {
  SparseRows rows;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    std::map<int, int> count;
    if (present[i]) {
      ++count[gathered[i]];
      for (const int j : graph[i]) ++count[gathered[static_cast<std::size_t>(j)]];
    }
    for (const auto& [node, times] : count) {
      rows.column.push_back(node);
      rows.weight.push_back(static_cast<double>(times) / static_cast<double>(graph[i].size() + 1));
    }
    rows.first.push_back(static_cast<int>(rows.column.size()));
  }
  return rows;
}

Adjacency joined(const Adjacency& graph, const std::vector<int>& gathered, int neighbourhoods) {
  Adjacency result(static_cast<std::size_t>(neighbourhoods));
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const int j : graph[i])
      if (gathered[i] != gathered[static_cast<std::size_t>(j)])
        result[static_cast<std::size_t>(gathered[i])].push_back(gathered[static_cast<std::size_t>(j)]);
  for (std::vector<int>& list : result) sort_and_unite(list);
  return result;
}

}  // namespace

Adjacency spring_graph(const Structure& structure, const Body& body) {
  Adjacency graph(static_cast<std::size_t>(body.particles));
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    const SpringKind kind = structure.kind[static_cast<std::size_t>(s)];
    const int i = structure.spring(s, 0), j = structure.spring(s, 1);
    if (kind == SpringKind::bend || kind == SpringKind::shear || structure.pinned(i) || structure.pinned(j)) continue;
    graph[static_cast<std::size_t>(i - body.first_particle)].push_back(j - body.first_particle);
    graph[static_cast<std::size_t>(j - body.first_particle)].push_back(i - body.first_particle);
  }
  for (std::vector<int>& list : graph) sort_and_unite(list);
  return graph;
}

SparseRows aggregation(Adjacency& graph, const std::vector<bool>& present) {
  int neighbourhoods = 0;
  const std::vector<int> gathered = gather(graph, present, neighbourhoods);
  SparseRows rows = neighbours_mean(graph, present, gathered);
  graph = joined(graph, gathered, neighbourhoods);
  return rows;
}

}  // namespace billow::sim
