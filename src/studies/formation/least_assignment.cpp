#include "least_assignment.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>
#include <cmath>
#include <cstdint>

namespace hamjet {
namespace {

/// Weights are whole numbers, so that sums are exact. They are stored as doubles because the
/// algorithm adds the distances of vertices that it cannot reach, which are the largest number of
/// the type: integers would overflow.
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

std::optional<Assignment> least_assignment(const std::vector<std::vector<double>>& costs) {
  constexpr double resolution = 1e9;
  const std::size_t rows = costs.size();
  const std::size_t columns = rows == 0 ? 0 : costs[0].size();
  double largest = 0;
  for (const auto& row : costs) {
    for (const double cost : row) {
      if (std::isfinite(cost)) largest = std::max(largest, cost);
    }
  }
  const double scale = largest > 0 ? resolution / largest : 1;
  // The vertices are rows, columns, source and sink.
  const std::size_t source = rows + columns;
  const std::size_t sink = source + 1;
  Graph graph(sink + 1);
  for (std::size_t j = 0; j < columns; ++j) add_edges(graph, rows + j, sink, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    add_edges(graph, source, i, 0);
    for (std::size_t j = 0; j < columns; ++j) {
      if (!std::isfinite(costs[i][j])) continue;
      add_edges(graph, i, rows + j, std::round(costs[i][j] * scale));
    }
  }
  boost::successive_shortest_path_nonnegative_weights(graph, source, sink);
  Assignment assignment(rows);
  std::size_t pairs = 0;
  const auto capacity = boost::get(boost::edge_capacity, graph);
  const auto residual = boost::get(boost::edge_residual_capacity, graph);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto [first, last] = boost::out_edges(i, graph);
    for (auto edge = first; edge != last; ++edge) {
      if (boost::get(capacity, *edge) == 1 && boost::get(residual, *edge) == 0) {
        assignment[i] = boost::target(*edge, graph) - rows;
        ++pairs;
      }
    }
  }
  if (pairs < std::min(rows, columns)) return std::nullopt;
  return assignment;
}

}  // namespace hamjet
