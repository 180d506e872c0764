#include "physics_node/contact/blade_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error/error.h"
#include "common/message/vec3.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

constexpr double strips_a_spacing =
    2;  // Why: a strip answers for half a spacing of edge, so that a blade that enters does so gradually
constexpr std::size_t most_cuts = 4096;  // in a step

bool is_lattice_of_springs(const Body& body) { return !body.solid && !body.mesh; }
/// Where their materials say how tough they are.
bool is_of_a_kind_to_cut(const Body& body) {
  return is_lattice_of_springs(body) || is_parted_where_cut(body) ||
         (body.mesh && body.mesh->model.mesh.middles.empty());
}
bool is_cut(const Body& body) {
  return is_lattice_of_springs(body) || body.cell_net() != nullptr ||
         (body.mesh && body.mesh->copies() != nullptr);
}

/// What kind it is that a scalpel does not cut, and what would do.
const char* kind_and_remedy(const Body& body) {
  if (body.mesh) return "of second order; write elements = \"nodal_pressure\" there";
  return "of finite elements that yield, break or relax; leave that out of its materials";
}

void refuse_uncut(const ToolSpec& tool, const Body& body) {
  if (!is_of_a_kind_to_cut(body))
    throw InputError(
        fmt::format("{}: shape = \"{}\" cuts springs, surfaces of springs, finite elements of first "
                    "order that are elastic, and what a "
                    "[[connection]] "
                    "joins, and \"{}\" is {}",
                    tool.place.text(), blade_name(tool), body.name, kind_and_remedy(body)));
  if (std::ranges::any_of(body.laws, [](const ElementLaw& law) { return law.cut_toughness <= 0; }))
    throw InputError(
        fmt::format("{}: shape = \"{}\" needs to know how tough \"{}\" is; give each of its materials "
                    "cut_toughness_J_per_m2, such as 190 of a liver",
                    tool.place.text(), blade_name(tool), body.name));
}

std::vector<std::size_t> passed_bodies(const BodyModels& bodies) {
  std::vector<std::size_t> passed;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!is_cut(bodies[b]->body())) passed.push_back(b);
  return passed;
}

double edge_of(const ToolSpec& tool) {
  return tool.shape == ToolShape::scissors ? tool.scissors.mouth() : tool.length;
}

std::size_t strips_of(const ToolSpec& tool, const BodyModels& bodies) {
  const double length = edge_of(tool);
  double finest = length;
  for (const auto& body : bodies)
    finest = std::min(finest, is_cut(body->body()) ? BladeCells(*body).spacing() : body->body().spacing());
  return static_cast<std::size_t>(
      std::clamp(std::ceil(strips_a_spacing * length / finest), 1.0, static_cast<double>(BladeStrips::most)));
}

}  // namespace

const char* blade_name(const ToolSpec& tool) noexcept {
  return tool.shape == ToolShape::scissors ? "scissors" : "scalpel";
}

BladeTool::BladeTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
                     const std::vector<TouchableBody>& touchable, const Connections& connections,
                     double period)
    : PressingTool(index, tool.set_point),
      attitude_(tool.attitude),
      edge_(tool.edge),
      stiffness_(tool.stiffness),
      play_(period),
      strands_(connections, edge_of(tool)),
      inside_(touchable, passed_bodies(bodies), edge_of(tool)),
      blade_(edge_of(tool), strips_of(tool, bodies), tool.stiffness) {
  if (tool.shape == ToolShape::scissors) scissors_.emplace(tool.scissors);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    if (connections.empty() || is_lattice_of_springs(body)) refuse_uncut(tool, body);
    if (is_cut(body)) bodies_.push_back({b, BladeLinks(*bodies[b], edge_of(tool))});
  }
  forces_.reserve(8 * BladeLinks::most_nodes);
  cuts_.reserve(most_cuts);
}

BladeFrame BladeTool::frame_at(double share) const noexcept {
  const Eigen::Matrix3d axes = play_.attitude(share).toRotationMatrix() * attitude_;
  BladeFrame frame;
  if (scissors_) {
    const ScissorsSpec& blades = scissors_->spec();
    frame.along = axes.col(0);
    frame.ahead = -axes.col(2);
    frame.side = axes.col(1);
    frame.tip = tip_at(share) - scissors_->left() * frame.ahead - 0.5 * blades.mouth() * frame.along;
    return frame;
  }
  const double c = std::cos(edge_), s = std::sin(edge_);
  frame.tip = tip_at(share);
  frame.along = axes * Vec3(-s, 0, c);
  frame.ahead = axes * Vec3(-c, 0, -s);
  frame.side = frame.along.cross(frame.ahead);
  return frame;
}

void BladeTool::reset() noexcept {
  play_.reset();
  let_go();
  if (scissors_) scissors_->reset();
  for (OfBody& body : bodies_) body.links.reset();
  inside_.reset();
  engaged_ = near_ = false;
  keep_ = 1;
  done_ = {};
  forces_.clear();
  cuts_.clear();
}

