// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what each knob buys and costs, from the rows that trade_benchmark
// and other suites published: one figure a consumer, and which choices no other
// beats in both.  Measures nothing itself.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "core/projection/phong_field.h"
#include "problems/output/gnuplot.h"
#include "problems/output/text.h"
#include "results/bench/csv_table.h"
#include "results/bench/paired_test.h"
#include "results/bench/program.h"
#include "results/bench/trade_consumers.h"
#include "results/bench/trade_defaults.h"

namespace phongpd::bench {
namespace {

bool IsBeaten(const Choice& choice, const std::vector<Choice>& by) {
  return std::any_of(by.begin(), by.end(), [&](const Choice& other) {
    return other.cost <= choice.cost && other.loss <= choice.loss &&
           (other.cost < choice.cost || other.loss < choice.loss);
  });
}

// "`fast` takes 0.46 of the time of `balanced` and is 0.9 % longer ..."
std::string PresetSentences(const std::string& results) {
  const CsvTable rows = ReadCsvTable(results + "/trade/knobs.csv");
  std::string text;
  for (const auto& [consumer, what] :
       {std::pair("optimize", "energy"), std::pair("plan", "length")}) {
    for (const char* preset : {"fast", "balanced", "tight"}) {
      for (std::size_t i = 0; i < rows.rows().size(); ++i) {
        if (rows.Text(i, "consumer") != consumer ||
            rows.Text(i, "choice") != preset) {
          continue;
        }
        text += "- `" + std::string(consumer) + " --preset " + preset +
                "`: " + rows.Text(i, "time") +
                " of balanced's processor time, " + what + " " +
                rows.Text(i, "mean excess, %") +
                " % above the least that anything tried found (worst " +
                rows.Text(i, "worst excess, %") + " %), exactly free paths " +
                rows.Text(i, "answered") + " of " + rows.Text(i, "instances") +
                ".\n";
      }
    }
  }
  return text;
}

// Names in the margin, in the order of the points, each led to its own.
std::string Labels(const Panel& panel) {
  std::vector<Choice> choices = panel.choices;
  std::sort(choices.begin(), choices.end(),
            [](const Choice& a, const Choice& b) {
              return std::pair(a.loss, -a.cost) < std::pair(b.loss, -b.cost);
            });
  std::ostringstream script;
  script << "unset label\nunset arrow\n";
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Choice& c = choices[i];
    const double height =
        (static_cast<double>(i) + 0.5) / static_cast<double>(choices.size());
    const char* color = IsBeaten(c, choices) ? "#606060" : "#0060B0";
    script << "set arrow from " << c.cost << ',' << c.loss
           << " to graph 1.03, graph " << height
           << " nohead lc rgb '#CCCCCC' lw 0.7\nset label \"" << c.name << ", "
           << c.aside << "\" at graph 1.04, graph " << height
           << " left font ',11' tc rgb '" << color << "'\n";
  }
  return script.str();
}

// Filled where no other is better in both.
std::string Draw(const Consumer& consumer) {
  std::ostringstream script;
  const std::size_t panels = consumer.panels.size();
  for (std::size_t p = 0; p < panels; ++p) {
    for (const bool beaten : {false, true}) {
      script << "$p" << p << (beaten ? "b" : "a") << " << EOD\n";
      for (const Choice& c : consumer.panels[p].choices) {
        if (IsBeaten(c, consumer.panels[p].choices) != beaten) continue;
        script << c.cost << ' ' << c.loss << '\n';
      }
      script << "EOD\n";
    }
  }
  script << "set multiplot layout 1," << panels << "\nunset key\n"
         << "set termoption noenhanced\nset grid lc rgb '#DDDDDD'\n"
         << "set offsets graph 0.08,graph 0.05,graph 0.08,graph 0.05\n"
         << "set xlabel '" << consumer.cost << "'\nset ylabel '"
         << consumer.loss << "'\nset format x '%g'\nset rmargin "
         << (panels == 1 ? 38 : 24) << '\n';
  if (consumer.logarithmic) script << "set logscale x\n";
  for (std::size_t p = 0; p < panels; ++p) {
    script << Labels(consumer.panels[p]) << "set title '"
           << consumer.panels[p].title << "'\nplot $p" << p
           << "b using 1:2 with points pt 6 ps 0.8 lc rgb '#606060', $p" << p
           << "a using 1:2 with points pt 7 ps 0.8 lc rgb '#0060B0'\n";
  }
  script << "unset multiplot\n";
  return RenderSvg(script.str(), panels == 1 ? 860 : 1240, 460);
}

NamedTable TableOf(const Consumer& consumer) {
  NamedTable named{
      consumer.file + ".csv",
      {consumer.title,
       consumer.note,
       {"choice", "of", consumer.cost, consumer.loss, consumer.aside, "beaten"},
       {}}};
  for (const Panel& panel : consumer.panels) {
    for (const Choice& c : panel.choices) {
      named.table.rows.push_back(
          {c.name, panel.title.empty() ? "all" : panel.title, Shown(c.cost),
           Shown(c.loss), c.aside, IsBeaten(c, panel.choices) ? "yes" : "no"});
    }
  }
  return named;
}

std::string Findings(const std::vector<Consumer>& consumers) {
  std::string text;
  for (const Consumer& consumer : consumers) {
    for (const Panel& panel : consumer.panels) {
      text += "- **" + consumer.title +
              (panel.title.empty() ? "" : ", " + panel.title) + "**: ";
      std::vector<std::string> best;
      for (const Choice& c : panel.choices) {
        if (IsBeaten(c, panel.choices)) continue;
        best.push_back("`" + c.name + "` (" + Rounded(c.cost) + ", " +
                       Rounded(c.loss) + ")");
      }
      text += "no other choice is better in both " + consumer.cost + " and " +
              consumer.loss + " than " + Joined(best) + ".\n";
    }
  }
  return text;
}

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

// Two smoothing lengths seed by seed: who alone solves, who takes fewer
// iterations where both do.
std::string Duel(const CsvTable& rows, const std::string& protocol,
                 const std::string& a, const std::string& b) {
  struct Run {
    bool solved = false;
    double iterations = 0.0;
  };
  std::map<std::string, std::map<std::string, Run>> runs;
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    if (rows.Text(i, "protocol") != protocol) continue;
    runs[rows.Text(i, "scene") + ' ' + rows.Text(i, "seed")]
        [rows.Text(i, "method")] = {rows.Text(i, "solved") == "true",
                                    rows.Number(i, "iterations")};
  }
  int only_a = 0, only_b = 0, fewer_a = 0, fewer_b = 0;
  for (const auto& [seed, methods] : runs) {
    const auto first = methods.find(a), second = methods.find(b);
    if (first == methods.end() || second == methods.end()) continue;
    const Run &x = first->second, &y = second->second;
    only_a += x.solved && !y.solved ? 1 : 0;
    only_b += y.solved && !x.solved ? 1 : 0;
    if (!x.solved || !y.solved) continue;
    fewer_a += x.iterations < y.iterations ? 1 : 0;
    fewer_b += y.iterations < x.iterations ? 1 : 0;
  }
  const auto told = [](int m, int n) {
    return std::to_string(m) + " : " + std::to_string(n) +
           " (p = " + Rounded(SignTest(m, n), 2) + ")";
  };
  return "- " + protocol + ", " + a + " : " + b + ": solved alone " +
         told(only_a, only_b) + ", fewer iterations " + told(fewer_a, fewer_b) +
         ".\n";
}

