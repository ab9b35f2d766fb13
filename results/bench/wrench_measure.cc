// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/wrench_measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "constraints/wrench_tracker.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "results/bench/contact_points.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

// One pose, its contact space and its field.
struct Place {
  RobotPose pose;
  ContactSpace space;
  PhongMetric phong;
  double depth;  // Euclid's; 0: not inside
};

// Asked pose by pose; what it remembers begins anew with it.
using Asked = std::function<WrenchSample(const Place& place)>;
struct Metric {
  std::string name;
  bool remembers;
  std::function<Asked()> begin;
};

PhongMetricOptions Phong() {
  PhongMetricOptions options;
  options.field_options.smoothing_length = 0.2;
  return options;
}

class Metrics {
 public:
  explicit Metrics(const WrenchPair& pair)
      : pair_(pair),
        tracker_(pair.robot, pair.obstacle),
        free_tracker_(pair.robot, pair.obstacle, 1e9),
        contacts_(pair.obstacle.mesh()) {}

  const WrenchTracker& tracker() const { return tracker_; }

  std::vector<Metric> All() const {
    return {{"euclidean", false,
             [this] {
               return [this](const Place& p) {
                 const EuclideanMetric metric(p.space);
                 return AtContact(p, metric.Query(p.pose.position));
               };
             }},
            {"phong", false,
             [this] {
               return [this](const Place& p) {
                 return AtContact(p, p.phong.Query(p.pose.position));
               };
             }},
            {"phong followed", true, [this] { return Followed(); }},
            {"smoothed", false,
             [this] { return [this](const Place& p) { return Smoothed(p); }; }},
            {"tracked", true, [this] { return Tracked(tracker_); }},
            {"unbounded", true, [this] { return Tracked(free_tracker_); }}};
  }

 private:
  double Exit(const Place& p, const Vector3d& n) const {
    const double far = 2.0 * p.space.bounds().Diagonal();
    const Vector3d& q = p.pose.position;
    return far * p.space.bvh().FirstHit(q, q + far * n).fraction;
  }
  // From r, in place, and n.
  WrenchSample Sample(const Place& p, const Vector3d& n,
                      const Vector3d& r) const {
    WrenchSample sample;
    sample.inside = true;
    sample.normal = n;
    sample.torque = r.cross(n) / tracker_.gyration();
    sample.exit = Exit(p, n) / tracker_.gyration();
    sample.push = sample.exit;
    sample.depth = p.depth / tracker_.gyration();
    return sample;
  }
  // Of a metric that says where the robot touches: q_c.
  WrenchSample AtContact(const Place& p,
                         const PenetrationResult& result) const {
    const double size = p.space.bounds().Diagonal();
    Vector3d at = result.contact;
    contacts_.Mean(Translated(Rotated(pair_.robot.mesh(),
                                      p.pose.orientation.toRotationMatrix()),
                              result.contact),
                   1e-8 * size, &at);
    WrenchSample sample =
        Sample(p, (result.contact - p.pose.position).normalized(),
               at - result.contact);
    sample.is_fallback = result.status == QueryStatus::kEuclideanFallback;
    return sample;
  }
  // Of all projections not deeper than three times Euclid's the one nearest to
  // the last contact (the paper, V.B); branches do not carry over.
  Asked Followed() const {
    return [this, last = Vector3d(Vector3d::Zero()), has_last = false,
            all = std::vector<PenetrationResult>()](const Place& p) mutable {
      PenetrationResult best = p.phong.Query(p.pose.position);
      if (has_last) {
        p.phong.QueryAll(p.pose.position, 3.0 * p.depth, &all);
        for (const PenetrationResult& one : all) {
          if ((one.contact - last).norm() < (best.contact - last).norm()) {
            best = one;
          }
        }
      }
      last = best.contact;
      has_last = true;
      return AtContact(p, best);
    };
  }
  WrenchSample FromTracker(const Place& p, const TrackedWrench& wrench) const {
    WrenchSample sample = Sample(p, wrench.normal, wrench.lever);
    sample.push = wrench.push / tracker_.gyration();
    sample.is_fallback = wrench.is_fallback;
    return sample;
  }
  WrenchSample Smoothed(const Place& p) const {
    return FromTracker(p, tracker_.SmoothedAt(p.space, p.pose));
  }
  Asked Tracked(const WrenchTracker& tracker) const {
    return [this, &tracker,
            state = WrenchTracker::State()](const Place& p) mutable {
      const TrackedWrench wrench = tracker.Step(p.space, p.pose, &state);
      WrenchSample sample = FromTracker(p, wrench);
      // Half of what is wanted is turned where no bound is in the way.
      sample.is_bounded = wrench.turned < 0.499 * wrench.wanted;
      return sample;
    };
  }

