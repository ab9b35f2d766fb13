// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "planners/retraction/retraction.h"

namespace phongpd {

// How retraction planners carry colliding samples to the contact space, in one
// word: "phong" (along all branches), "phong-random", "phong-novelty",
// "phong-warm", "phong-nearest" (one of them), "euclidean", "euclidean-all",
// and, without any retraction, "contact-point" and "contact-points".
const std::vector<std::string>& RetractionNames();
// Of its metric and choice.
const std::string& RetractionName(const RetractionOptions& options);
// Throws InputError starting with `what`, with all names.
RetractionOptions ParseRetraction(const std::string& text,
                                  const std::string& what);

}  // namespace phongpd
