// What of a scene a run cannot change its mind about: all but when it ends, what it writes and what it is judged by.
#pragma once

#include <string>

namespace geodrop {

/// A scene as run (Scene::as_run) without title, question, time.end, [output], [checkpoints], [[results]], [[expect]],
/// [[verify]] and
/// [[variants]].
std::string lasting_text(const std::string& as_run);

/// The first key in which two such texts differ, e.g. "materials.water.density = 1000.0, here 1025.0"; empty: none.
std::string first_difference(const std::string& there, const std::string& here);

}  // namespace geodrop