  const WrenchPair& pair_;
  WrenchTracker tracker_, free_tracker_;
  ContactPoints contacts_;
};

}  // namespace

void Summarize(const std::vector<WrenchSample>& samples, WrenchRow* row) {
  double ratios = 0.0;
  const WrenchSample* last = nullptr;
  for (const WrenchSample& sample : samples) {
    if (!sample.inside) {
      last = nullptr;
      continue;
    }
    ++row->inside;
    row->bounded += sample.is_bounded ? 1 : 0;
    row->fallbacks += sample.is_fallback ? 1 : 0;
    ratios += sample.exit / sample.depth;
    row->exit_worst = std::max(row->exit_worst, sample.exit / sample.depth);
    if (last != nullptr) {
      const auto widen = [](double change, double* largest) {
        *largest = std::max(*largest, change);
      };
      widen((sample.normal - last->normal).norm(), &row->normal_change);
      widen((sample.torque - last->torque).norm(), &row->torque_change);
      widen((sample.push * sample.normal - last->push * last->normal).norm(),
            &row->push_change);
    }
    last = &sample;
  }
  if (row->inside > 0) row->exit_mean = ratios / row->inside;
}

namespace {

std::vector<Place> MakePlaces(const WrenchTracker& tracker,
                              const std::vector<RobotPose>& poses) {
  std::vector<Place> places;
  for (const RobotPose& pose : poses) {
    const ContactSpace space = tracker.SpaceAt(pose.orientation);
    const PenetrationResult euclid =
        EuclideanMetric(space).Query(pose.position);
    places.push_back({pose, space, PhongMetric(space, Phong()),
                      euclid.inside ? -euclid.signed_distance : 0.0});
  }
  return places;
}

// The samples of a metric at every `stride`-th place.
std::vector<WrenchSample> Ask(const Metric& metric,
                              const std::vector<Place>& places,
                              std::size_t stride) {
  std::vector<WrenchSample> samples;
  Asked ask = metric.begin();
  for (std::size_t i = 0; i < places.size(); i += stride) {
    const bool inside = places[i].depth > 0.0;
    if (!inside) ask = metric.begin();
    samples.push_back(inside ? ask(places[i]) : WrenchSample());
  }
  return samples;
}

}  // namespace

std::vector<WrenchRow> MeasureWrenches(const WrenchPair& pair, int steps,
                                       int lengths) {
  const Metrics metrics(pair);
  const WrenchTracker& tracker = metrics.tracker();
  std::vector<WrenchRow> rows;
  for (const WrenchMotion motion :
       {WrenchMotion::kTurn, WrenchMotion::kTurnAndMove}) {
    const std::vector<RobotPose> poses =
        WrenchPoses(pair, motion, steps << (lengths - 1));
    const double begin = CpuSeconds();
    const std::vector<Place> places = MakePlaces(tracker, poses);
    const double space_seconds =
        (CpuSeconds() - begin) / static_cast<double>(poses.size());
    for (const Metric& metric : metrics.All()) {
      double seconds = CpuSeconds();
      const std::vector<WrenchSample> finest = Ask(metric, places, 1);
      seconds = CpuSeconds() - seconds;
      for (int length = 0; length < lengths; ++length) {
        const std::size_t stride = std::size_t{1} << (lengths - 1 - length);
        WrenchRow row;
        row.pair = pair.name;
        row.motion = ToString(motion);
        row.metric = metric.name;
        row.seed = pair.seed;
        row.steps = steps << length;
        row.space_milliseconds = 1e3 * space_seconds;
        row.microseconds = 1e6 * seconds / static_cast<double>(places.size());
        for (std::size_t i = stride; i < places.size(); i += stride) {
          row.step = std::max(row.step,
                              tracker.StepLength(poses[i - stride], poses[i]) /
                                  tracker.gyration());
        }
        if (metric.remembers) {
          Summarize(Ask(metric, places, stride), &row);
        } else {
          std::vector<WrenchSample> samples;
          for (std::size_t i = 0; i < finest.size(); i += stride) {
            samples.push_back(finest[i]);
          }
          Summarize(samples, &row);
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

}  // namespace phongpd::bench
