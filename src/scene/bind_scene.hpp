// Turns a complete TOML scene into plain values.
#pragma once

#include <toml++/toml.h>

#include <geodrop/scene.hpp>

#include "report.hpp"

namespace geodrop {

/// Keys that are missing because they were wrong leave the default of the member; the report knows them.
Scene bind_scene(const toml::table& complete, const Report& report);

}  // namespace geodrop
