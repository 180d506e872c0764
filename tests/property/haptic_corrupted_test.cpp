// Real messages as they travel, cut short after every byte and with every byte changed in nine ways, through the deserializer
// of DDS and the reader of a node. Each is refused or rejected and counted, or it keeps every promise, and a hand in contact
// that gets it feels a finite, limited force.

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "common/wire/reader.h"
#include "common/wire/topic.h"
#include "common/wire/writer.h"
#include "haptic_node/control/controller.h"
#include "tests/system/dds_domain.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A message with all arrays full, for tool 0.
template <class M>
M whole() {
  for (std::uint64_t seed = 1;; ++seed) {
    M message = random_message<M>(seed);
    message.tool = 0;
    if constexpr (std::is_same_v<M, ContactPatch>)
      if (message.n_facets < max_patch_facets) continue;
    return message;
  }
}

/// Bytes into the reader of a node, as if they had come from the network.
template <class M>
class Corrupter {
 public:
  Corrupter() : participant_(own_domain()), reader_(participant_), writer_(participant_) {
    const Qos qos = make_qos(Topic<M>::service);
    const dds_entity_t topic =
        dds_create_topic(participant_.handle(), Topic<M>::descriptor(), Topic<M>::name, qos.get(), nullptr);
    raw_writer_ = made(dds_create_writer(participant_.handle(), topic, qos.get(), nullptr), "writer", "");
    const dds_entity_t ear =
        made(dds_create_reader(participant_.handle(), topic, qos.get(), nullptr), "reader", "");
    if (!writer_.write(whole<M>())) return;
    dds_sample_info_t info{};
    if (dds_takecdr(ear, &sample_, 1, &info, DDS_ANY_STATE) != 1) return;
    bytes_.resize(ddsi_serdata_size(sample_));
    ddsi_serdata_to_ser(sample_, 0, bytes_.size(), bytes_.data());
    M ours;
    while (reader_.take(ours)) ++before_;
    dds_delete(ear);
  }
  ~Corrupter() {
    if (sample_ != nullptr) ddsi_serdata_unref(sample_);
    dds_delete(raw_writer_);
  }

  const Bytes& bytes() const { return bytes_; }
  std::size_t refused = 0;  // by DDS

  /// @return true if the reader has let it through as `message`
  bool pass(const Bytes& bytes, M& message) {
    // In memory of its own: a step beyond its end is seen by the sanitizers.
    const std::unique_ptr<std::uint8_t[]> copy(new std::uint8_t[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    const ddsrt_iovec_t part{copy.get(), bytes.size()};
    ddsi_serdata* const made = ddsi_serdata_from_ser_iov(sample_->type, SDK_DATA, 1, &part, bytes.size());
    if (made == nullptr) {
      ++refused;
      return false;
    }
    EXPECT_EQ(dds_writecdr(raw_writer_, made), DDS_RETCODE_OK);
    return reader_.take(message);
  }

  /// Since the one that the bytes are of.
  std::uint64_t taken() { return reader_.counts().received - before_; }
  std::uint64_t rejected() {
    const auto counts = reader_.counts().rejected;
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  }
  std::uint64_t rejected(RejectReason reason) {
    return reader_.counts().rejected[static_cast<std::size_t>(reason)];
  }

 private:
  Participant participant_;
  Reader<M> reader_;
  Writer<M> writer_;
  dds_entity_t raw_writer_ = 0;
  ddsi_serdata* sample_ = nullptr;
  Bytes bytes_;
  std::uint64_t before_ = 0;
};

bool within(const Array3& a, double limit) {
  return std::all_of(a.begin(), a.end(), [limit](double v) { return std::abs(v) <= limit; });
}
template <std::size_t N>
bool finite(const std::array<double, N>& a) {
  return std::all_of(a.begin(), a.end(), [](double v) { return std::isfinite(v); });
}
template <std::size_t N>
bool unit(const std::array<double, N>& a) {
  return std::abs(std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0)) - 1) <= 1e-3;
}

bool promises_kept(const ToolState& m) {
  return m.tool < max_tools && m.engaged <= 1 && unit(m.q_WT) && within(m.p_WT, 1e3) &&
         within(m.proxy, 1e3) && within(m.v_WT, 1e3) && within(m.w_WT, 1e6) && within(m.force_on_hand, 1e3) &&
         within(m.force_now, 1e3) && within(m.torque_now, 1e3);
}
bool promises_kept(const ContactPatch& m) {
  bool kept = m.tool < max_tools && m.n_facets <= max_patch_facets;
  for (std::uint32_t i = 0; kept && i < m.n_facets; ++i) {
    const PatchFacet& f = m.facets[i];
    kept = unit(f.normal) && finite(f.point) && finite(f.velocity) && finite(f.corners[0]) &&
           finite(f.corners[1]) && finite(f.corners[2]) && f.stiffness > 0 &&
           f.stiffness <= rigid_stiffness && f.damping >= 0 && std::isfinite(f.damping) &&
           f.body < max_bodies;
  }
  return kept;
}
bool promises_kept(const ToolWrench& m) {
  return m.tool < max_tools && std::isfinite(m.t) && unit(m.q_WT) && finite(m.p_WT) && finite(m.force) &&
         finite(m.moment) && finite(m.set_point) && finite(m.tip) && finite(m.stiffness);
}

