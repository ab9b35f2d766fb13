// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd::bench {

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

// Who trades speed for accuracy, and between what, from the published rows in
// the folder `results`.  Throws InputError for files that are missing.
std::vector<Consumer> ReadConsumers(const std::string& results);

}  // namespace phongpd::bench
