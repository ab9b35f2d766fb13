// SPDX-License-Identifier: GPL-3.0-or-later
// query_instructions KIND SPACE: does one kind of query on one contact space,
// so that callgrind can count the instructions of phongpd_counted alone
// (scripts/count_queries.sh).  Prints how many queries these were.  Public
// headers only: it compiles with other commits, too.
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"

namespace {

using Eigen::Vector3d;
using phongpd::Branch;
using phongpd::ContactSpace;
using phongpd::PenetrationResult;
using Work = std::function<double(const std::vector<Vector3d>&)>;

phongpd::TriangleMesh Shape(const std::string& name) {
  if (name == "torus_440") return phongpd::MakeTorus(1.0, 0.35, 22, 10);
  if (name == "torus_10000") return phongpd::MakeTorus(1.0, 0.35, 100, 50);
  if (name == "organic_5120") return phongpd::MakeBlob(1.5, 4, 0.35, 1);
  throw phongpd::InputError("space: no '" + name + "'");
}

phongpd::PhongMetric Phong(const ContactSpace& contact, double length) {
  phongpd::PhongMetricOptions options;
  options.field_options.smoothing_length = length;
  return phongpd::PhongMetric(contact, options);
}

// Ten ways of a hundred frames, a thousandth of D each, all inside.
std::vector<Vector3d> Frames(const ContactSpace& contact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vector3d center = contact.bounds().Center();
  const Vector3d half = 0.5 * (contact.bounds().max - contact.bounds().min);
  const auto any = [&] { return phongpd::RandomVector(&unit, &random); };
  std::vector<Vector3d> frames;
  while (frames.size() < 1000) {
    const Vector3d from = center + half.cwiseProduct(any());
    const Vector3d step = 1e-3 * contact.length() * any().normalized();
    bool inside = true;
    for (int i = 0; i < 100 && inside; ++i) {
      inside =
          contact.bvh().Locate(from + i * step) == phongpd::Location::kInside;
    }
    for (int i = 0; i < 100 && inside; ++i) frames.push_back(from + i * step);
  }
  return frames;
}

}  // namespace

// What is counted: the name is callgrind's.
extern "C" __attribute__((noinline)) double phongpd_counted(
    const Work& work, const std::vector<Vector3d>& frames) {
  return work(frames);
}

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "query_instructions: expected KIND SPACE\n";
    return 2;
  }
  const std::string kind = argv[1];
  const double length = kind.find("0.2") != std::string::npos ? 0.2 : 0.0;
  const ContactSpace contact = phongpd::TakeAsContactSpace(Shape(argv[2]));
  const std::vector<Vector3d> frames = Frames(contact);
  const phongpd::PhongMetric phong = Phong(contact, length);
  const phongpd::EuclideanMetric euclidean(contact);
  Work work;
  if (kind == "euclidean") {
    work = [&](const std::vector<Vector3d>& points) {
      double sum = 0.0;
      for (const Vector3d& q : points)
        sum += euclidean.Query(q).signed_distance;
      return sum;
    };
  } else if (kind.rfind("cold", 0) == 0) {
    work = [&](const std::vector<Vector3d>& points) {
      double sum = 0.0;
      for (const Vector3d& q : points) sum += phong.Query(q).signed_distance;
      return sum;
    };
  } else if (kind.rfind("warm", 0) == 0) {
    work = [&](const std::vector<Vector3d>& points) {
      double sum = 0.0;
      Branch branch;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 100 == 0) branch = Branch();
        const PenetrationResult result = phong.Query(points[i], branch);
        branch = result.branch;
        sum += result.signed_distance;
      }
      return sum;
    };
  } else if (kind == "segment") {
    work = [&](const std::vector<Vector3d>& points) {
      double sum = 0.0;
      for (std::size_t i = 1; i < points.size(); ++i) {
        sum += contact.bvh().Meets(points[i - 1], points[i]) ? 1.0 : 0.0;
      }
      return sum;
    };
  } else {
    throw phongpd::InputError("kind: no '" + kind + "'");
  }
  const double sum = phongpd_counted(work, frames);
  std::cerr << "sum " << sum << '\n';
  std::cout << frames.size() << '\n';
  return 0;
} catch (const std::exception& error) {
  std::cerr << "query_instructions: " << error.what() << '\n';
  return 3;
}
