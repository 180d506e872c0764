#include "bench/touch/deep_rows.h"

#include <fmt/format.h>

#include <cstdio>

#include "bench/solids/sphere_press.h"

namespace palpate::bench {
namespace {

void add_row(double radius, double nu, double edge, const Pressed& pressed, double truth,
             nlohmann::json& json) {
  const double error = pressed.force.back() / truth - 1;
  fmt::print(
      "  R = {:.0f} mm  nu {:.2f}  cells of {:.2f} mm  {:.4f} N  error {:+6.1f} %  least J of a corner "
      "{:5.2f}  "
      "{}{}  {:.3g} s\n",
      1e3 * radius, nu, 1e3 * edge, pressed.force.back(), 100 * error, pressed.least_corner_J.value_or(1),
      pressed.is_monotone() ? "grows throughout" : "FALLS ON THE WAY", pressed.at_rest ? "" : ", NOT AT REST",
      pressed.cpu_s);
  std::fflush(stdout);  // rows take minutes
  json.push_back({{"radius_m", radius},
                  {"poisson_ratio", nu},
                  {"edge_m", edge},
                  {"force_N", pressed.force},
                  {"error_of_finest", error},
                  {"least_corner_J", pressed.least_corner_J.value_or(1)},
                  {"monotone", pressed.is_monotone()},
                  {"at_rest", pressed.at_rest},
                  {"cpu_s", pressed.cpu_s}});
}

}  // namespace

nlohmann::json deep_rows(bool finest) {
  fmt::print(
      "a sphere 5 mm deep in 100 x 100 x 60 mm of 10 kPa, elements; error of the row of the smallest "
      "cells\n");
  std::vector<double> edges = {0.00125, 0.0025};
  if (finest) edges.insert(edges.begin(), 0.0025 / 3);
  nlohmann::json json = nlohmann::json::array();
  for (const double nu : {0.45, 0.49})
    for (const double radius : {0.003, 0.005, 0.008}) {
      double truth = 0;
      for (const double edge : edges) {
        const Pressed pressed = press(SpherePress{.radius = radius, .edge = edge, .poisson_ratio = nu});
        if (edge == edges.front()) truth = pressed.force.back();
        add_row(radius, nu, edge, pressed, truth, json);
      }
    }
  return json;
}

}  // namespace palpate::bench
