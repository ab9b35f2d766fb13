// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/route_table.h"

#include <algorithm>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Scratch = RouteTable::Scratch;

using internal::kInfinity;

void Begin(std::size_t nodes, Scratch* s) {
  if (s->round.size() != nodes) {
    *s = {};
    s->length.resize(nodes);
    s->before.resize(nodes);
    s->edge.resize(nodes);
    s->round.assign(nodes, 0);
  }
  if (++s->current == 0) {
    std::fill(s->round.begin(), s->round.end(), 0u);
    s->current = 1;
  }
  s->open.clear();
}

bool IsLater(const Scratch::Entry& a, const Scratch::Entry& b) {
  return a.bound != b.bound ? a.bound > b.bound : a.node > b.node;
}

bool Improves(int node, double length, const Scratch& s) {
  return s.round[node] != s.current || length < s.length[node];
}

void Push(int node, int before, int edge, double length, double left,
          Scratch* s) {
  s->round[node] = s->current;
  s->length[node] = length;
  s->before[node] = before;
  s->edge[node] = edge;
  s->open.push_back({length + left, length, node});
  std::push_heap(s->open.begin(), s->open.end(), IsLater);
}

Scratch::Entry Pop(Scratch* s) {
  const Scratch::Entry top = s->open.front();
  std::pop_heap(s->open.begin(), s->open.end(), IsLater);
  s->open.pop_back();
  return top;
}

}  // namespace

RouteTable::RouteTable(int nodes, const std::vector<Edge>& edges) {
  first_.assign(nodes + 1, 0);
  for (const Edge& edge : edges) {
    ++first_[edge.from + 1];
    ++first_[edge.to + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  arcs_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    const int number = static_cast<int>(e);
    arcs_[next[edge.from]++] = {edge.to, number, edge.length};
    arcs_[next[edge.to]++] = {edge.from, number, edge.length};
  }
  MeasureLandmarks();
}

void RouteTable::MeasureFrom(int node, std::size_t landmark, Scratch* s) {
  Begin(distances_.size(), s);
  Push(node, -1, -1, 0.0, 0.0, s);
  while (!s->open.empty()) {
    const Scratch::Entry top = Pop(s);
    if (top.length > s->length[top.node]) continue;
    distances_[top.node][landmark] = top.length;
    for (int k = first_[top.node]; k < first_[top.node + 1]; ++k) {
      const double length = top.length + arcs_[k].length;
      if (Improves(arcs_[k].to, length, *s)) {
        Push(arcs_[k].to, top.node, k, length, 0.0, s);
      }
    }
  }
}

// Of every connected part: each landmark farthest from those before.
void RouteTable::MeasureLandmarks() {
  Distances unknown;
  unknown.fill(kInfinity);
  distances_.assign(first_.size() - 1, unknown);
  std::vector<char> seen(distances_.size(), 0);
  std::vector<int> part;
  Scratch scratch;
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (seen[seed] != 0) continue;
    part.assign(1, static_cast<int>(seed));
    seen[seed] = 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (int k = first_[part[i]]; k < first_[part[i] + 1]; ++k) {
        if (seen[arcs_[k].to] != 0) continue;
        seen[arcs_[k].to] = 1;
        part.push_back(arcs_[k].to);
      }
    }
    const auto farthest = [&](std::size_t landmarks) {
      double most = -1.0;
      int found = part[0];
      for (const int i : part) {
        const auto begin = distances_[i].begin();
        const double distance = *std::min_element(
            begin, begin + static_cast<std::ptrdiff_t>(landmarks));
        if (distance > most) {
          most = distance;
          found = i;
        }
      }
      return found;
    };
    // The first is as far as possible from an arbitrary node.
    MeasureFrom(part[0], 0, &scratch);
    MeasureFrom(farthest(1), 0, &scratch);
    for (std::size_t k = 1; k < kLandmarks; ++k) {
      MeasureFrom(farthest(k), k, &scratch);
    }
  }
}

RouteTable::Route RouteTable::Search(const std::vector<Stop>& starts,
                                     const std::vector<Stop>& goals,
                                     Scratch* scratch) const {
  Scratch& s = *scratch;
  Begin(distances_.size(), &s);
  Route route;
  // |d(v) − d(g)| + price ≥ low − d(v) and ≥ d(v) − high for all goals.
  Distances low, high;
  low.fill(kInfinity);
  high.fill(-kInfinity);
  for (const Stop& goal : goals) {
    for (std::size_t k = 0; k < kLandmarks; ++k) {
      const double d = distances_[goal.node][k];
      low[k] = std::min(low[k], d + goal.length);
      high[k] = std::max(high[k], d - goal.length);
    }
  }
  const auto offer = [&](int node, int before, int edge, double length) {
    if (!Improves(node, length, s)) return;
    double left = 0.0;
    const Distances& d = distances_[node];
    for (std::size_t k = 0; k < kLandmarks; ++k) {
      left = std::max({left, low[k] - d[k], d[k] - high[k]});
    }
    Push(node, before, edge, length, left, &s);
  };
  for (std::size_t i = 0; i < starts.size(); ++i) {
    offer(starts[i].node, -1, static_cast<int>(i), starts[i].length);
  }
  double best = kInfinity;
  while (!s.open.empty() && s.open.front().bound < best) {
    const Scratch::Entry top = Pop(&s);
    if (top.length > s.length[top.node]) continue;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const double length = top.length + goals[i].length;
      if (goals[i].node == top.node && length < best) {
        best = length;
        route.goal = static_cast<int>(i);
      }
    }
    for (int k = first_[top.node]; k < first_[top.node + 1]; ++k) {
      offer(arcs_[k].to, top.node, arcs_[k].edge, top.length + arcs_[k].length);
    }
  }
  if (route.goal < 0) return route;
  route.length = best;
  int i = goals[static_cast<std::size_t>(route.goal)].node;
  for (; s.before[i] >= 0; i = s.before[i]) {
    route.nodes.push_back(i);
    route.edges.push_back(s.edge[i]);
  }
  route.nodes.push_back(i);
  route.start = s.edge[i];
  std::reverse(route.nodes.begin(), route.nodes.end());
  std::reverse(route.edges.begin(), route.edges.end());
  return route;
}

}  // namespace phongpd
