#include "bench/wire/round_trips.h"

#include <dds/dds.h>
#include <dds/ddsc/dds_loan_api.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "bench/wire/payload.h"
#include "common/time/clock.h"
#include "common/wire/participant.h"
#include "common/wire/topic.h"

namespace palpate::bench {
namespace {

constexpr int warm_up = 20;  // rounds that are not counted
constexpr std::uint8_t go_on = 1, end_now = 2;
constexpr dds_duration_t patience = DDS_MSECS(200);

/// One end: a writer of one topic, a reader of the other.
template <class Bytes>
class End {
 public:
  End(const dds_topic_descriptor_t& type, const char* says, const char* hears, bool loaned)
      : loaned_(loaned), buffer_(std::make_unique<Bytes>()) {
    const Qos qos = make_qos(Service::blocks);
    const dds_entity_t owner = participant.handle();
    writer_ = made(dds_create_writer(
                       owner, made(dds_create_topic(owner, &type, says, qos.get(), nullptr), "topic", says),
                       qos.get(), nullptr),
                   "writer of", says);
    reader_ = made(dds_create_reader(
                       owner, made(dds_create_topic(owner, &type, hears, qos.get(), nullptr), "topic", hears),
                       qos.get(), nullptr),
                   "reader of", hears);
    waitset_ = made(dds_create_waitset(owner), "waitset of", hears);
    made(dds_waitset_attach(waitset_, dds_create_readcondition(reader_, DDS_ANY_STATE), 0), "waitset of",
         hears);
  }

  void meet() const {
    for (int i = 0; i < 5000; ++i) {
      dds_publication_matched_status_t out = {};
      dds_subscription_matched_status_t in = {};
      dds_get_publication_matched_status(writer_, &out);
      dds_get_subscription_matched_status(reader_, &in);
      if (out.current_count > 0 && in.current_count > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));  // iceoryx's own discovery, each 100 ms
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw std::runtime_error("the two ends did not meet in 5 s");
  }

  bool say(std::uint8_t word) const {
    void* loan = nullptr;
    if (loaned_ && dds_loan_sample(writer_, &loan) == DDS_RETCODE_OK) {
      static_cast<Bytes*>(loan)->data[0] = word;
      return dds_write(writer_, loan) == DDS_RETCODE_OK;
    }
    buffer_->data[0] = word;
    return dds_write(writer_, buffer_.get()) == DDS_RETCODE_OK;
  }

  /// @return the word of the newest sample; 0 if none came
  std::uint8_t hear() const {
    if (dds_waitset_wait(waitset_, nullptr, 0, patience) <= 0) return 0;
    void* samples[1] = {loaned_ ? nullptr : buffer_.get()};
    dds_sample_info_t info = {};
    const int n = dds_take(reader_, samples, &info, 1, 1);
    if (n != 1) return 0;
    const std::uint8_t word = info.valid_data ? static_cast<Bytes*>(samples[0])->data[0] : std::uint8_t{0};
    if (loaned_) dds_return_loan(reader_, samples, n);
    return word;
  }

  Participant participant{bench_membership()};

 private:
  bool loaned_;
  std::unique_ptr<Bytes> buffer_;
  dds_entity_t writer_ = 0, reader_ = 0, waitset_ = 0;
};

double at(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0
                        : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double us_since(std::int64_t start_ns) { return 1e-3 * static_cast<double>(now_ns() - start_ns); }

template <class Bytes>
std::vector<double> ask(const dds_topic_descriptor_t& type, bool loaned, int rounds) {
  const End<Bytes> end(type, "Question", "Answer", loaned);
  end.meet();
  std::vector<double> trips, writes;
  double cpu = 0;
  for (int i = -warm_up; i < rounds; ++i) {
    if (i == 0) cpu = cpu_s();
    const std::int64_t start = now_ns();
    end.say(go_on);
    const double wrote = us_since(start);
    const bool answered = end.hear() == go_on;
    if (i < 0 || !answered) continue;
    trips.push_back(us_since(start));
    writes.push_back(wrote);
  }
  cpu = 1e6 * (cpu_s() - cpu) / rounds;
  for (int i = 0; i < 3; ++i) end.say(end_now);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return {end.participant.shared_memory() ? 1.0 : 0.0,
          static_cast<double>(trips.size()),
          at(trips, 0.5),
          at(trips, 0.99),
          at(trips, 1.0),
          at(writes, 0.5),
          cpu};
}

template <class Bytes>
void answer(const dds_topic_descriptor_t& type, bool loaned) {
  const End<Bytes> end(type, "Answer", "Question", loaned);
  for (int silent = 0; silent < 50;) {
    const std::uint8_t word = end.hear();
    if (word == end_now) return;
    if (word == go_on) end.say(go_on);
    silent = word == go_on ? 0 : silent + 1;
  }
}

struct Kind {
  std::size_t size;
  std::function<std::vector<double>(bool loaned, int rounds)> ask;
  std::function<void(bool loaned)> answer;
};

template <class Bytes>
Kind kind(const dds_topic_descriptor_t& type) {
  return {sizeof(Bytes), [&type](bool loaned, int rounds) { return ask<Bytes>(type, loaned, rounds); },
          [&type](bool loaned) { answer<Bytes>(type, loaned); }};
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      kind<palpate_wire_bench_Bytes128>(palpate_wire_bench_Bytes128_desc),
      kind<palpate_wire_bench_Bytes2k>(palpate_wire_bench_Bytes2k_desc),
      kind<palpate_wire_bench_Bytes64k>(palpate_wire_bench_Bytes64k_desc),
      kind<palpate_wire_bench_Bytes1200k>(palpate_wire_bench_Bytes1200k_desc),
      kind<palpate_wire_bench_Bytes4M>(palpate_wire_bench_Bytes4M_desc)};
  return all;
}

}  // namespace

const std::vector<std::size_t>& payload_sizes() {
  static const std::vector<std::size_t> sizes = [] {
    std::vector<std::size_t> list;
    for (const Kind& one : kinds()) list.push_back(one.size);
    return list;
  }();
  return sizes;
}

std::optional<RoundTrips> measure_round_trips(std::size_t size, Path path, bool loaned, int rounds) {
  for (const Kind& one : kinds()) {
    if (one.size != size) continue;
    const auto values = run_ends(
        path, [&] { return one.ask(loaned, rounds); }, [&] { one.answer(loaned); });
    if (values.size() != 7) return {};
    return RoundTrips{values[0] > 0, static_cast<int>(values[1]), values[2], values[3], values[4], values[5],
                      values[6]};
  }
  return {};
}

}  // namespace palpate::bench
