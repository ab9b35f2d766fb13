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
#include "problems/output/text.h"
#include "problems/pictures/gnuplot.h"
#include "results/bench/csv_table.h"
#include "results/bench/paired_test.h"
#include "results/bench/program.h"
#include "results/bench/trade_defaults.h"

namespace phongpd::bench {
namespace {

// A choice: less of `cost` is better, and less of `loss`.
struct Choice {
  std::string name;
  double cost = 0.0, loss = 0.0;
  std::string aside;  // another figure, told beside the name
};

struct Panel {
  std::string title;
  std::vector<Choice> choices;
};

struct Consumer {
  std::string file, title, note, cost, loss, aside;
  bool logarithmic = false;  // cost
  std::vector<Panel> panels;
};

bool IsBeaten(const Choice& choice, const std::vector<Choice>& by) {
  return std::any_of(by.begin(), by.end(), [&](const Choice& other) {
    return other.cost <= choice.cost && other.loss <= choice.loss &&
           (other.cost < choice.cost || other.loss < choice.loss);
  });
}

// Metrics along motions: depth against jumps.
Consumer Queries(const std::string& results) {
  const CsvTable rows = ReadCsvTable(results + "/queries/totals.csv");
  Panel panel{"", {}};
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const double frames = rows.Number(i, "frames inside");
    panel.choices.push_back({rows.Text(i, "metric"),
                             rows.Number(i, "mean ratio"),
                             1e3 * rows.Number(i, "jumps") / frames,
                             rows.Text(i, "µs, median") + " µs"});
  }
  return {"query",
          "Query",
          "Jumps (of more than 5 % of D) against depth along motions through "
          "12 contact spaces, the hollow box apart; beside each the median "
          "time of a step. The tracker has no gradient for a solver. Rows: "
          "`results/queries/totals.csv`.",
          "mean depth / Euclidean depth",
          "jumps in 1000 frames",
          "time of a step",
          true,
          {panel}};
}

// Metrics in the optimiser: iterations against runs that are not solved.
Consumer Trajectories(const std::string& results) {
  struct Sum {
    double runs = 0.0, solved = 0.0;
    std::vector<double> iterations, seconds;
  };
  const CsvTable rows = ReadCsvTable(results + "/convergence/summary.csv");
  Consumer consumer{
      "trajectory",
      "Trajectory",
      "Ipopt from the straight, colliding line, 20 scenes of 50 seeds: runs "
      "that are not solved against the median over scenes of their median "
      "iterations; beside each the same of seconds. Where runs that are not "
      "solved "
      "differ by a point or two, that may be chance: the paired tests are in "
      "`results/convergence/verdicts.csv`. Rows: "
      "`results/convergence/summary.csv`.",
      "median iterations",
      "runs not solved, %",
      "time of a run",
      false,
      {}};
  for (const char* protocol : {"straight-adaptive", "straight-monotone"}) {
    std::map<std::string, Sum> sums;
    for (std::size_t i = 0; i < rows.rows().size(); ++i) {
      const std::string& method = rows.Text(i, "method");
      // The study's own metrics are no choice of users; where Jacobians are
      // compared there are fewer seeds.
      const bool is_choice =
          method == "euclidean" || method.compare(0, 6, "phong@") == 0;
      if (rows.Text(i, "protocol") != protocol || !is_choice ||
          method.find('/') != std::string::npos) {
        continue;
      }
      Sum& sum = sums[method];
      sum.runs += rows.Number(i, "runs");
      sum.solved += rows.Number(i, "solved");
      sum.iterations.push_back(rows.Number(i, "median_iterations"));
      sum.seconds.push_back(rows.Number(i, "median_seconds"));
    }
    Panel panel{protocol, {}};
    for (const auto& [method, sum] : sums) {
      panel.choices.push_back(
          {method, Quantile(sum.iterations, 0.5),
           100.0 * (1.0 - sum.solved / sum.runs),
           Rounded(1e3 * Quantile(sum.seconds, 0.5)) + " ms"});
    }
    consumer.panels.push_back(panel);
  }
  return consumer;
}

// Planners on narrow passages: time against runs that are not solved.
Consumer Planning(const std::string& results) {
  struct Sum {
    double runs = 0.0, solved = 0.0;
    int scenes = 0, passed = 0;  // passed: most runs have an answer
    std::vector<double> seconds;
  };
  std::map<std::string, Sum> sums;
  const CsvTable rows = ReadCsvTable(results + "/planning/samplers.csv");
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const std::string& solved = rows.Text(i, "solved");
    const std::size_t slash = solved.find('/');
    if (slash == std::string::npos) {
      throw InputError("samplers.csv: solved: expected n/m, found '" + solved +
                       "'");
    }
    Sum& sum = sums[rows.Text(i, "planner")];
    const double answers =
        ParseDouble(solved.substr(0, slash), "samplers.csv: solved");
    const double runs =
        ParseDouble(solved.substr(slash + 1), "samplers.csv: runs");
    sum.solved += answers;
    sum.runs += runs;
    ++sum.scenes;
    sum.passed += 2.0 * answers > runs ? 1 : 0;
    sum.seconds.push_back(rows.Number(i, "median s"));
  }
  Panel panel{"", {}};
  for (const auto& [planner, sum] : sums) {
    panel.choices.push_back({planner, Quantile(sum.seconds, 0.5),
                             100.0 * (1.0 - sum.solved / sum.runs),
                             Shown(sum.passed) + "/" + Shown(sum.scenes)});
  }
  const CsvTable exact = ReadCsvTable(results + "/planning/exact.csv");
  Sum own;
  for (std::size_t i = 0; i < exact.rows().size(); ++i) {
    if (exact.Text(i, "answer") != "solved") continue;
    own.solved += exact.Text(i, "right") == "yes" ? 1.0 : 0.0;
    own.runs += 1.0;
    own.seconds.push_back(
        1e-3 * (exact.Number(i, "query ms") + exact.Number(i, "tables ms")));
  }
  panel.choices.push_back({"contact-surface", Quantile(own.seconds, 0.5),
                           100.0 * (1.0 - own.solved / own.runs),
                           Shown(static_cast<int>(own.solved)) + "/" +
                               Shown(static_cast<int>(own.runs))});
  return {"planning",
          "Planning",
          "Narrow passages with a path: runs without an answer in time against "
          "the median over scenes of their median time, that of a run "
          "without an answer being its limit; beside each on how "
          "many scenes most runs were solved. The contact space is there "
          "before either starts. `contact-surface` was run on more scenes, "
          "once each: it is deterministic. Rows: `results/planning/"
          "samplers.csv` and `exact.csv`.",
          "median seconds",
          "runs not solved, %",
          "scenes",
          true,
          {panel}};
}

