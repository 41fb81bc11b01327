// A checkpoint is the state bit for bit, or it is refused with the reason.
#include <geodrop/base/error.hpp>
#include <geodrop/files/checkpoint.hpp>

#include "support/scene_files.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace geodrop;

namespace {

/// Numbers that survive only a copy of bits: a NaN, a negative zero, the smallest of all.
State<2> odd_state() {
  State<2> state = small_state();
  state.t = 0.1 + 0.2;
  state.step = 123456789012345;
  state.drift = -1;
  state.v_max = std::numeric_limits<double>::denorm_min();
  state.bodies[1].v[0][2] = -0.0;
  state.bodies[1].stress[3][1] = std::nan("17");
  state.bodies[0].slab_begin = {0, 2, 4};
  return state;
}

/// Two rows as wide as those of the scene, with a NaN.
OutputRecord small_record() {
  OutputRecord record{{0, 0.25}, {2, std::vector<double>(history_columns(small_scene()).size(), 1.0 / 3)}};
  record.rows[0][0] = 0;
  record.rows[1] = std::vector<double>(record.rows[0].size(), std::nan(""));
  record.rows[1][0] = 0.25;
  return record;
}
const OutputRecord record = small_record();

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// What reading says that was found; "" if nothing was wrong.
std::string refusal(const std::filesystem::path& path, const Scene& scene) {
  try {
    read_checkpoint<2>(path, scene);
  } catch (const SceneError& error) {
    return error.problems().at(0).found;
  }
  return "";
}

}  // namespace

TEST_CASE("a checkpoint gives back every bit") {
  const TemporaryDirectory directory;
  const Scene scene = small_scene();
  const State<2> state = odd_state();
  write_checkpoint(directory / "checkpoint.bin", scene, state, record);
  const Checkpoint<2> back = read_checkpoint<2>(directory / "checkpoint.bin", scene);
  CHECK(state_hash(back.state) == state_hash(state));
  CHECK(back.state.step == state.step);
  CHECK(back.state.bodies[1].name == "bag");
  CHECK(back.state.bodies[1].x == state.bodies[1].x);
  CHECK(std::get<MohrCoulomb>(back.state.bodies[1].material).pore_stiffness == 2e7);
  CHECK(std::signbit(back.state.bodies[1].v[0][2]));
  CHECK(back.state.membranes[0].tension == state.membranes[0].tension);
  CHECK(back.output.frame_times == record.frame_times);
  CHECK(back.output.rows[0] == record.rows[0]);
  write_checkpoint(directory / "again.bin", scene, back.state, back.output);
  CHECK(read_file(directory / "again.bin") == read_file(directory / "checkpoint.bin"));
  CHECK_FALSE(std::filesystem::exists(directory / "checkpoint.bin.part"));
}

TEST_CASE("the hash sees a change of any value") {
  const std::vector<std::function<void(State<2>&)>> changes = {
      [](State<2>& s) { s.t = std::nextafter(s.t, 1); },
      [](State<2>& s) { ++s.step; },
      [](State<2>& s) { s.drift = 0.5; },
      [](State<2>& s) { s.v_max *= 2; },
      [](State<2>& s) { s.bodies[0].x[1][3] = std::nextafter(s.bodies[0].x[1][3], 1); },
      [](State<2>& s) { s.bodies[0].v[0][0] = -0.0; },
      [](State<2>& s) { s.bodies[0].affine[3][0] = 1; },
      [](State<2>& s) { s.bodies[0].mass[0] = 1; },
      [](State<2>& s) { s.bodies[0].J[0] = 1.1; },
      [](State<2>& s) { s.bodies[1].stress[2][0] = 1; },
      [](State<2>& s) { s.bodies[1].pore_pressure[0] = 1; },
      [](State<2>& s) { s.bodies[1].deviatoric_strain[0] = 1; },
      [](State<2>& s) {
        s.bodies[1].gap = {1e-3, 0, 0, 0};
      },
      [](State<2>& s) { std::swap(s.bodies[1].id[0], s.bodies[1].id[1]); },
      [](State<2>& s) { s.bodies[1].initial_x[0][1] = 9; },
      [](State<2>& s) { s.bodies[1].layer[0] = 9; },
      [](State<2>& s) { s.membranes[0].x[0][0] = 9; },
      [](State<2>& s) { s.membranes[0].v[1][0] = 9; },
      [](State<2>& s) { s.membranes[0].strain[0] = 9; },
      [](State<2>& s) { s.membranes[0].gauge.peak = 9; },
      [](State<2>& s) { s.tracers[0].v[1] = 9; },
  };
  const std::string original = state_hash(odd_state());
  CHECK(original.size() == 16);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    State<2> state = odd_state();
    changes[i](state);
    CHECK(state_hash(state) != original);
  }
}

TEST_CASE("what cannot be resumed is refused with its reason") {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "checkpoint.bin";
  const Scene scene = small_scene();
  CHECK(refusal(path, scene) == "no such file");

  write_checkpoint(path, scene, odd_state(), record);
  const std::string whole = read_file(path);
  CHECK(refusal(path, scene) == "");

  Scene other = scene;
  other.as_run += "[grid]\nspacing = 2.0\n";
  CHECK(refusal(path, other) == "a checkpoint of another scene: no grid, here it is");
  CHECK_THROWS_AS(read_checkpoint<3>(path, scene), SceneError);

  for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{40}}) {
    write_text(path, whole.substr(0, length));
    CHECK(refusal(path, scene) == "a truncated or damaged checkpoint (checksum differs)");
  }
  for (const std::size_t at : {std::size_t{20}, std::size_t{100}, whole.size() / 2, whole.size() - 3}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write_text(path, damaged);
    CHECK(refusal(path, scene) == "a truncated or damaged checkpoint (checksum differs)");
  }
  std::string later = whole;
  later[8] = 99;
  write_text(path, later);
  CHECK(refusal(path, scene) == "checkpoint format 99");
  for (const std::string& text : {std::string(), std::string("geodrop"), std::string("particles of another program")}) {
    write_text(path, text);
    CHECK(refusal(path, scene) == "not a checkpoint");
  }
}

TEST_CASE("a checkpoint that cannot be written leaves the one before") {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "checkpoint.bin";
  write_checkpoint(path, small_scene(), small_state(), record);
  const std::string before = read_file(path);
  std::filesystem::create_directory(directory / "checkpoint.bin.part");  // in the way
  CHECK_THROWS_AS(write_checkpoint(path, small_scene(), odd_state(), record), RunError);
  CHECK(read_file(path) == before);
}