void BladeTool::take(const ToolState* state, double dt) noexcept {
  frame_dt_ = dt;
  elapsed_ = 0;
  const ToolState hand = state != nullptr ? numbered(*state) : ToolState{};
  if (!play_.take(state != nullptr ? &hand : nullptr, dt)) let_go();
  keep_ = spring_left(keep_, state != nullptr, dt);
  if (state == nullptr) {
    if (scissors_) scissors_->stand();
    return;
  }
  note(*state);
  engaged_ = state->engaged != 0;
  if (!scissors_) return;
  const bool closed_until_now = scissors_->closing();
  scissors_->press(engaged_ && (state->buttons & 1U) != 0);
  stops_ = closed_until_now && !scissors_->closing() && blade_.bites();
}

void BladeTool::find_contact(double t) noexcept {
  near_ = false;
  done_ = {};
  forces_.clear();
  cuts_.clear();
  if (!play_.seen()) return;
  if (!bites()) let_go(), inside_.let_go();
  const BladeFrame frame = frame_at(0);
  hand_ = tip_at(0);
  std::size_t most = 0;
  for (std::size_t b = 0; bites() && b < bodies_.size(); ++b) {
    if (blade_.bites() && b != touched_) continue;
    BladeLinks& links = bodies_[b].links;
    links.gather(frame, blade_.place(), t);
    if (links.links().size() <= most) continue;
    most = links.links().size();
    if (b != touched_) blade_.let_go();
    touched_ = b;
  }
  near_ = most > 0;
  if (cuts_now()) {
    const double closes = scissors_ ? scissors_->spec().speed() * frame_dt_ : 0.0;
    strands_.gather(frame, blade_.place().lag, play_.way() + closes, t);
    inside_.follow(frame);
  } else {
    strands_.let_go();
  }
  book().passed_unfelt(inside_.areas());
  if (!near_ && !strands_.is_near()) blade_.let_go(), stops_ = false;
}

void BladeTool::begin_step() noexcept {
  if (near_) bodies_[touched_].links.begin_step();
  strands_.begin_step();
}

double BladeTool::press(double dt) noexcept {
  elapsed_ += dt;
  forces_.clear();
  cuts_.clear();
  strands_.clear_pushes();
  done_ = {};
  const double share = frame_dt_ > 0 ? elapsed_ / frame_dt_ : 1.0;
  const bool press = may_press() && keep_ > 0;  // before the blades of scissors have met
  if (scissors_ && !stops_) scissors_->step(dt);
  stops_ |= press && scissors_ && scissors_->way() > 0 && !scissors_->closing();
  blade_.set_sharp(cuts_now());
  frame_ = frame_at(share);
  hand_ = tip_at(share);
  if (!press) return 0;
  const double lag = blade_.place().lag, led = std::max(0.0, play_.at(share).v.dot(frame_.ahead) * dt);
  if (scissors_) blade_.set_gripped(scissors_->gripped(led));
  blade_.set_stiffness(keep_ * stiffness_);
  BladeLinks& links = near_ ? bodies_[touched_].links : nothing_;
  const bool limits = links.parts_nodes() && frame_dt_ > 0;
  blade_.set_fastest(limits ? links.spacing() / frame_dt_ : std::numeric_limits<double>::max());
  done_ = stops_ ? blade_.go_through(links, strands_, frame_, dt, cuts_)
                 : blade_.step(links, strands_, frame_, dt, cuts_);
  for (const BladeLinks::Node& node : links.nodes()) {
    if (node.force.isZero(0)) continue;
    for (const Index at : node.of.list())
      forces_.push_back({at, node.force / static_cast<double>(node.of.n)});
  }
  book().cut(done_.area, done_.work + done_.released);
  if (scissors_ && cuts_now()) book_handles(led, lag);
  stops_ = false;
  return done_.power;
}

/// Handles pay what the hand does not: the crossing's own way, and that part of the hand's which friction takes. When
/// they stop, for what is left to cut the hand's spring gives what it holds first.
void BladeTool::book_handles(double led, double lag) noexcept {
  const double work = stops_ ? std::max(0.0, done_.work - 0.5 * keep_ * stiffness_ * lag * lag)
                             : done_.thrust * (scissors_->way() + led * scissors_->gripped(led));
  book().closed(scissors_->torque(done_.thrust), work);
}

Wrench BladeTool::wrench() const noexcept {
  return {-done_.force, -done_.moment + (frame_.tip - set_point_).cross(-done_.force)};
}

void BladeTool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns,
                             double t) const noexcept {
  begin_wrench(out, wrench(), frame, now_ns, t);
  if (scissors_) out.stretch = -scissors_->left();
  Mat6 K = Mat6::Zero();
  K.topLeftCorner<3, 3>() = blade_.felt_ahead(strands_) * frame_.ahead * frame_.ahead.transpose() +
                            blade_.felt_across() * frame_.side * frame_.side.transpose();
  Eigen::Map<Mat6>(out.stiffness.data()) = K;  // symmetric
}

}  // namespace palpate::physics