/// A hand that leans on tissue: by turns it gets what is true and what has been let through.
class Hand {
 public:
  explicit Hand(ForceModel model) : controller_(settings(model)) {
    controller_.set_state(haptic::HapticState::ready);
    sample_.has_new = sample_.powered = true;
    for (int i = 0; i < 1000; ++i) feel(good_patch(), good_wrench());
  }
  void feel(const ContactPatch& patch, const ToolWrench& wrench) {
    now_ += 1'000'000;
    sample_.t_ns = now_;
    sample_.x = {0, 0, n_++ < 700 ? 1e-3 : -1e-3};
    const haptic::ControllerOutput out = controller_.tick(now_, sample_, &patch, &wrench);
    bad_ += !out.force.allFinite() || out.force.norm() > 3 * (1 + 1e-12) || !out.torque.allFinite() ||
            out.torque.norm() > 0.02 * (1 + 1e-12);
    pushing_ += out.force.norm() > 0;
  }
  ContactPatch good_patch() {
    ContactPatch patch;
    patch.tick = ++tick_;
    patch.n_facets = 1;
    patch.facets[0].corners = {{{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0, 0.1, 0}}};
    patch.facets[0].normal = {0, 0, 1};
    patch.facets[0].stiffness = 300;
    return patch;
  }
  ToolWrench good_wrench() {
    ToolWrench wrench;
    wrench.tick = tick_;
    wrench.stiffness[14] = 300;  // along z
    return wrench;
  }
  int bad() const { return bad_; }
  int pushing() const { return pushing_; }

 private:
  static haptic::ControllerSettings settings(ForceModel model) {
    haptic::ControllerSettings settings;
    settings.model = model;
    if (model == ForceModel::tangent) settings.torque_limit = 0.02;
    return settings;
  }
  haptic::Controller controller_;
  haptic::DeviceSample sample_;
  std::int64_t now_ = 1'000'000'000;
  std::uint64_t tick_ = 0;
  int n_ = 0, bad_ = 0, pushing_ = 0;
};

void feel(Hand& hand, const ContactPatch& patch) { hand.feel(patch, hand.good_wrench()); }
void feel(Hand& hand, const ToolWrench& wrench) { hand.feel(hand.good_patch(), wrench); }
void feel(Hand&, const ToolState&) {}  // goes the other way

template <class M>
class Corrupted : public testing::Test {};
using Loop = testing::Types<ToolState, ContactPatch, ToolWrench>;
TYPED_TEST_SUITE(Corrupted, Loop);

TYPED_TEST(Corrupted, ComesBackWholeIfNothingIsChanged) {
  Corrupter<TypeParam> wire;
  TypeParam message;
  ASSERT_GT(wire.bytes().size(), sizeof(TypeParam) / 2);
  ASSERT_TRUE(wire.pass(wire.bytes(), message));
  EXPECT_TRUE(message == whole<TypeParam>());
}

TYPED_TEST(Corrupted, IsRefusedWhereverItIsCutShort) {
  Corrupter<TypeParam> wire;
  TypeParam message;
  const std::size_t n = wire.bytes().size();
  for (std::size_t length = 0; length < n; ++length)
    ASSERT_FALSE(wire.pass(
        Bytes(wire.bytes().begin(), wire.bytes().begin() + static_cast<std::ptrdiff_t>(length)), message))
        << "cut after " << length << " of " << n << " bytes";
  EXPECT_EQ(wire.refused, n);
  EXPECT_TRUE(wire.pass(wire.bytes(), message)) << "and what is whole comes through as before";
}

TYPED_TEST(Corrupted, IsCountedOrKeepsItsPromises) {
  Corrupter<TypeParam> wire;
  Hand by_planes(ForceModel::norton), by_wrench(ForceModel::tangent);
  ASSERT_GT(by_planes.pushing(), 100);
  TypeParam message;
  for (std::size_t at = 0; at < wire.bytes().size(); ++at)
    for (const unsigned flip : {1U, 2U, 4U, 8U, 16U, 32U, 64U, 128U, 255U}) {
      Bytes bytes = wire.bytes();
      bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ flip);
      if (!wire.pass(bytes, message)) continue;
      ASSERT_TRUE(promises_kept(message)) << "byte " << at << " changed by " << flip;
      for (Hand* hand : {&by_planes, &by_wrench}) {
        feel(*hand, message);
        hand->feel(hand->good_patch(), hand->good_wrench());
      }
    }
  EXPECT_EQ(wire.refused + wire.taken() + wire.rejected(), 9 * wire.bytes().size())
      << "one has gone uncounted";
  EXPECT_EQ(wire.rejected(RejectReason::other), 0U);
  EXPECT_GE(wire.rejected(RejectReason::version), 36U) << "four bytes";
  for (const auto reason : {RejectReason::unknown_id, RejectReason::not_finite, RejectReason::not_unit})
    EXPECT_GT(wire.rejected(reason), 0U) << static_cast<int>(reason);
  EXPECT_EQ(by_planes.bad() + by_wrench.bad(), 0);
  this->RecordProperty("refused", std::to_string(wire.refused));
  this->RecordProperty("rejected", std::to_string(wire.rejected()));
  this->RecordProperty("taken", std::to_string(wire.taken()));
}

}  // namespace
}  // namespace palpate::test
