// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/zero_edges.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace phongpd::internal {
namespace {

class Collapser {
 public:
  explicit Collapser(TriangleMesh* mesh) : mesh_(*mesh) {}

  std::vector<int> Run() {
    std::vector<int> thin;  // triangles with an edge of length zero
    for (int t = 0; t < TriangleCount(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (!IsZero(t, k)) continue;
        if (thin.empty() || thin.back() != t) thin.push_back(t);
        fans_[From(t, k)];
        fans_[To(t, k)];
      }
    }
    is_gone_.assign(mesh_.triangles.size(), 0);
    if (!thin.empty()) CollectFans();
    // A collapse may free another edge for its own.
    while (CollapseSome(thin)) {
    }
    return Compact();
  }

 private:
  int TriangleCount() const { return static_cast<int>(mesh_.triangles.size()); }
  int From(int t, int k) const { return mesh_.triangles[t][k]; }
  int To(int t, int k) const { return mesh_.triangles[t][(k + 1) % 3]; }
  bool IsZero(int t, int k) const {
    return mesh_.vertices[From(t, k)] == mesh_.vertices[To(t, k)];
  }

  void CollectFans() {
    for (int t = 0; t < TriangleCount(); ++t) {
      for (const int v : mesh_.triangles[t]) {
        const auto fan = fans_.find(v);
        if (fan != fans_.end()) fan->second.push_back(t);
      }
    }
  }

  bool CollapseSome(const std::vector<int>& thin) {
    bool any = false;
    for (const int t : thin) {
      for (int k = 0; k < 3; ++k) {
        if (is_gone_[t] || !IsZero(t, k) ||
            !MayCollapse(From(t, k), To(t, k))) {
          continue;
        }
        Collapse(From(t, k), To(t, k));
        any = true;
      }
    }
    return any;
  }

  std::vector<int> Neighbors(int v) const {
    std::vector<int> found;
    for (const int t : fans_.at(v)) {
      if (is_gone_[t]) continue;
      for (const int w : mesh_.triangles[t]) {
        if (w != v) found.push_back(w);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  bool MayCollapse(int u, int v) const {
    const std::vector<int> a = Neighbors(u), b = Neighbors(v);
    std::vector<int> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                          std::back_inserter(common));
    return common.size() == 2 && a.size() + b.size() > 6;
  }

  // Into u.
  void Collapse(int u, int v) {
    for (const int t : fans_.at(v)) {
      Triangle& triangle = mesh_.triangles[t];
      if (is_gone_[t]) continue;
      if (std::find(triangle.begin(), triangle.end(), u) != triangle.end()) {
        is_gone_[t] = 1;
      } else {
        std::replace(triangle.begin(), triangle.end(), v, u);
        fans_.at(u).push_back(t);
      }
    }
    fans_.at(v).clear();
  }

  // Removes what is gone; returns what is not.
  std::vector<int> Compact() {
    std::vector<int> kept, new_index(mesh_.vertices.size(), -1);
    for (int t = 0; t < TriangleCount(); ++t) {
      if (is_gone_[t]) continue;
      for (const int v : mesh_.triangles[t]) new_index[v] = 0;
      mesh_.triangles[kept.size()] = mesh_.triangles[t];
      kept.push_back(t);
    }
    mesh_.triangles.resize(kept.size());
    int count = 0;
    for (std::size_t v = 0; v < new_index.size(); ++v) {
      if (new_index[v] < 0) continue;
      mesh_.vertices[count] = mesh_.vertices[v];
      new_index[v] = count++;
    }
    mesh_.vertices.resize(count);
    for (Triangle& t : mesh_.triangles) {
      for (int& v : t) v = new_index[v];
    }
    return kept;
  }

  TriangleMesh& mesh_;
  std::unordered_map<int, std::vector<int>> fans_;  // of ends of zero edges
  std::vector<char> is_gone_;
};

}  // namespace

std::vector<int> CollapseZeroEdges(TriangleMesh* mesh) {
  return Collapser(mesh).Run();
}

}  // namespace phongpd::internal
