// From verdicts to totals and tables.
#include "verify/report.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/text.hpp"

using namespace geodrop;

namespace {

const VariantRun one_run = [] {
  VariantRun run;
  run.spacing = 0.1;
  return run;
}();

VerifyRow row(Verdict verdict, double error = 0.01, double bar = 0.02) {
  VerifyRow one;
  one.scene = "tower";
  one.what = "height";
  one.source = "a ruler";
  one.runs = {&one_run};
  one.values = {1 + error};
  one.errors = {error};
  one.target = one.bar = bar;
  one.verdict = verdict;
  return one;
}

VerifyRow regression(Verdict verdict) {
  VerifyRow one = row(verdict);
  one.kind = ReferenceKind::regression;
  return one;
}

VerifyRow control(Verdict verdict) {
  VerifyRow one = row(verdict);
  one.control = true;
  one.misses = "height";
  return one;
}

}  // namespace

TEST_CASE("Totals count each verdict apart, and regressions and controls apart from references") {
  const std::vector<VerifyRow> rows{row(Verdict::met),           row(Verdict::met),           row(Verdict::coarse),
                                    row(Verdict::guarded),       row(Verdict::missed),        regression(Verdict::met),
                                    regression(Verdict::coarse), regression(Verdict::missed), control(Verdict::met),
                                    control(Verdict::missed)};
  CHECK(verify_totals(rows) ==
        "2 of 5 targets met, 1 coarse: within their quick target, 1 known to be missed, guarded, 1 missed; "
        "2 of 3 regressions hold; 1 of 2 controls miss the target of their row as they must");
}

TEST_CASE("Loose targets are counted, and those that the scene gives no reason for told apart") {
  VerifyRow reasoned = row(Verdict::met, 0.01, 0.05), bare = reasoned, controlled = row(Verdict::met);
  reasoned.loose = "round-off";
  controlled.controlled = true;
  const std::vector<VerifyRow> rows{reasoned, bare, controlled, control(Verdict::met)};
  CHECK(slack_totals(rows) ==
        "2 of 3 targets are more than three times the error, 1 of them for a reason that the scene gives; "
        "1 of 3 have a control that has to miss them");
  const std::string page = rows_markdown(rows);
  CHECK(test::contains(page, "- **tower**, height: round-off\n- **tower**, height: no reason given\n"));
  CHECK(test::contains(page, "| <= 0.05 | 5.0 |"));
}

TEST_CASE("The table shows what a row is held to, and by what kind of reference") {
  VerifyRow coarse = row(Verdict::coarse);
  coarse.target = 0.005;
  coarse.least_order = 1.8;
  CHECK(test::contains(rows_markdown({coarse}), "| <= 0.02 (0.005), order 1.8 not judged | 2.0 |"));
  CHECK(test::contains(rows_markdown({coarse}), "| **coarse** |"));
  coarse.judges_order = true;
  CHECK(test::contains(rows_markdown({coarse}), "| <= 0.02 (0.005), order 1.8 | 2.0 |"));
  CHECK(test::contains(rows_markdown({regression(Verdict::met)}), "| regression, 0: a ruler |"));
  CHECK(test::contains(rows_markdown({control(Verdict::met)}), "| has to miss: height |"));
  VerifyRow known = row(Verdict::guarded);
  known.shortfall = "too short";
  CHECK(test::contains(cases_markdown({known}), "Known to be missed, and guarded:\n- **tower**, height: too short"));
  CHECK(test::contains(rows_markdown({known}), "| **known, guarded** |"));
}

TEST_CASE("The summary has a line for each case: its worst verdict, then the error nearest to its target") {
  VerifyRow easy = row(Verdict::met, 0.001), hard = row(Verdict::met, 0.015), bridge = row(Verdict::met, 0.019);
  hard.what = "width";
  hard.errors = {0.06, 0.015};
  hard.order = 2;
  bridge.scene = "bridge";
  const std::string both = cases_markdown({easy, hard, control(Verdict::met), control(Verdict::missed), bridge});
  CHECK(test::contains(both,
                       "| tower | width | 0.015 | 2.0 | <= 0.02 | yes | 2 of 2 | 1 of 2 |\n"
                       "| bridge | height | 0.019 | 0.0 | <= 0.02 | yes | 1 of 1 | 0 of 0 |\n"));
  VerifyRow guarded = row(Verdict::guarded, 0.021, 0.03);
  guarded.target = 0.02;
  CHECK(test::contains(cases_markdown({bridge, guarded, row(Verdict::missed, 0.0201), hard}),
                       "| tower | height | 0.0201 | 0.0 | <= 0.02 | **NO** | 1 of 3 | 0 of 0 |\n"));
  CHECK(test::contains(cases_markdown({guarded, hard}),
                       "| tower | height | 0.021 | 0.0 | <= 0.03 (0.02) | **known, guarded** | 1 of 2 | 0 of 0 |\n"));
}

TEST_CASE("A case that breaks is its hardest measure; one of controls alone has no line in the summary") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VerifyRow broken = row(Verdict::missed, nan);
  broken.what = "width";
  const std::string text = cases_markdown({row(Verdict::missed, 7), broken});
  CHECK(test::contains(text, "| tower | width | breaks | 0.0 | <= 0.02 | **NO** | 0 of 2 | 0 of 0 |\n"));
  CHECK_FALSE(test::contains(cases_markdown({control(Verdict::met)}), "tower"));
}

TEST_CASE("The page of all rows names the page that it belongs to") {
  const std::string page = rows_page({row(Verdict::met)}, "verification.md");
  CHECK(test::contains(page, "[verification.md](../verification.md)"));
  CHECK(test::contains(page, rows_markdown({row(Verdict::met)})));
}
