// What a probe consists of. A probe is a struct in a file of its own:
//
//   word, meaning   of the choice `type`, for the scene and its page
//   members         its name and parameters
//   rows()          the keys of its parameters
//   check()         what they refer to
//   list()          its columns of history.csv, for the dimensions that it is for; without a state only their names
//   count
//
// and stands in the list of probes.hpp, from which reading, checking, the page and history.csv follow.
#pragma once

#include <geodrop/base/find_named.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include "keys/references.hpp"
#include "keys/rows.hpp"
#include "keys/to_text.hpp"
#include "measure/history_row.hpp"

namespace geodrop {

/// The checks that probes share.
struct ProbeCheck {
  const Scene& scene;
  const std::string& key;  ///< of the probe
  Report& report;

  bool body(const std::string& name) const {
    return check_reference(key + ".body", name, names_of(scene.bodies), "bodies", report);
  }
  bool membrane(const std::string& name, const char* where = ".membrane") const {
    return check_reference(key + where, name, names_of(scene.membranes), "membranes", report);
  }
  bool fluid(const std::string& name, const char* where) const { return check_fluid(scene, key + where, name, report); }
  /// For probes of the plane.
  void plane(const std::string& word) const {
    if (report.healthy("dimension") && scene.dimension != 2)
      report.add(key + ".type", '"' + word + "\" in space", word + "s in two dimensions");
  }
  /// For probes of space.
  void space(const std::string& word, const std::string& words) const {
    if (report.healthy("dimension") && scene.dimension != 3)
      report.add(key + ".type", '"' + word + "\" in the plane", words + " in three dimensions");
  }
};

}  // namespace geodrop
