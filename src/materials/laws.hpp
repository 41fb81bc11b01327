// All constitutive laws, for the kernels: each is a pure function of one point (R = double) or one packet of points.
#pragma once

#include "critical_state.hpp"
#include "linear_elastic.hpp"
#include "mohr_coulomb.hpp"
#include "neo_hookean.hpp"
#include "newtonian.hpp"
#include "pore_gas.hpp"
#include "undrained.hpp"
#include "void_memory.hpp"
