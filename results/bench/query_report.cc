// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/query_report.h"

#include <algorithm>
#include <limits>

#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

constexpr const char* kRandom = "random";
constexpr const char* kCoherent = "step 0.001";

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

const QueryRow* Find(const std::vector<QueryRow>& rows,
                     const std::string& space, std::size_t triangles,
                     const std::string& sequence, const std::string& query) {
  for (const QueryRow& row : rows) {
    if (row.space == space && row.triangles == triangles &&
        row.sequence == sequence && row.query == query) {
      return &row;
    }
  }
  return nullptr;
}

std::string Line(const std::string& aim, const std::string& found,
                 bool reached) {
  return "- " + aim + ": " + found +
         (reached ? " – reached.\n" : " – **not reached**.\n");
}

// Warm queries, at 10³ and at 10⁶ triangles.
std::string WarmLines(const std::vector<QueryRow>& rows) {
  const QueryRow* small = Find(rows, "torus", 1024, kCoherent, "warm@0");
  const QueryRow* large = Find(rows, "torus", 1000000, kCoherent, "warm@0");
  std::string text;
  if (small != nullptr) {
    text += Line("warm ≤ 0.3 µs at 10³ triangles",
                 Rounded(small->micros) + " µs (torus, ℓ = 0, steps of 0.001)",
                 small->micros <= 0.3);
  }
  if (small != nullptr && large != nullptr) {
    const double ratio = large->micros / small->micros;
    text += Line("warm at 10⁶ ≤ 2 × that at 10³",
                 Rounded(ratio) + " × (" + Rounded(large->micros) + " µs)",
                 ratio <= 2.0);
  }
  return text;
}

// Beside CGAL at 10⁴, on each of the two spaces of that size.
std::string CgalLine(const std::vector<QueryRow>& rows,
                     const std::string& query, const std::string& sequence,
                     double aim) {
  std::string found;
  double least = std::numeric_limits<double>::infinity();
  for (const QueryRow& row : rows) {
    if (row.sequence != sequence || row.query != query ||
        row.triangles < 8000 || row.triangles > 12500) {
      continue;
    }
    const double ratio = MicrosOf(rows, row, "CGAL") / row.micros;
    least = std::min(least, ratio);
    found +=
        (found.empty() ? "" : ", ") + Rounded(ratio) + " × (" + row.space + ")";
  }
  return found.empty()
             ? ""
             : Line(query + " ≥ " + Rounded(aim) +
                        " × faster than CGAL's AABB tree at 10⁴, " + sequence,
                    found, least >= aim);
}

std::string CgalLines(const std::vector<QueryRow>& rows) {
  return CgalLine(rows, "warm@0", kCoherent, 20.0) +
         CgalLine(rows, "warm@0.2", kCoherent, 20.0) +
         CgalLine(rows, "cold@0", kRandom, 2.0) +
         CgalLine(rows, "cold@0.2", kRandom, 2.0);
}

// Cold beside our own Euclid, everywhere.
std::string EuclidLine(const std::vector<QueryRow>& rows) {
  std::vector<double> ratios;
  std::string above;
  for (const QueryRow& row : rows) {
    if (row.query.rfind("cold", 0) != 0 || row.sequence != kRandom) continue;
    const double ratio = row.micros / MicrosOf(rows, row, "euclidean");
    ratios.push_back(ratio);
    if (ratio > 2.0) {
      above += "; " + row.space + ", " + row.query + ": " + Rounded(ratio);
    }
  }
  return Line("cold ≤ 2 × our own Euclid at every size, ℓ = 0 and 0.2",
              Rounded(Quantile(ratios, 0.0)) + " to " +
                  Rounded(Quantile(ratios, 1.0)) + " ×, median " +
                  Rounded(Quantile(ratios, 0.5)) + above,
              above.empty());
}

std::string ExtraLines(const QueryExtras& extras) {
  return Line("`QueryBatch` on 2 threads ≥ 1.8 ×",
              Rounded(extras.batch_speedup) + " × (" + extras.batch_space + ")",
              extras.batch_speedup >= 1.8) +
         Line(
             "`phongpd query` of 10⁴ points on a saved space of 10⁴ triangles "
             "≤ 0.15 s, the whole process",
             Rounded(extras.process_seconds) + " s (" + extras.process_space +
                 ")",
             extras.process_seconds <= 0.15) +
         Line("indexes ≤ 1 KiB a triangle",
              Rounded(extras.most_bytes) +
                  " bytes, meshes included, of a contact space and a metric, "
                  "ℓ = 0 (" +
                  extras.most_bytes_space + ", the largest)",
              extras.most_bytes <= 1024.0);
}

