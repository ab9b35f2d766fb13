// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/same_space.h"

namespace phongpd::testing {

std::string DifferenceOf(const ContactSpace& a, const ContactSpace& b) {
  const ContactSpaceReport &r = a.report(), &s = b.report();
  std::string text;
  const auto tell = [&text](bool is_same, const std::string& what) {
    if (!is_same) text += what + "; ";
  };
  tell(a.mesh().vertices == b.mesh().vertices, "vertices");
  tell(a.mesh().triangles == b.mesh().triangles,
       "triangles " + std::to_string(r.triangles) + " for " +
           std::to_string(s.triangles));
  tell(a.plane() == b.plane(), "planes");
  tell(a.kind() == b.kind(), "kinds");
  tell(r.cavities == s.cavities, "cavities " + std::to_string(r.cavities) +
                                     " for " + std::to_string(s.cavities));
  tell(r.components == s.components && r.genus == s.genus, "topology");
  tell(r.closed == s.closed && r.manifold == s.manifold, "kind of surface");
  tell(r.volume == s.volume, "volume");
  tell(r.worst_quality == s.worst_quality &&
           r.median_quality == s.median_quality,
       "quality");
  tell(r.convolution_triangles == s.convolution_triangles, "convolution");
  return text;
}

}  // namespace phongpd::testing
