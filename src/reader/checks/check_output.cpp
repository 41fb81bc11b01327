// Checks of what is written, and how often.
#include "check_scene.hpp"

#include "measure/particle_columns.hpp"

namespace geodrop {
namespace {

/// Below this share of the simulated time an interval is a slip of the pen: every step is written anyway long before.
constexpr double smallest_share = 1e-9;

void check_interval(const Scene& scene, const std::string& key, double interval, Report& report) {
  if (!report.healthy(key) || !report.healthy("time") || interval >= smallest_share * scene.time.end) return;
  report.add(key, to_text(interval),
             "at least 1e-9 of time.end = " + to_text(scene.time.end) + "; each step is written at most once");
}

void check_fields(const Scene& scene, Report& report) {
  const std::string key = "output.fields";
  if (!report.healthy(key)) return;
  const std::vector<std::string> known = particle_columns();
  for (const std::string& field : scene.output.fields)
    check_reference(key, field, known, "fields of particles", report);
}

}  // namespace

void check_output(const Scene& scene, Report& report) {
  check_interval(scene, "output.frame_interval", scene.output.frame_interval, report);
  check_interval(scene, "output.history_interval", scene.output.history_interval, report);
  check_fields(scene, report);
}

}  // namespace geodrop
