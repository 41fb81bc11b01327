// Pumps: the rest volume of a fluid body grows, so its pressure rises until its membrane gives way.
#pragma once

#include <geodrop/step/pipeline.hpp>

namespace geodrop {

/// Each particle gains mass at the same relative rate, with its own velocity; its volume stays for now, so J falls.
/// Its potential in gravity `g` [m/s2] joins that which the work of gravity is counted from, its energy the budget.
template <int Dim>
void pump_fluid(const std::vector<PumpSpec>& pumps, const Point& g, const StepContext& step, State<Dim>& state);

}  // namespace geodrop