// What was decided by these rows.
std::string Decisions(const std::string& results) {
  const CsvTable rows = ReadCsvTable(results + "/convergence/rows.csv");
  std::string text =
      "\nQueries and motions have no preset. What one could set is how finely "
      "the field resolves its smoothing length: [fields.csv](fields.csv) has "
      "edges of ℓ/4, ℓ/2 (the default), ℓ and as they are, and what they "
      "change in jumps and depth is of the order of chance.\n\n"
      "One smoothing length for all, ℓ = " +
      Rounded(kDefaultSmoothingLength) +
      " D (`kDefaultSmoothingLength`), by the published seeds "
      "(`results/convergence/rows.csv`; sign test, uncorrected) and by the "
      "motions of fields.csv, where the lengths that smooth differ little in "
      "jumps and ℓ = 0 jumps more:\n\n";
  for (const char* protocol : {"straight-adaptive", "straight-monotone"}) {
    for (const char* other : {"phong@0", "phong@0.05", "phong@0.1"}) {
      text += Duel(rows, protocol, other, "phong@0.2");
    }
  }
  return text +
         "\nRetraction keeps ℓ = 0: it takes all branches, and smoothing "
         "changes nothing there (`planners/retraction/contact_model.h`).\n";
}

int Run(int argc, char** argv) {
  CLI::App app("What each knob buys and costs: figures.");
  std::string directory, results = "results";
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--results", results, "Where the published rows are")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::vector<Consumer> consumers = ReadConsumers(results);
  std::vector<NamedTable> tables;
  std::vector<Figure> figures;
  for (const Consumer& consumer : consumers) {
    tables.push_back(TableOf(consumer));
    figures.push_back({consumer.file + ".svg",
                       consumer.title + ": filled where no other choice is "
                                        "better in both.",
                       Draw(consumer)});
  }
  OutputDirectory out(directory);
  WriteReport(tables, figures,
              "# Speed against accuracy\n\nWhat the choice of metric, "
              "smoothing length, planner, preset, model and approximation "
              "buys and costs, one figure a consumer: from the rows that the "
              "other suites published, and from those of "
              "`build/trade_benchmark`.\n\n## Presets\n\n" +
                  PresetSentences(results) + Decisions(results) +
                  DefaultSentences(results) + "\n## Findings\n\n" +
                  Findings(consumers) + "\n" + ToMarkdown(tables, figures) +
                  "\nCommand: scripts/bench.sh trade. Seed and machine: those "
                  "of the rows; of what is measured here: " +
                  ReadText(results + "/trade/measured.txt"),
              &out);
  out.Commit();
  std::cout << Findings(consumers) << std::flush;
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("trade_report", phongpd::bench::Run, argc,
                                    argv);
}
