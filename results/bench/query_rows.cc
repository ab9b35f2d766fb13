// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/query_rows.h"

#include <tuple>

namespace phongpd::bench {
namespace {

// µs of a query; 0 where it was not measured.
double MicrosOf(const std::vector<QueryRow>& rows, const QueryRow& like,
                const std::string& query) {
  for (const QueryRow& row : rows) {
    if (row.space == like.space && row.triangles == like.triangles &&
        row.sequence == like.sequence && row.query == query) {
      return row.micros;
    }
  }
  return 0.0;
}

}  // namespace

NamedTable QueryTable(const std::vector<QueryRow>& rows) {
  return {"queries.csv",
          MakeTable({"contact space", "triangles", "sequence", "query", "µs",
                     "over euclidean", "over CGAL"},
                    rows, [&](const QueryRow& row, const auto& add) {
                      add(row.space, row.triangles, row.sequence, row.query,
                          row.micros,
                          row.micros / MicrosOf(rows, row, "euclidean"),
                          row.micros / MicrosOf(rows, row, "CGAL"));
                    })};
}

NamedTable ExtrasTable(const QueryExtras& extras) {
  const std::tuple<const char*, std::string, double> rows[] = {
      {"batch", extras.batch_space, extras.batch_speedup},
      {"process", extras.process_space, extras.process_seconds},
      {"bytes", extras.most_bytes_space, extras.most_bytes}};
  return {"extras.csv", MakeTable({"what", "contact space", "value"}, rows,
                                  [](const auto& row, const auto& add) {
                                    add(std::string(std::get<0>(row)),
                                        std::get<1>(row), std::get<2>(row));
                                  })};
}

}  // namespace phongpd::bench
