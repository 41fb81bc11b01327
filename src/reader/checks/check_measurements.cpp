// Checks of probes, results and expectations: what they refer to exists, names end in their unit.
#include "base/units.hpp"
#include "check_scene.hpp"
#include "keys/key.hpp"
#include "keys/plain_values.hpp"

#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <set>

#include "measure/probes/probes.hpp"

namespace geodrop {
namespace {

/// Bodies, membranes, rigid bodies that move and probes have columns "name.quantity", as the whole has; contacts have
/// "name.name.quantity".
std::vector<std::string> column_owners(const Scene& scene) {
  std::vector<std::string> owners = names_of(scene.bodies);
  const std::vector<std::string> membranes = names_of(scene.membranes);
  owners.insert(owners.end(), membranes.begin(), membranes.end());
  for (const RigidSpec& rigid : scene.rigid)
    if (!std::holds_alternative<std::monostate>(rigid.motion)) owners.push_back(rigid.name);
  for (const ContactSpec& contact : scene.contacts) {
    const ContactPair pair = contact_pair(scene, contact);
    if (pair.kind != ContactPair::Kind::none) owners.push_back(pair.touching + '.' + pair.other);
  }
  for (const std::string& name : names_of(scene.anchors)) owners.push_back(name);
  for (const ProbeSpec& probe : scene.probes) {
    const std::string name = std::visit([](const auto& p) { return p.name; }, probe.probe);
    if (!name.empty()) owners.push_back(name);
  }
  owners.insert(owners.end(), std::begin(kWholeOwners), std::end(kWholeOwners));
  return owners;
}

void check_column(const Scene& scene, const std::string& key, const std::string& column, Report& report) {
  if (!report.healthy(key)) return;
  const std::vector<std::string> parts = split(column, '.');
  const bool formed = parts.size() <= 3 && std::all_of(parts.begin(), parts.end(), is_identifier);
  if (!formed) {
    report.add(key, '"' + column + '"',
               "a column of history.csv: QUANTITY or NAME.QUANTITY, e.g. container.velocity_y_m_s");
  } else if (parts.size() > 1) {
    const std::string owner = column.substr(0, column.rfind('.'));
    check_reference(key, owner, column_owners(scene),
                    "bodies, membranes, moving rigid bodies, contacts, anchors or probes", report);
  }
}

void check_result(const Scene& scene, const ResultSpec& result, const std::string& key, Report& report) {
  if (report.healthy(key + ".name") && unit_of_name(result.name).empty()) {
    report.add(key + ".name", '"' + result.name + '"',
               "a name that ends in its unit, e.g. _m, _m_s, _Pa, _N_m, _s, or _ratio");
  }
  check_column(scene, key + ".column", result.column, report);
  if (result.reduce == Reduction::r_squared) check_column(scene, key + ".against", result.against, report);
  if (report.healthy(key + ".from") && report.healthy(key + ".to") && result.from > result.to) {
    report.add(key + ".to", to_text(result.to), "at least from = " + to_text(result.from) + " [s]");
  }
  const bool lists =
      result.reduce == Reduction::rms_difference && report.healthy(key + ".times") && report.healthy(key + ".values");
  if (lists && (result.times.empty() || result.times.size() != result.values.size())) {
    report.add(key + ".values",
               std::to_string(result.values.size()) + " values for " + std::to_string(result.times.size()) + " times",
               "one value for each time, at least one");
  }
}

/// Windows begin and end with events that are known before.
void check_window(const Scene& scene, std::size_t number, const std::string& key, Report& report) {
  const ResultSpec& result = scene.results[number];
  std::vector<std::string> events;
  for (std::size_t i = 0; i < number; ++i)
    if (scene.results[i].reduce == Reduction::first_time_below) events.push_back(scene.results[i].name);
  for (const auto& [name, event] : {std::pair{".after", result.after}, std::pair{".before", result.before}})
    if (!event.empty() && report.healthy(key + name))
      check_reference(key + name, event, events, "results with reduce = \"first_time_below\" further up", report);
}

/// A known miss needs a guard, or it could get worse unseen.
void check_shortfall(const VerifySpec& verify, const std::string& key, Report& report) {
  if (!report.healthy(key)) return;
  if (!verify.shortfall.empty() && !(verify.guard > verify.target))
    report.add(key + ".guard", to_text(verify.guard),
               "with a shortfall more than its target, " + to_text(verify.target));
  if (verify.shortfall.empty() && verify.guard > 0)
    report.add(key + ".guard", "a guard without a shortfall", "both or none");
}

void check_control(const Scene& scene, const VariantSpec& variant, const std::string& key, Report& report) {
  std::vector<std::string> judged;
  for (const VerifySpec& verify : scene.verify) judged.push_back(verify.result);
  for (const std::string& result : variant.of) check_reference(key + ".of", result, judged, "verify", report);
  if (!variant.control && !(variant.of.empty() && variant.breaks.empty()))
    report.add(key + ".control", "of or breaks in a variant that is no control", "control = true");
  if (variant.control && variant.of.empty() && scene.verify.size() > 1)
    report.add(key + ".of", "none, and several [[verify]]", "the results whose targets the control has to miss");
}

void check_verification(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.variants.size(); ++i)
    check_control(scene, scene.variants[i], report.element("variants", i), report);
  std::set<std::string> judged;
  for (std::size_t i = 0; i < scene.verify.size(); ++i) {
    const std::string& key = report.element("verify", i);
    check_reference(key + ".result", scene.verify[i].result, names_of(scene.results), "results", report);
    if (!scene.verify[i].over.empty())
      check_reference(key + ".over", scene.verify[i].over, names_of(scene.results), "results", report);
    if (report.healthy(key + ".expected") && report.healthy(key + ".scale") && scene.verify[i].expected == 0 &&
        scene.verify[i].scale == 0)
      report.add(key + ".scale", "nothing to divide by, expected is 0", "a scale > 0");
    check_shortfall(scene.verify[i], key, report);
    if (!judged.insert(scene.verify[i].result).second)
      report.add(key + ".result", '"' + scene.verify[i].result + "\", which another [[verify]] judges",
                 "one [[verify]] of a result");
  }
  if (!scene.variants.empty() && scene.verify.empty())
    report.add("variants", "variants without verify", "a [[verify]] that judges them");
}

}  // namespace

void check_measurements(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const ProbeCheck check{scene, report.element("probes", i), report};
    std::visit([&](const auto& probe) { probe.check(check); }, scene.probes[i].probe);
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.results.size(); ++i) {
    const std::string& key = report.element("results", i);
    check_result(scene, scene.results[i], key, report);
    check_window(scene, i, key, report);
    if (!scene.results[i].name.empty() && !names.insert(scene.results[i].name).second) {
      report.add(key + ".name", '"' + scene.results[i].name + "\", the name of another result",
                 "a name that no other result has");
    }
  }
  for (std::size_t i = 0; i < scene.expect.size(); ++i) {
    check_reference(report.element("expect", i) + ".result", scene.expect[i].result, names_of(scene.results), "results",
                    report);
  }
  check_verification(scene, report);
}

}  // namespace geodrop