// Presets and knobs that trade_benchmark measured.
Consumer Knobs(const std::string& results, const std::string& file,
               const std::string& title, const std::string& of,
               const std::vector<std::string>& consumers) {
  const CsvTable rows = ReadCsvTable(results + "/trade/knobs.csv");
  Consumer consumer{
      file,
      title,
      "Processor time over that of the default on the same instance, its "
      "median; " +
          of +
          " over the least that any choice found there, its mean, runs with an "
          "answer. Rows: `results/trade/knobs.csv`.",
      "time over that of the default",
      "excess, %",
      "answered",
      true,
      {}};
  for (const std::string& name : consumers) {
    Panel panel{consumers.size() == 1 ? "" : name, {}};
    for (std::size_t i = 0; i < rows.rows().size(); ++i) {
      if (rows.Text(i, "consumer") != name) continue;
      panel.choices.push_back(
          {rows.Text(i, "choice"), rows.Number(i, "time"),
           rows.Number(i, "mean excess, %"),
           rows.Text(i, "answered") + "/" + rows.Text(i, "instances")});
    }
    consumer.panels.push_back(panel);
  }
  return consumer;
}

// Operands simplified before the contact space is built.
Consumer Approximations(const std::string& results) {
  struct Sum {
    std::vector<double> build;
    double error = 0.0, missed = 0.0;
  };
  const CsvTable rows = ReadCsvTable(results + "/trade/approximations.csv");
  std::vector<std::pair<std::string, Sum>> sums;
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const std::string& choice = rows.Text(i, "choice");
    auto same = std::find_if(sums.begin(), sums.end(),
                             [&](const auto& s) { return s.first == choice; });
    if (same == sums.end()) same = sums.insert(sums.end(), {choice, {}});
    same->second.build.push_back(rows.Number(i, "time of build"));
    same->second.error += rows.Number(i, "mean error, % of D");
    same->second.missed += rows.Number(i, "missed, %");
  }
  Panel panel{"", {}};
  for (const auto& [choice, sum] : sums) {
    const auto pairs = static_cast<double>(sum.build.size());
    panel.choices.push_back({choice, Quantile(sum.build, 0.5),
                             sum.error / pairs,
                             Rounded(sum.missed / pairs) + " %"});
  }
  return {"approximation",
          "Approximated operands",
          "Processor time of a build over that of the exact one, median of "
          "six pairs, and the mean error of the Euclidean depth inside; beside "
          "each how many colliding points are told free. Rows, pair by pair "
          "and with the bound that the report proves: "
          "`results/trade/approximations.csv`.",
          "time of the build over that of the exact one",
          "mean error of depth, % of D",
          "missed",
          true,
          {panel}};
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
  const std::vector<Consumer> consumers = {
      Queries(results),
      Trajectories(results),
      Planning(results),
      Knobs(results, "optimize", "Presets and knobs of optimize",
            "energy of the path", {"optimize"}),
      Knobs(results, "plan", "Presets and knobs of contact-surface",
            "length of the path", {"plan"}),
      Knobs(results, "model", "Level of the model",
            "what is built included; energy or length",
            {"model: plan", "model: optimize"}),
      Approximations(results)};
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
