// Probes, results, and what these should be.
#include "sections.hpp"

#include "measure/probes/probes.hpp"

namespace geodrop {
namespace {

constexpr Range percent{">= 0 and <= 100", [](double x) { return x >= 0 && x <= 100; }};
constexpr Range end_range{"> 0; inf is the end of the run", [](double x) { return x > 0; }, true};

/// The rows of one kind of probe, where the scene has one of that.
template <class Probe>
void add_rows(std::vector<Key>& keys) {
  for (Key& row : Probe::rows()) {
    if (row.when.empty()) row.when = std::string("type=") + Probe::word;
    row.fill = [fill = row.fill](void* target, const toml::node& node) {
      if (auto* probe = std::get_if<Probe>(&static_cast<ProbeSpec*>(target)->probe)) fill(probe, node);
    };
    keys.push_back(std::move(row));
  }
}

template <class... Probe>
SectionOf<ProbeSpec> section_of(std::type_identity<std::variant<Probe...>>) {
  constexpr RowsOf<ProbeSpec> key;
  static const std::string meanings = [] {
    std::string text;
    ((text += std::string(text.empty() ? "" : "; ") + Probe::word + ": " + Probe::meaning), ...);
    return text;
  }();
  constexpr auto set_name = [](ProbeSpec& spec, const std::string& name) {
    std::visit([&](auto& probe) { probe.name = name; }, spec.probe);
  };
  std::vector<Key> keys{key("type", &ProbeSpec::probe, {{Probe::word, Probe{}}...}, required, meanings),
                        key("name", set_name, required, identifier, "heads the probe's columns in history.csv")};
  (add_rows<Probe>(keys), ...);
  return {"[[probes]]", "name", "What is measured beside the standard columns of history.csv.", R"([[probes]]
name = "foot"
type = "tracer"
position = [0.0, 4.1]

[[probes]]
name = "still"
type = "hydrostatic"
body = "water"
fluid = "water"
surface = 6.0
tips_of = "geotextile")",
          keys};
}

}  // namespace

SectionOf<ProbeSpec> probes_section() { return section_of(std::type_identity<decltype(ProbeSpec::probe)>{}); }

// clang-format off
SectionOf<ResultSpec> results_section() {
  constexpr RowsOf<ResultSpec> key;
  return {
      "[[results]]", "name",
      "Numbers that a run ends with: a column of history.csv reduced to one value.",
      R"([[results]]
name = "time_to_land_s"
column = "bag.lowest_m"
reduce = "first_time_below"
level = 0.0

[[results]]
name = "tension_fall_max_N_m"
column = "geotextile.tension_gauge_N_m"
reduce = "max"
before = "time_to_land_s")", {
      key("name", &ResultSpec::name, required, identifier, "ends in its unit, e.g. fall_velocity_max_m_s"),
      key("column", &ResultSpec::column, required, filled, "a column of history.csv, e.g. container.velocity_y_m_s"),
      key("reduce", &ResultSpec::reduce, {{"last", Reduction::last}, {"min", Reduction::min}, {"max", Reduction::max}, {"mean", Reduction::mean}, {"rms", Reduction::rms}, {"percentile", Reduction::percentile}, {"period", Reduction::period}, {"first_time_below", Reduction::first_time_below}, {"rms_difference", Reduction::rms_difference}, {"r_squared", Reduction::r_squared}, {"slope", Reduction::slope}}, required, "how the column becomes one number; slope: change per second of the straight line that fits best"),
      key("from", &ResultSpec::from, "s", standard("0.0"), not_negative, "rows before are left out"),
      key("to", &ResultSpec::to, "s", standard("inf"), end_range, "rows after are left out"),
      key("after", &ResultSpec::after, standard("\"\""), free_text, "a first_time_below further up: rows before that time are left out, all rows if it never came"),
      key("before", &ResultSpec::before, standard("\"\""), free_text, "likewise: rows after that time are left out, none if it never came"),
      key("scale", &ResultSpec::scale, "", standard("1.0"), not_zero, "factor on the number"),
      key("percentile", &ResultSpec::percentile, "", required, percent, "which percentile").only("reduce=percentile"),
      key("level", &ResultSpec::level, "", required, any, "the level, in the unit of the column").only("reduce=first_time_below"),
      key("against", &ResultSpec::against, required, filled, "the column that is compared with").only("reduce=r_squared"),
      key.reals("times", &ResultSpec::times, "s", required, not_negative, "when to compare").only("reduce=rms_difference"),
      key.reals("values", &ResultSpec::values, "", required, any, "reference values at these times, in the unit of the column").only("reduce=rms_difference"),
  }};
}

