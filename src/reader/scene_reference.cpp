// The page docs/scene.md, from the table of keys.
#include <geodrop/reader/scene_reader.hpp>

#include "check_value.hpp"
#include "key_table.hpp"

namespace geodrop {
namespace {

constexpr std::string_view kOpening = R"(# The scene file

A scene is one TOML file; units are SI, angles in degrees. This page is made from the rows that the reader checks
against (`src/reader/sections/`), so it says what the program does.

- Every key is checked: an unknown key, a wrong type, a missing key or a value out of range is an error that names the
  file, line and column, the full key, what was found and what is allowed. All are reported at once, slips of TOML in single lines included, but for an open bracket, which hides
  the rest, and for columns of results that do not exist, which are looked for once the rest is right. `geodrop check` finds them without a run.
- Physics has no silent defaults: a key without a default must be given. Keys with a default are numerical, or mean
  "nothing".
- `--set KEY=VALUE` overrides any key: `--set grid.spacing=0.125`, `--set materials.water.viscosity=0`,
  `--set bodies.container.shape.tilt_deg=5`, `--set gravity.1=-1.62`. Elements of lists of tables are addressed by name,
  or by index from 0. The value is TOML; a bare word is a text; an empty value (`--set solver.blend_rate=`) removes the
  key.
- The run directory holds the scene as run: overrides applied, defaults filled in. It can be run again.
- Numbers are finite, unless their row says that they may be `inf`.
- `dimension = 2` is plane strain in x and y, per metre of depth; `dimension = 3` is space. Points have as many numbers as
  the scene has dimensions. The last axis is the vertical one: y in 2D, z in 3D.
- Each section begins with an example, a part of a scene. What it names and does not have (`water`, `sand`, `bag`, `bed`, `geotextile`) is
  in the scene that `geodrop new` writes (of a surface: `geodrop new --from pillow_3d`); a test puts each example into it.

Further checks, across keys: the spacing divides the domain (walls stand on grid lines) along axes without
a zone of finer cells; such a zone lies inside the domain, has finer cells than the grid, and neither periodic walls nor
a second zone on its axis; bodies lie inside the domain,
have area (3D: volume) left, and do not overlap (`minus` cuts one out of another; a half-plane or half-space is cut off
by the domain); names
that are referred to exist; names of bodies, membranes and probes differ, as do those of results; the points of a
membrane lie within a tenth of a cell of its body's outline; `k0` lies within the yield surface of the soil; the
stress at the start fits the material; moduli and density give a sound speed from 1 to 10000 m/s (a guard against MPa
and GPa); an undrained soil has K_f / n of at least 20 times the bulk modulus of its skeleton (Skempton's B of 0.95);
`dilatancy_angle_deg` is at most `friction_angle_deg`; `tension_cutoff` is at most c cot(phi); only fluids shift.

Names of results and of columns of history.csv end in their unit: `_m`, `_s`, `_m_s`, `_m_s2`, `_Pa`, `_N_m`, `_J_m`,
`_rad`, `_deg`, `_ratio` (no unit), `_r_squared` and so on. Each body has, under its name, `position_*_m` and
`velocity_*_m_s` of its centre of mass along each axis, `rotation_deg`, `mean_pressure_centre_Pa`,
`vertical_stress_centre_Pa`, `horizontal_stress_centre_Pa`, `velocity_rms_m_s`, and the extremes of its particles,
`lowest_m`, `highest_m`, `leftmost_m`, `rightmost_m`, `height_m`, `width_m` (along x). In 3D the rotation is `rotation_x_deg`, `rotation_y_deg`,
`rotation_z_deg`, the components of axis times angle (at most 180 degrees), the horizontal stresses are
`horizontal_stress_x_centre_Pa` and `horizontal_stress_y_centre_Pa`, and `frontmost_m` and `backmost_m` are the extremes
along y. Energies, masses and momenta are per metre of depth in 2D.
)";

std::string escape_bars(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.replace(at, 1, "\\|");
  return text;
}

std::string need_text(const Key& key) {
  switch (key.need.how) {
    case Need::How::required:
      return "required";
    case Need::How::standard:
      return "`" + std::string(key.need.text) + "`";
    case Need::How::derived:
      return std::string(key.need.text);
    case Need::How::instead_of:
      return "this or `" + std::string(key.need.text) + "`";
  }
  return {};
}

std::string row(const Key& key) {
  constexpr int kEither = 0;
  // The unit stands in a column of its own.
  Key without_unit = key;
  without_unit.unit = {};
  const std::string when = readable_condition(key);
  const std::string former = key.former.empty() ? "" : "; formerly `" + std::string(key.former) + "`";
  const std::string unit = key.unit.empty() ? "" : std::string(key.unit);
  return "| `" + std::string(key.name) + "` | " + describe_allowed(without_unit, kEither) + " | " + unit + " | " +
         need_text(key) + " | " + when + " | " + escape_bars(std::string(key.meaning)) + former + " |\n";
}

}  // namespace

std::string scene_reference_markdown() {
  std::string page(kOpening);
  for (const Section* section : section_table()) {
    page += "\n## " + std::string(section->heading) + "\n\n" + std::string(section->about) + "\n\n";
    page += "```toml\n" + std::string(section->example) + "\n```\n\n";
    page += "| key | value | unit | default | only with | meaning |\n|---|---|---|---|---|---|\n";
    for (const Key& key : section->keys) page += row(key);
  }
  return page;
}

}  // namespace geodrop
