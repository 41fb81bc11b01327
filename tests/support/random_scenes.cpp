#include "support/random_scenes.hpp"

#include <algorithm>
#include <numbers>

namespace geodrop::test {

std::string RandomScene::text() const {
  const std::string mass = sharp_ && !mass_matrix_.empty() ? mass_matrix_ + "_at_membranes" : mass_matrix_;
  std::string all = "title = \"Random\"\n" + head_ + (mass.empty() ? "" : "mass_matrix = \"" + mass + "\"\n") + grid_ +
                    "[time]\nend = 10.0\n[output]\nframe_interval = 1.0\n" + "history_interval = 1.0\n" + walls_ +
                    zone_;
  for (Tables tables : {materials_, bodies_, membranes_, rigid_, contacts_, more_}) {
    if (image_.reversed) std::reverse(tables.begin(), tables.end());
    for (const std::string& table : tables) all += table;
  }
  return all;
}

std::string RandomScene::points(const std::vector<Pair>& list) const {
  std::string all;
  for (const Pair& x : list) all += (all.empty() ? "[" : ", ") + point(x);
  return all + "]";
}

std::string RandomScene::box(const Pair& lower, const Pair& upper, bool braces) const {
  const Pair a = moved(lower), b = moved(upper);
  const std::string corners = "lower = " + pair({std::min(a[0], b[0]), std::min(a[1], b[1])}) + (braces ? ", " : "\n") +
                              "upper = " + pair({std::max(a[0], b[0]), std::max(a[1], b[1])});
  return braces ? "{ type = \"box\", " + corners + " }" : corners + "\n";
}

void RandomScene::draw() {
  h_ = pick<double>({0.125, 0.25});
  steps_ = static_cast<int>(uniform(20, 40));
  upper_ = {h_ * std::floor(uniform(12, 17)), h_ * std::floor(uniform(10, 15))};
  draw_solver();
  draw_walls();
  const double size = uniform(1.3, 1.9) * h_;
  const Pair centre{upper_[0] / 2 + uniform(-1, 1) * h_, upper_[1] / 2 + uniform(0, 2) * h_};
  immersed_ = chance(0.3);
  draw_block("block", centre, size);
  if (chance(0.4)) {
    const double other = uniform(1.2, 1.6) * h_, angle = uniform(-0.4, 0.4), apart = size + other + 0.03 * h_;
    draw_block("stone", {centre[0] + apart * std::cos(angle), centre[1] + apart * std::sin(angle)}, other);
  }
  if (touching_.size() == 2 && membranes_.size() == 2 && chance(0.7)) draw_contact("block_skin", "stone_skin");
  if (!periodic_ && !immersed_ && chance(0.6))
    draw_rigid(centre, size);
  else if (immersed_ || chance(0.8))
    draw_pool();
  draw_extras();
}

void RandomScene::draw_solver() {
  const double kind = uniform(0, 1);
  basis_ = with(kind < 0.45 ? "bspline2" : kind < 0.65 ? "gimp" : kind < 0.85 ? "linear" : "tri3");
  transfer_ = basis_ == "tri3" ? "musl" : pick<std::string>({"tpic", "blend", "musl"});
  with(transfer_);
  Pair gravity{0, -9.81};
  enclosed_ = basis_ == "bspline2" && chance(0.15);
  if (!enclosed_ && chance(0.3)) gravity = {uniform(-5, 5), uniform(-5, 5)};
  head_ = "gravity = " + vector(gravity) + "\n[solver]\ntransfer = \"" + transfer_ + "\"\n";
  if (transfer_ != "tpic") head_ += "blend_rate = " + number(pick<double>({0, 5, 50})) + "\n";
  if ((basis_ == "bspline2" || basis_ == "linear") && chance(0.2)) mass_matrix_ = with("consistent");
  if (chance(0.1))
    more_.push_back("[[stages]]\nname = \"first\"\nfrom = 0.0\ndamping_rate = " + number(uniform(1, 20)) + "\n"),
        with("stage");
  else if (chance(0.2))
    head_ += "damping_rate = " + number(uniform(1, 10)) + "\n";
  if (chance(0.3)) head_ += "courant = " + number(uniform(0.2, 0.7)) + "\n";
  grid_ = "[grid]\n" + box({0, 0}, upper_, false) + "spacing = " + number(h_) + "\nbasis = \"" + basis_ + "\"\n";
}

void RandomScene::draw_walls() {
  periodic_ = !enclosed_ && chance(0.15);
  std::array<std::string, 4> kinds;  // left, right, bottom, top
  for (std::string& kind : kinds) kind = pick<std::string>({"slip", "no_slip"});
  if (periodic_) {
    const int axis = chance(0.5);
    kinds[2 * axis] = kinds[2 * axis + 1] = with("periodic");
  }
  const std::array<Pair, 4> outward{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const std::array<std::string, 4> names{"left", "right", "bottom", "top"};
  walls_ = "[walls]\n";
  for (int k = 0; k < 4; ++k)
    walls_ += names[std::find(outward.begin(), outward.end(), image_.vector(outward[k])) - outward.begin()] + " = \"" +
              kinds[k] + "\"\n";
  if (basis_ != "bspline2" || periodic_ || enclosed_ || !chance(0.25)) return;
  const int axis = chance(0.5);
  Pair from{0, 0}, to{0, 0};
  from[axis] = uniform(3, 5) * h_;
  to[axis] = from[axis] + uniform(1, 3) * h_;
  const Pair a = moved(from), b = moved(to);
  const int along = image_.turn[axis] != 0 ? 0 : 1;  // column `axis` of the turn
  zone_ = "[[grid.refine]]\naxis = \"" + std::string(along == 0 ? "x" : "y") +
          "\"\nfrom = " + number(std::min(a[along], b[along])) + "\nto = " + number(std::max(a[along], b[along])) +
          "\nspacing = " + number(0.5 * h_) + "\ngrowth = 1.3\n";
  with("graded");
}

std::string RandomScene::draw_fluid() {
  std::string keys = "model = \"newtonian\"\ndensity = " + mass(uniform(900, 1200)) +
                     "\nsound_speed = " + number(uniform(20, 60)) + "\nviscosity = " + mass(pick<double>({0, 1, 50}));
  if (chance(0.2) && !sticks_) keys += "\nmixing_length = " + number(uniform(0.05, 0.2));
  if (!enclosed_ && !sharp_ && chance(0.3)) keys += "\ntension_cutoff = " + mass(uniform(0, 1000)), with("cavities");
  with("newtonian");
  return keys;
}

std::string RandomScene::draw_shear() {
  const auto shear = pick<std::string>({"none", "no_slip", "rough_wall"});
  sticks_ = shear == "no_slip";
  return "shear = \"" + shear + "\"\n" + (shear == "rough_wall" ? "roughness = 0.01\n" : "");
}

std::string RandomScene::draw_soil() {
  const double phi = uniform(15, 40), cohesion = pick<double>({0, 1e3, 1e4}), psi = pick<double>({0, phi / 4});
  const double apex = cohesion / std::tan(phi * std::numbers::pi / 180);
  std::string keys = "model = \"mohr_coulomb\"\ndensity = " + mass(uniform(1500, 2000)) +
                     "\nyoungs_modulus = " + mass(uniform(1e6, 5e6)) +
                     "\npoissons_ratio = " + number(uniform(0.1, 0.4)) + "\ncohesion = " + mass(cohesion) +
                     "\nfriction_angle_deg = " + number(phi) + "\ndilatancy_angle_deg = " + number(psi) +
                     "\ntension_cutoff = " + mass(apex * pick<double>({0, 0.5}));
  if (psi == 0 && chance(0.4)) keys += "\n" + with("void_memory") + " = true";
  if (chance(0.4))
    keys +=
        "\ndrainage = \"" + with("undrained") + "\"\nporosity = 0.4\nfluid_bulk_modulus = " + mass(uniform(1e8, 2e8));
  else
    keys += "\ndrainage = \"drained\"";
  with("mohr_coulomb");
  return keys;
}

std::string RandomScene::draw_elastic(const std::string& model) {
  with(model);
  return "model = \"" + model + "\"\ndensity = " + mass(uniform(1000, 2000)) +
         "\nyoungs_modulus = " + mass(uniform(1e6, 5e6)) + "\npoissons_ratio = " + number(uniform(0, 0.4));
}

RandomScene::Matter RandomScene::draw_matter(const std::string& name, bool fluid) {
  const double kind = fluid ? 0 : uniform(0, 1);
  const bool solid = kind >= 0.3, neo = kind >= 0.85;
  const std::string keys = !solid        ? draw_fluid()
                           : kind < 0.65 ? draw_soil()
                                         : draw_elastic(neo ? "neo_hookean" : "linear_elastic");
  materials_.push_back("[materials." + name + "]\n" + keys + "\n");
  const std::string averaged = basis_ == "tri3" ? "nodal" : "cell";
  return {!solid, neo || (!sharp_ && chance(0.4)) ? "particle" : averaged};
}

void RandomScene::draw_body(const std::string& name, const std::string& shape, const Matter& matter) {
  std::string keys = "[[bodies]]\nname = \"" + name + "\"\nmaterial = \"" + name + "\"\nshape = " + shape +
                     "\ninitial_stress = { type = \"zero\" }\npressure = \"" + with(matter.pressure) + "\"\n";
  if (name == "pool" && immersed_) keys += "minus = [" + minus_ + "]\n";
  if (matter.fluid && matter.pressure != "enclosed" && basis_ != "tri3" && chance(0.3))
    keys += with("shift") + " = true\nshift_speed = " + number(uniform(0, 2)) + "\n";
  if (matter.fluid && chance(0.1))
    more_.push_back("[[pumps]]\nbody = \"" + name + "\"\nrate = " + number(uniform(0.01, 0.2)) +
                    "\nfrom = 0.005\nto = 5.0\n"),
        with("pump");
  if (chance(0.5)) {
    keys += "initial_velocity = { type = \"uniform\", value = " + vector({uniform(-2, 2), uniform(-2, 2)}) + " }\n";
  } else {
    std::array<double, 4> gradient;
    for (double& value : gradient) value = uniform(-5, 5);
    const std::array<double, 4> L = turn_tensor(image_.turn, gradient);
    keys += "initial_velocity = { type = \"linear\", gradient = [" + pair({L[0], L[1]}) + ", " + pair({L[2], L[3]}) +
            "], centre = " + point({upper_[0] / 2, upper_[1] / 2}) + " }\n";
  }
  bodies_.push_back(keys);
}

std::string RandomScene::draw_ellipse(const Pair& centre, double size) {
  const double short_axis = size * uniform(0.6, 1);
  const double tilt = uniform(-90, 90), turned = image_.determinant() * tilt;
  // The direction of the long axis is that of the image of the long axis; x axis to x' axis: turn[0] or turn[2].
  const Pair along = image_.vector({1, 0});
  const double base = std::atan2(along[1], along[0]) * 180 / std::numbers::pi;
  return "{ type = \"ellipse\", centre = " + point(centre) + ", semi_axes = " + pair({size, short_axis}) +
         ", tilt_deg = " + number(base + turned) + " }";
}

std::string RandomScene::draw_polygon(const Pair& centre, double size) {
  const int corners = pick<int>({3, 4, 4, 5, 6});
  const double start = uniform(0, 2 * std::numbers::pi);
  std::vector<Pair> list;
  for (int k = 0; k < corners; ++k) {
    const double angle = start + 2 * std::numbers::pi * k / corners;
    list.push_back({centre[0] + size * std::cos(angle), centre[1] + size * std::sin(angle)});
  }
  return "{ type = \"polygon\", points = " + points(list) + " }";
}

void RandomScene::draw_block(const std::string& name, const Pair& centre, double size) {
  const bool bag = !periodic_ && chance(0.45), enclosed = enclosed_ && name == "block";
  const bool sharp = bag && !enclosed_ && immersed_ && basis_ == "bspline2" && transfer_ != "musl" && chance(0.5);
  if (name == "block") sharp_ = sharp;
  Matter matter = draw_matter(name, enclosed);
  if (enclosed) matter.pressure = "enclosed";
  draw_body(name, enclosed || chance(0.4) ? draw_ellipse(centre, size) : draw_polygon(centre, size), matter);
  minus_ += (minus_.empty() ? "\"" : ", \"") + name + "\"";
  touching_.push_back(name);
  if (!bag && !enclosed) return;
  touching_.back() += "_skin";
  const bool skin = !enclosed && !(sharp && name == "block") && chance(0.3);
  std::string keys = "[[membranes]]\nname = \"" + name + "_skin\"\nbody = \"" + name +
                     "\"\naxial_stiffness = " + (skin ? "0.0" : mass(uniform(1e4, 2e5))) +
                     "\nmass_per_area = " + (skin ? "0.0" : mass(uniform(0.1, 1))) +
                     "\nslack = " + number(skin ? 0 : uniform(-0.02, 0.01)) + "\n" +
                     (skin ? "" : "strength = " + mass(1e5) + "\n");
  with(skin ? "skin" : "membrane");
  if (sharp_ && name == "block") keys += "interface = \"" + with("sharp") + "\"\n" + draw_shear();
  if (chance(0.3)) keys += "contents_friction = " + pick<std::string>({"0.0", "inf"}) + "\n";
  membranes_.push_back(keys);
}

void RandomScene::draw_pool() {
  const double level = immersed_ ? upper_[1] - pick<double>({0, 1.5}) * h_ : h_ * uniform(2, 3);
  const Matter matter = draw_matter("pool", immersed_);
  draw_body("pool", box({0, 0}, {upper_[0], level}, true), {matter.fluid, sharp_ ? "cell" : matter.pressure});
  with(immersed_ ? "immersed" : "pool");
}

void RandomScene::draw_contact(const std::string& one, const std::string& other) {
  contacts_.push_back("[[contacts]]\nbetween = [\"" + one + "\", \"" + other +
                      "\"]\nfriction = " + number(uniform(0, 0.6)) + "\n");
  with(rigid_.empty() ? "membrane_contact" : touching_[0] == "block" ? "bare_contact" : "skin_contact");
}

void RandomScene::draw_rigid(const Pair& centre, double size) {
  const double angle = uniform(0, 2 * std::numbers::pi), gap = size + 0.01 * h_;
  const Pair n{std::cos(angle), std::sin(angle)};
  const auto beside = [&](double distance, double along) {
    return Pair{centre[0] - n[0] * distance - n[1] * along, centre[1] - n[1] * distance + n[0] * along};
  };
  std::string keys = "[[rigid]]\nname = \"ground\"\nshape = ";
  if (chance(0.5)) {
    keys += "{ type = \"half_plane\", point = " + point(beside(gap, 0)) + ", normal = " + vector(n) + " }\n";
    with("half_plane");
  } else {
    const double radius = uniform(0.3, 1) * h_, away = gap + radius;
    keys += "{ type = \"capsule\", from = " + point(beside(away, -uniform(0, 2) * h_)) +
            ", to = " + point(beside(away, uniform(0, 2) * h_)) + ", radius = " + number(radius) + " }\n";
    with("capsule");
  }
  const double kind = uniform(0, 1), speed = uniform(1, 3);
  if (kind < 0.6)
    keys += "motion = { type = \"" + with("translation") + "\", velocity = " + vector({n[0] * speed, n[1] * speed}) +
            " }\n";
  else if (kind < 0.8)
    keys += "motion = { type = \"" + with("hinge") + "\", centre = " + point(beside(gap, 2 * h_)) +
            ", rate = " + number(image_.determinant() * uniform(-3, 3)) + ", stop_angle_deg = 30.0 }\n";
  rigid_.push_back(keys);
  for (std::size_t k = 0; k < touching_.size(); ++k)
    if (k == 0) draw_contact(touching_[k], "ground");
}

void RandomScene::draw_extras() {
  if (chance(0.06))
    more_.push_back("[relaxation]\ndamping = \"" + with("kinetic") +
                    "\"\nkinetic_ratio = 1e-9\nout_of_balance_ratio = 1e-9\n");
}

}  // namespace geodrop::test
