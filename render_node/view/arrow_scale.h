#pragma once
// How long one newton is drawn: a round number of millimetres, the same for a whole run, stated in the panel.

namespace palpate::render {

/// The largest of 1, 2, 5, 10, 20, 50 ... (times 10^n) mm/N for which `newton` is at most `metres` long.
/// @return [m/N]; both arguments > 0
double arrow_metres_per_newton(double newton, double metres);

}  // namespace palpate::render
