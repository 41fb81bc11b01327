// Turns a complete TOML scene into plain values.
#pragma once

#include "report.hpp"
#include "toml.hpp"

#include <geodrop/scene.hpp>

namespace geodrop {

/// Keys that are missing because they were wrong leave the default of the member; the report knows them.
Scene bind_scene(const toml::table& complete, const Report& report);

}  // namespace geodrop
