#include "bench/touch/half_space_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "bench/solids/shape_press.h"

namespace palpate::bench {
namespace {

using physics::RigidShape;

constexpr double nu_of_elements = 0.45;
constexpr std::array depths_over_R = {0.05, 0.1, 0.15};

/// What is pressed: a shape of this radius, and the force on a half space at a depth [m] -> [N].
struct Indenter {
  const char* name;
  double radius;  // [m]
  double exponent;
  RigidShape shape;
  std::function<double(double modulus, double depth)> force;
  std::function<double(double depth)> contact_radius;  // [m] -> [m]
};

Indenter sphere(double R) {
  return {"sphere",
          R,
          1.5,
          RigidShape::sphere(R),
          [R](double modulus, double d) { return 4.0 / 3 * modulus * std::sqrt(R * d) * d; },
          [R](double d) { return std::sqrt(R * d); }};
}

Indenter cylinder(double R) {
  return {"cylinder",
          R,
          1,
          RigidShape::cylinder(R, 2 * R),
          [R](double modulus, double d) { return 2 * modulus * R * d; },
          [R](double) { return R; }};
}

struct Answer {
  std::vector<double> depth{}, force_over_true{}, radius_off{};  // at each force [m], [1], [cells]
  double exponent = 0;
  bool at_rest = true;
  double cpu_s = 0;
  double worst() const {
    double most = 0;
    for (const double ratio : force_over_true) most = std::max(most, std::abs(ratio - 1));
    return most;
  }
  double worst_radius() const { return *std::max_element(radius_off.begin(), radius_off.end()); }
};

Answer press_half_space(const Indenter& indenter, ElementModel model, int cells_a_radius) {
  const double nu = model == ElementModel::fem ? nu_of_elements : springs_poisson_ratio;
  const double modulus = ShapePress::modulus / (1 - nu * nu);
  ShapePress how{.shape = indenter.shape,
                 .edge = indenter.radius / cells_a_radius,
                 .poisson_ratio = nu,
                 .model = model,
                 .breadth = 8 * indenter.radius,
                 .height = 4 * indenter.radius};
  for (const double d : depths_over_R) how.forces.push_back(indenter.force(modulus, d * indenter.radius));
  const ShapePressed pressed = press(how);
  Answer answer{
      .depth = depth_on_half_space(how, pressed), .at_rest = pressed.at_rest, .cpu_s = pressed.cpu_s};
  for (std::size_t n = 0; n < answer.depth.size(); ++n) {
    const double d = answer.depth[n];
    answer.force_over_true.push_back(how.forces[n] / indenter.force(modulus, d));
    answer.radius_off.push_back(
        std::abs(std::sqrt(pressed.area[n] / std::numbers::pi) - indenter.contact_radius(d)) / how.edge);
  }
  answer.exponent =
      std::log(how.forces.back() / how.forces.front()) / std::log(answer.depth.back() / answer.depth.front());
  return answer;
}

nlohmann::json half_space_row(const Indenter& indenter, ElementModel model, int cells, Table& table) {
  const Answer answer = press_half_space(indenter, model, cells);
  const char* tissue = model == ElementModel::fem ? "elements" : "springs";
  fmt::print(
      "  {:8} R = {:.0f} mm  {:8} cells of R/{}  F / F_true {:.3f} {:.3f} {:.3f}  worst {:5.1f} %  exponent "
      "{:.2f} (true {:.1f})  radius of contact off by {:.2f} cells  {:.3g} s{}\n",
      indenter.name, 1e3 * indenter.radius, tissue, cells, answer.force_over_true[0],
      answer.force_over_true[1], answer.force_over_true[2], 100 * answer.worst(), answer.exponent,
      indenter.exponent, answer.worst_radius(), answer.cpu_s, answer.at_rest ? "" : "  NOT AT REST");
  nlohmann::json row = {{"shape", indenter.name},
                        {"radius_m", indenter.radius},
                        {"tissue", tissue},
                        {"cells_a_radius", cells},
                        {"depth_m", answer.depth},
                        {"force_over_true", answer.force_over_true},
                        {"exponent", answer.exponent},
                        {"radius_off_cells", answer.radius_off},
                        {"at_rest", answer.at_rest},
                        {"cpu_s", answer.cpu_s}};
  for (std::size_t n = 0; n < answer.depth.size(); ++n)
    table.add({indenter.name, text_of(indenter.radius), tissue, std::to_string(cells),
               text_of(answer.depth[n]), text_of(answer.force_over_true[n]), text_of(answer.radius_off[n])});
  return row;
}

}  // namespace

nlohmann::json half_space_rows(Table& table) {
  fmt::print(
      "a shape on a half space of 10 kPa, by the product's contact, at rest; force over the closed form at "
      "about "
      "0.05, 0.1 and 0.15 R\n");
  nlohmann::json json = nlohmann::json::array();
  for (const auto model : {ElementModel::fem, ElementModel::springs})
    for (const int cells : {2, 4, 8}) {
      json.push_back(half_space_row(sphere(0.005), model, cells, table));
      if (cells > 2) json.push_back(half_space_row(sphere(0.008), model, cells, table));
      json.push_back(half_space_row(cylinder(0.005), model, cells, table));
    }
  return json;
}

nlohmann::json coarse_rows() {
  constexpr double force = 0.1;  // [N]
  nlohmann::json json = nlohmann::json::array();
  fmt::print("spheres of 3 and 5 mm on cells of 5 mm, {} N\n", force);
  for (const auto model : {ElementModel::fem, ElementModel::springs}) {
    const auto depth = [&](double radius) {
      return press({.shape = RigidShape::sphere(radius), .edge = 0.005, .model = model, .forces = {force}})
          .depth.back();
    };
    const double small = depth(0.003), large = depth(0.005);
    const char* tissue = model == ElementModel::fem ? "elements" : "springs";
    fmt::print("  {:8} {:.3f} and {:.3f} mm deep\n", tissue, 1e3 * small, 1e3 * large);
    json.push_back({{"tissue", tissue}, {"depth_of_3_mm_m", small}, {"depth_of_5_mm_m", large}});
  }
  return json;
}

}  // namespace palpate::bench
