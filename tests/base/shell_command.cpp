// The command that is shown when a run was stopped must be the one that goes on with it.
#include "base/shell_command.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

TEST_CASE("a word is quoted only where a shell would change it") {
  CHECK(shell_word("--set") == "--set");
  CHECK(shell_word("grid.spacing=0.125") == "grid.spacing=0.125");
  CHECK(shell_word("../runs/a_b-c") == "../runs/a_b-c");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("my runs") == "'my runs'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("gravity=[0.0, -9.81]") == "'gravity=[0.0, -9.81]'");
  for (const char* special : {"~", "$HOME", "a;b", "a*", "#a", "a\nb", "\"", "a&b", "{a,b}", "`a`", "\\", "!"})
    CHECK(shell_word(special) == std::string("'") + special + "'");
}

TEST_CASE("a run goes on with every argument except those that are for its beginning") {
  CHECK(resume_command({"./geodrop", "run", "my scene.toml", "--set", "a=1", "--threads", "2"}) ==
        "./geodrop run 'my scene.toml' --set a=1 --threads 2 --resume");
  CHECK(resume_command({"geodrop", "run", "--until", "0.5", "a.toml"}) == "geodrop run a.toml --resume");
  CHECK(resume_command({"geodrop", "run", "--until=0.5", "a.toml", "--resume"}) == "geodrop run a.toml --resume");
  CHECK(resume_command({"geodrop", "run", "a.toml", "--overwrite"}) == "geodrop run a.toml --resume");
  CHECK(shell_command({"geodrop", "run", "my scene.toml"}) == "geodrop run 'my scene.toml'");
}
