// Rows of contacts at sharp membranes: what they say, the system that their tractions solve, and what becomes of these.
#pragma once

#include <array>
#include <vector>

#include "interface_contacts.hpp"
#include "interface_rows.hpp"
#include "traction_basis.hpp"
#include "traction_solver.hpp"

namespace geodrop {

/// What a contact says, as rows can take it. That along the membrane is the normal one, turned.
template <int Dim>
struct RowsOfContact {
  RawRow<Dim> normal, through, grains;

  /// That which friction follows.
  const RawRow<Dim>& rubbed(const Contact<Dim>& contact) const { return contact.on_grains ? grains : normal; }
};

/// Those of all contacts.
template <int Dim>
std::vector<RowsOfContact<Dim>> rows_of(const Grids<Dim>& grids, const std::vector<Contact<Dim>>& contacts);

/// Rows for some of the contacts.
template <int Dim>
class ContactRows {
 public:
  explicit ContactRows(const Grids<Dim>& grids) : rows_(grids) {}

  /// False if one of the sides has no mass there.
  bool add(const RawRow<Dim>& row, std::size_t c, Says says) {
    const bool complete = rows_.add(row);
    if (complete) list_.push_back({c, says});
    return complete;
  }

  Rows<Dim>& rows() { return rows_; }
  const std::vector<RowOfContact>& list() const { return list_; }

 private:
  Rows<Dim> rows_;
  std::vector<RowOfContact> list_;
};

/// What the rows along a membrane say.
template <int Dim>
constexpr auto tangents() {
  if constexpr (Dim == 2)
    return std::array{Says::tangent};
  else
    return std::array{Says::tangent, Says::second_tangent};
}

/// The row along an outline, from the one normal to it. In space what of it faces the mean normal of the stretch, made
/// as large as the area.
RawRow<2> along(const Contact<2>& contact, Says says, const RawRow<2>& normal);
RawRow<3> along(const Contact<3>& contact, Says says, RawRow<3> normal);

/// Adds up the tractions of rows on the segments or triangles of membranes.
template <int Dim>
void store(const ContactRows<Dim>& rows, const Eigen::VectorXd& traction, const Grids<Dim>& grids,
           std::vector<Contact<Dim>>& contacts);

/// The system of rows E, without the flow through the membrane. dragged: E K, K the drag of pores/pores, which follows:
/// the rows ask for velocities after it; E itself where nothing drags. by_place: E. velocity_rate: M^1/2 v / dt.
template <int Dim>
System system_of(const NodeRows<Dim>& dragged, const ByPlace<Dim>& by_place, const Eigen::VectorXd& velocity_rate);

}  // namespace geodrop
