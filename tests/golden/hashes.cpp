// The hash of the state at the end of short scenes that have each feature in one of them: a change of results is seen
// in the commit that makes it. After a change that is meant to, GEODROP_TAKE_HASHES=1 writes hashes.csv anew.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "base/levels.hpp"
#include "support/golden.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// The file with the hash of each scene for these sums; those for others stay.
void write_golden(const std::vector<Golden>& all) {
  std::ofstream file(golden_path());
  file << "case,scene,overrides,sums,hash\n";
  for (const Golden& golden : all)
    file << golden.name() << ',' << golden.scene() << ',' << golden.overrides() << ',' << golden.sums() << ','
         << golden.hash() << '\n';
}

}  // namespace

TEST_CASE("Golden hashes: the same states as ever, on one thread and on two") {
  const std::string sums = geodrop::kernel_arithmetic();
  const bool take = std::getenv("GEODROP_TAKE_HASHES") != nullptr;
  const bool once = std::getenv("GEODROP_ONE_RUN") != nullptr;  // under sanitizers, which look at two threads
  std::vector<Golden> all = read_golden();
  const bool known = std::any_of(all.begin(), all.end(), [&](const Golden& golden) { return golden.sums() == sums; });
  REQUIRE(all.size() >= 12);
  if (!known) MESSAGE("no hashes are known for sums that are " << sums << "; only threads are compared");
  std::string done;
  std::vector<Golden> taken;
  for (const Golden& golden : all) {
    const bool first = golden.name() != done;  // lines of a scene stand together, one for each kind of sums
    done = golden.name();
    if (known && golden.sums() != sums) continue;
    if (!known && !first) continue;
    CAPTURE(golden.name());
    SceneRun run(golden.scene(), settings_of(golden), {"--threads", "2"});
    REQUIRE(run.outcome().code == 0);
    const std::string hash = run.hash();
    if (!once) CHECK(run.again({"--threads", "1"}).code == 0);
    CHECK(run.hash() == hash);
    if (known && !take) CHECK(hash == golden.hash());
    taken.push_back({{golden.name(), golden.scene(), golden.overrides(), sums, hash}});
  }
  if (!take) return;
  std::erase_if(all, [&](const Golden& golden) { return golden.sums() == sums || golden.sums().empty(); });
  all.insert(all.end(), taken.begin(), taken.end());
  std::stable_sort(all.begin(), all.end(), [&](const Golden& a, const Golden& b) { return a.name() < b.name(); });
  write_golden(all);
}