SectionOf<ExpectSpec> expect_section() {
  constexpr RowsOf<ExpectSpec> key;
  return {
      "[[expect]]", "result",
      "What a result should be, and says who; a run prints both side by side.",
      R"([[expect]]
result = "fall_velocity_max_m_s"
expected = 2.3
tolerance = 0.2
source = "measured")", {
      key("result", &ExpectSpec::result, required, reference, "a name in results"),
      key("expected", &ExpectSpec::expected, "", required, any, "in the unit of the result"),
      key("tolerance", &ExpectSpec::tolerance, "", required, not_negative, "met if |value - expected| <= tolerance; a largest tension must be in balance as well (docs/step.md, membranes_to_grid)"),
      key("source", &ExpectSpec::source, required, filled, "who says so"),
  }};
}

SectionOf<VerifySpec> verify_section() {
  constexpr RowsOf<VerifySpec> key;
  return {
      "[[verify]]", "result",
      "What `geodrop verify` judges the scene by: a result beside its reference. The error is |value - expected| "
      "over `scale`.",
      R"([[verify]]
result = "fall_velocity_max_m_s"
what = "velocity of the fall"
expected = 2.3
target = 0.1
source = "measured")", {
      key("result", &VerifySpec::result, required, reference, "a name in results"),
      key("over", &VerifySpec::over, standard("\"\""), free_text, "another result that this one is divided by first, e.g. the wave that comes in; empty: none"),
      key("what", &VerifySpec::what, required, filled, "what the error is of, in words"),
      key("expected", &VerifySpec::expected, "", required, any, "in the unit of the result"),
      key("kind", &VerifySpec::kind, {{"reference", ReferenceKind::reference}, {"regression", ReferenceKind::regression}}, standard("\"reference\""), "regression: a result of the code itself, which can only show that something has changed; counted apart"),
      key("scale", &VerifySpec::scale, "", standard("0.0"), not_negative, "what the difference is divided by; 0: |expected|"),
      key("target", &VerifySpec::target, "", required, positive, "met if the error of the last variant is at most this"),
      key("quick_target", &VerifySpec::quick_target, "", standard("0.0"), not_negative, "holds with `--quick`, which stops at a coarser grid; a row that only this one admits counts as coarse, not as met; 0: none"),
      key("least_order", &VerifySpec::least_order, "", standard("0.0"), not_negative, "least order in the grid spacing that the errors of all variants show; not judged by `--quick` if its runs have one spacing; 0: none is asked for"),
      key("source", &VerifySpec::source, required, filled, "who says so"),
      key("shortfall", &VerifySpec::shortfall, standard("\"\""), free_text, "why the target is known to be missed: the row says so, but the command does not fail by it as long as the guard holds"),
      key("guard", &VerifySpec::guard, "", standard("0.0"), not_negative, "largest error that a known miss may have; needed beside `shortfall`. With `--quick` a `quick_target` takes its place"),
      key("loose", &VerifySpec::loose, standard("\"\""), free_text, "why the target is more than three times the error that is measured"),
  }};
}

SectionOf<VariantSpec> variants_section() {
  constexpr RowsOf<VariantSpec> key;
  return {
      "[[variants]]", "",
      "The runs that `geodrop verify` makes of the scene, from coarse to fine; none: one, of the scene as it "
      "stands. The last one that is no control has to meet the targets.",
      R"([[verify]]
result = "fall_velocity_max_m_s"
what = "velocity of the fall"
expected = 2.3
target = 0.1
source = "measured"

[[variants]]
name = "h = 0.25 m"
set = ["grid.spacing=0.25"]

[[variants]]
name = "h = 0.125 m"
set = ["grid.spacing=0.125"]
in = "full")", {
      key("name", &VariantSpec::name, required, filled, "e.g. h = 0.1 m"),
      key("set", &VariantSpec::set, standard("[]"), free_text, "overrides, each as after --set: \"grid.spacing=0.1\""),
      key("in", &VariantSpec::in, {{"quick", VerifyMode::quick}, {"full", VerifyMode::full}, {"both", VerifyMode::both}}, standard("\"both\""), "which of `geodrop verify --quick` and `--full` makes this run"),
      key("control", &VariantSpec::control, standard("false"), "broken on purpose: it has to miss the target of the row that it belongs to"),
      key("of", &VariantSpec::of, standard("[]"), free_text, "results whose targets a control has to miss, each; needed where there are several [[verify]]"),
      key("breaks", &VariantSpec::breaks, standard("\"\""), free_text, "part of the message that a control has to break with; empty: it has to run to its end, with an error above the target"),
  }};
}
// clang-format on

}  // namespace geodrop
