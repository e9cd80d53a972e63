#include "least_assignment.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>
#include <cmath>
#include <cstdint>

namespace hamjet {
namespace {

/// Whole numbers, so that sums are exact. The algorithm adds the distances of vertices that it
/// cannot reach, which are the largest number there is: integers would overflow.
using Weight = double;
using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using EdgeProperties = boost::property<
    boost::edge_capacity_t, std::int64_t,
    boost::property<boost::edge_residual_capacity_t, std::int64_t,
                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor,
                                    boost::property<boost::edge_weight_t, Weight>>>>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property,
                                    EdgeProperties>;

/// An edge of capacity one and its reverse of capacity zero and opposite weight.
void add_edges(Graph& graph, std::size_t from, std::size_t to, Weight weight) {
  const auto forward = boost::add_edge(from, to, graph).first;
  const auto backward = boost::add_edge(to, from, graph).first;
  boost::put(boost::edge_capacity, graph, forward, 1);
  boost::put(boost::edge_capacity, graph, backward, 0);
  boost::put(boost::edge_weight, graph, forward, weight);
  boost::put(boost::edge_weight, graph, backward, -weight);
  boost::put(boost::edge_reverse, graph, forward, backward);
  boost::put(boost::edge_reverse, graph, backward, forward);
}

}  // namespace

std::optional<std::vector<std::size_t>> least_assignment(
    const std::vector<std::vector<double>>& costs) {
  constexpr double resolution = 1e9;
  const std::size_t n = costs.size();
  double largest = 0;
  for (const auto& row : costs) {
    for (const double cost : row) {
      if (std::isfinite(cost)) largest = std::max(largest, cost);
    }
  }
  const double scale = largest > 0 ? resolution / largest : 1;
  // Vertices: rows, columns, source, sink.
  const std::size_t source = 2 * n;
  const std::size_t sink = 2 * n + 1;
  Graph graph(2 * n + 2);
  for (std::size_t i = 0; i < n; ++i) {
    add_edges(graph, source, i, 0);
    add_edges(graph, n + i, sink, 0);
    for (std::size_t j = 0; j < n; ++j) {
      if (!std::isfinite(costs[i][j])) continue;
      add_edges(graph, i, n + j, std::round(costs[i][j] * scale));
    }
  }
  boost::successive_shortest_path_nonnegative_weights(graph, source, sink);
  std::vector<std::size_t> columns(n, n);
  const auto capacity = boost::get(boost::edge_capacity, graph);
  const auto residual = boost::get(boost::edge_residual_capacity, graph);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [first, last] = boost::out_edges(i, graph);
    for (auto edge = first; edge != last; ++edge) {
      if (boost::get(capacity, *edge) == 1 && boost::get(residual, *edge) == 0) {
        columns[i] = boost::target(*edge, graph) - n;
      }
    }
    if (columns[i] >= n) return std::nullopt;
  }
  return columns;
}

}  // namespace hamjet
