// Debug builds see that a row leaves alone what it does not say that it writes; release builds pay nothing.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include <geodrop/grid/row.hpp>

namespace geodrop {

#ifdef NDEBUG
inline constexpr bool checks_writes = false;
#else
inline constexpr bool checks_writes = true;
#endif

/// Steps from one check to the next, after the first two steps: hashes cost as much as some steps.
inline constexpr std::uint64_t write_check_interval = 64;

/// Throws std::logic_error that names the row and what it changed unsaid.
template <int Dim>
void check_writes(const Row<Dim>& row, DataSet changed) {
  changed.bits &= ~row.writes.bits;
  if (changed.bits != 0)
    throw std::logic_error("row " + row.name + " changes what it does not say that it writes: " + names_of(changed));
}

/// Before a row, and after it (`end`).
template <int Dim>
class WriteCheck {
 public:
  WriteCheck(const Row<Dim>& row, const State<Dim>& state, const Grids<Dim>& grids) : row_(&row) {
    if constexpr (checks_writes)
      if (state.step < 2 || state.step % write_check_interval == 0) before_ = hashes_of(state, grids);
  }
  void end(const State<Dim>& state, const Grids<Dim>& grids) const {
    if constexpr (checks_writes)
      if (before_) check_writes(*row_, changed_data(*before_, hashes_of(state, grids)));
  }

 private:
  const Row<Dim>* row_;
  std::optional<DataHashes> before_;
};

}  // namespace geodrop
