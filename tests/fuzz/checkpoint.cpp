// Checkpoints that were changed at random, as accidents do and, with the checksum made right again, as a faulty or
// hostile writer could: refused with the reason, or a state that runs on for a millisecond.
#include "fuzz/fuzz.hpp"
#include "fuzz/mutate_text.hpp"
#include "step/check_resumable.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/files/checkpoint.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>

#include <xxhash.h>

#include <cstring>
#include <map>

using namespace geodrop;

namespace {

/// A run that was stopped, its checkpoint as bytes, and what the scene builds.
template <int Dim>
struct Stopped {
  Scene scene;
  State<Dim> built;
  std::string bytes;
};

template <int Dim>
Stopped<Dim> stop(const std::string& file, const std::vector<std::string>& settings, int steps) {
  Stopped<Dim> run{read_scene(source_path(file), settings), {}, {}};
  run.built = build_state<Dim>(run.scene);
  State<Dim> state = run.built;
  Grids<Dim> grids = make_grids<Dim>(run.scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(run.scene);
  HistoryTable history{history_columns(run.scene), {}};
  for (int i = 0; i < steps; ++i) {
    history.rows.push_back(history_row(run.scene, state, history));
    advance(pipeline, state, grids);
  }
  const TemporaryDirectory directory;
  write_checkpoint(directory / "checkpoint.bin", run.scene, state, {{0.0}, history.rows});
  run.bytes = read_file(directory / "checkpoint.bin");
  return run;
}

/// Between them all parts that a state has.
const std::vector<Stopped<2>>& runs() {
  static const std::vector<Stopped<2>> all = [] {
    std::vector<Stopped<2>> list;
    list.push_back(stop<2>("cases/dump_kekerdom.toml", {"grid.spacing=1.0", "grid.refine=[]"}, 3));
    list.push_back(stop<2>("tests/scenes/tube.toml", {"grid.spacing=0.2"}, 5));
    list.push_back(stop<2>("tests/scenes/round_pulse.toml", {"grid.spacing=0.5"}, 3));
    list.push_back(stop<2>("tests/scenes/viscous_bed.toml", {}, 3));
    list.push_back(stop<2>("tests/scenes/ramp.toml", {}, 40));
    list.push_back(stop<2>("tests/scenes/block_on_slab.toml",
                           {"stages=[{name='slab',from=0.0},{name='both',from=0.001,places=['block']}]",
                            "probes=[{name='rider',type='tracer',position=[2.0,1.5]}]"},
                           12));
    return list;
  }();
  return all;
}

/// A word where one of the file may be: what lengths, numbers of fields and coordinates should never be.
std::uint64_t odd_word(fuzz::Chance& chance) {
  const std::uint64_t words[] = {0,
                                 1,
                                 2,
                                 255,
                                 256,
                                 65535,
                                 0x7fffffff,
                                 0x80000000,
                                 0xffffffff,
                                 1ULL << 32,
                                 1ULL << 40,
                                 1ULL << 60,
                                 1ULL << 63,
                                 ~0ULL,
                                 0x7ff8ULL << 48,
                                 0x7ff0ULL << 48,
                                 0xfff0ULL << 48,
                                 0x7fe0ULL << 48};
  return chance.one_in(4) ? chance.number() : words[chance.below(std::size(words))];
}

/// A place in the file, often one of a length or a number: a word of eight bytes below a million.
std::size_t some_place(const std::string& bytes, fuzz::Chance& chance) {
  std::size_t at = chance.below(bytes.size() - 8);
  for (int tries = 0; tries < 2000 && !chance.one_in(1000); ++tries, at = (at + 1) % (bytes.size() - 8)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    if (word > 0 && word < 1000000) break;
  }
  return at;
}

void change(std::string& bytes, fuzz::Chance& chance) {
  const std::size_t at = chance.one_in(2) ? some_place(bytes, chance) : chance.below(bytes.size() - 8);
  switch (chance.below(8)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, 1 + chance.below(64));
      break;
    case 2:
      bytes.insert(at, std::string(1 + chance.below(64), static_cast<char>(chance.below(256))));
      break;
    case 3:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << chance.below(8)));
      break;
    case 4:
      bytes[at] = static_cast<char>(chance.below(256));
      break;
    default: {
      const std::uint64_t word = odd_word(chance);
      std::memcpy(bytes.data() + at, &word, chance.one_in(2) ? sizeof word : sizeof(std::uint32_t));
    }
  }
}

void make_checksum_right(std::string& bytes) {
  if (bytes.size() < sizeof(std::uint64_t)) return;
  const std::size_t length = bytes.size() - sizeof(std::uint64_t);
  const std::uint64_t sum = XXH3_64bits(bytes.data(), length);
  std::memcpy(bytes.data() + length, &sum, sizeof sum);
}

/// Goes on as a resumed run would.
void go_on(const Scene& scene, State<2> state) {
  constexpr double millisecond = 1e-3;
  constexpr int most_steps = 5;
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  const double end = state.t + millisecond;
  HistoryTable history{history_columns(scene), {}};
  for (int i = 0; i < most_steps && state.t < end; ++i) {
    advance(pipeline, state, grids);
    history.rows.push_back(history_row(scene, state, history));
  }
}

std::string attempt(const std::filesystem::path& path, const Stopped<2>& run) {
  try {
    const Checkpoint<2> checkpoint = read_checkpoint<2>(path, run.scene);
    if (!fault_in_state(run.scene, run.built, checkpoint.state).empty()) return "refused by their state";
    go_on(run.scene, checkpoint.state);
    return "ran";
  } catch (const SceneError& error) {
    return error.problems().at(0).found.empty() ? "failed: no reason" : "refused";
  } catch (const RunError&) {
    return "broke in a step";
  }
}

/// `summed`: the checksum is made right again.
enum class Sum { left, summed };

void try_changes(const std::string& what, std::uint64_t in_ci, Sum sum) {
  const std::vector<Stopped<2>>& all = runs();
  fuzz::Trials trials(what, in_ci);
  std::size_t chosen = 0;
  trials.run(
      ".bin",
      [&](fuzz::Chance& chance) {
        chosen = chance.below(all.size());
        std::string bytes = all[chosen].bytes;
        for (std::size_t i = 0; i <= chance.below(3) && bytes.size() > 16; ++i) change(bytes, chance);
        if (sum == Sum::summed) make_checksum_right(bytes);
        return bytes;
      },
      [&](const std::filesystem::path& path, fuzz::Chance&) {
        const std::string became = attempt(path, all[chosen]);
        if (sum == Sum::left && became == "ran" && read_file(path) != all[chosen].bytes)
          return std::string("failed: a changed file was taken");
        return became;
      });
}

}  // namespace

TEST_CASE("Checkpoints that an accident changed are refused") { try_changes("checkpoint", 10000, Sum::left); }

TEST_CASE("Checkpoints with another content and a right checksum are refused or run on") {
  try_changes("checkpoint_summed", 20000, Sum::summed);
}

TEST_CASE("Checkpoints that nobody changed are taken by the scenes that wrote them, and by no other") {
  const TemporaryDirectory directory;
  for (const Stopped<2>& run : runs()) {
    CAPTURE(run.scene.file);
    std::ofstream(directory / "checkpoint.bin", std::ios::binary) << run.bytes;
    CHECK(attempt(directory / "checkpoint.bin", run) == "ran");
    for (const Stopped<2>& other : runs())
      CHECK((attempt(directory / "checkpoint.bin", other) == "ran") == (&other == &run));
  }
}