// Who is quicker, and where not.
std::string WinsAndLosses(const std::vector<QueryRow>& rows) {
  int against_cgal = 0, cold = 0, against_euclid = 0;
  std::string lost;
  for (const QueryRow& row : rows) {
    if (row.query.rfind("cold", 0) != 0 || row.sequence != kRandom) continue;
    ++cold;
    const double cgal = MicrosOf(rows, row, "CGAL");
    const double euclid = MicrosOf(rows, row, "euclidean");
    if (row.micros < cgal) {
      ++against_cgal;
    } else {
      lost += "- " + row.space + ", " + Shown(row.triangles) +
              " triangles: " + row.query + " takes " +
              Rounded(row.micros / cgal) + " times CGAL's closest point.\n";
    }
    against_euclid += row.micros < euclid ? 1 : 0;
    if (row.micros >= euclid) {
      lost += "- " + row.space + ", " + Shown(row.triangles) +
              " triangles: " + row.query + " takes " +
              Rounded(row.micros / euclid) + " times our own Euclid.\n";
    }
  }
  return "A cold query, the least depth over all projections with its side "
         "decided exactly, is quicker than CGAL's closest point, which "
         "decides no side, on " +
         Shown(against_cgal) + " of " + Shown(cold) +
         " spaces and fields, and quicker than our own Euclidean query on " +
         Shown(against_euclid) + ". It loses:\n\n" +
         (lost.empty() ? "- nowhere in this run.\n" : lost);
}

}  // namespace

NamedTable QueryTable(const std::vector<QueryRow>& rows) {
  return {
      "queries.csv",
      MakeTable(
          "Time of a query",
          "Random: points inside that have nothing to do with each other. "
          "Step: "
          "straight motions inside, by that share of D from frame to frame. "
          "cold@ℓ and warm@ℓ: PhongPD without and with the branch of the frame "
          "before; euclidean: our own, side included; CGAL: closest point of "
          "its AABB tree over doubles, with its accelerator; segment: does the "
          "segment to the next point meet the surface, exactly. CPU time, "
          "median of the repetitions, in random order.",
          {"contact space", "triangles", "sequence", "query", "µs",
           "over euclidean", "over CGAL"},
          rows, [&](const QueryRow& row, const auto& add) {
            add(row.space, row.triangles, row.sequence, row.query, row.micros,
                row.micros / MicrosOf(rows, row, "euclidean"),
                row.micros / MicrosOf(rows, row, "CGAL"));
          })};
}

NamedTable InstructionTable(const CsvTable& csv) {
  NamedTable named{
      "instructions.csv",
      {"Instructions of a query",
       "Counted by callgrind on motions of 0.001 D a frame "
       "(`scripts/count_queries.sh`); `scripts/compare_queries.sh A B` sets "
       "those of two commits beside each other.",
       {},
       {}}};
  named.table.header = csv.header();
  named.table.rows = csv.rows();
  return named;
}

std::string QueryReadme(const std::vector<QueryRow>& rows,
                        const QueryExtras& extras,
                        const std::vector<NamedTable>& tables) {
  return "# Queries\n\n"
         "How long one takes, by size of the contact space, beside CGAL's AABB "
         "tree and our own Euclidean query. What each metric does along a "
         "motion, jumps and depths, and the tracker's own numbers: "
         "[tracker.md](tracker.md); what any rule could do, and of which kind "
         "each jump is: [continuity.md](continuity.md). Queries are measured "
         "by the CPU, batch and "
         "process by the clock, which suffers from whatever else the machine "
         "does.\n\n"
         "## Aimed at and found\n\n" +
         WarmLines(rows) + CgalLines(rows) + EuclidLine(rows) +
         ExtraLines(extras) + "\n## Wins and losses\n\n" + WinsAndLosses(rows) +
         "\n" + ToMarkdown(tables, {});
}

}  // namespace phongpd::bench
