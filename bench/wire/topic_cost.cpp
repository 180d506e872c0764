#include "bench/wire/topic_cost.h"

#include <chrono>
#include <memory>
#include <thread>

#include "common/time/ticker.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"

namespace palpate::bench {
namespace {

using namespace std::chrono_literals;
constexpr double pace_Hz = 1000;

void fill(ToolState& state) { state.tick = 1; }
void fill(ContactPatch& patch) {
  patch.n_facets = 8;
  for (auto& facet : patch.facets) {
    facet.normal = {0, 0, 1};
    facet.stiffness = 1;
  }
}
void fill(ToolWrench& wrench) { wrench.tick = 1; }
void fill(BodySurface& chunk) {
  chunk.revision = 1;
  chunk.total_vertices = chunk.n_vertices = max_surface_vertices;
  chunk.total_facets = chunk.n_facets = max_surface_facets;
}
void fill(SurfaceChange& page) {
  page.revision = page.change = 1;
  page.total_vertices = page.n_vertices = max_change_vertices;
  page.total_facets = page.total_changes = page.n_changes = max_change_facets;
}
void fill(VertexBlock& block) {
  block.revision = 1;
  block.n_vertices = max_block_vertices;
}
void fill(HapticTrace& trace) {
  trace.n_samples = 20;
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    trace.samples[i].tick = i + 1;
    trace.samples[i].t = 1e-3 * static_cast<double>(i);
  }
}
void fill(NodeStatus&) {}

/// Does it so many times, once each millisecond. @return processor time of the process a time [us]
template <class Work>
double paced_us(int times, const Work& work) {
  Ticker ticker(pace_Hz);
  const double before = cpu_s();
  for (int i = 0; i < times; ++i) {
    ticker.wait();
    work();
  }
  return 1e6 * (cpu_s() - before) / times;
}

/// @return {processor time a sample [us]}
template <class M>
std::vector<double> write_all(int samples) {
  Participant participant(bench_membership());
  Writer<M> writer(participant);
  for (int i = 0; writer.matched() == 0; ++i) {
    if (i > 5000) return {};
    std::this_thread::sleep_for(1ms);
  }
  std::this_thread::sleep_for(300ms);
  const auto message = std::make_unique<M>();
  fill(*message);
  // What the clock alone costs is not the wire's.
  const double idle = paced_us(samples, [] {});
  const double spent = paced_us(samples, [&] { writer.write(*message); }) - idle;
  std::this_thread::sleep_for(300ms);
  return {spent};
}

/// @return {processor time a sample that came [us], samples that came}; over when none comes for a second
template <class M>
std::vector<double> read_all() {
  Participant participant(bench_membership());
  Reader<M> reader(participant);
  const auto message = std::make_unique<M>();
  if (!reader.wait(10s)) return {};
  double before = cpu_s(), after = before;
  int came = 0;
  do {
    while (reader.take(*message)) ++came;
    after = cpu_s();
  } while (reader.wait(1s));
  return {1e6 * (after - before) / std::max(came, 1), static_cast<double>(came)};
}

template <class M>
void measure(Path path, int samples, std::vector<TopicCost>& costs, const char* topic) {
  // Each end tells its own: two runs, of which one end is heard at a time.
  const auto wrote = run_ends(
      path, [&] { return write_all<M>(samples); }, [] { read_all<M>(); });
  const auto read = run_ends(
      path, [] { return read_all<M>(); }, [&] { write_all<M>(samples); });
  if (wrote.size() == 1 && read.size() == 2) costs.push_back({topic, wrote[0], read[0], read[1] / samples});
}

}  // namespace

std::vector<TopicCost> measure_topics(Path path, int samples) {
  std::vector<TopicCost> costs;
  measure<ToolState>(path, samples, costs, "ToolState");
  measure<ContactPatch>(path, samples, costs, "ContactPatch");
  measure<ToolWrench>(path, samples, costs, "ToolWrench");
  measure<VertexBlock>(path, samples, costs, "VertexBlock");
  measure<BodySurface>(path, samples, costs, "BodySurface");
  measure<SurfaceChange>(path, samples, costs, "SurfaceChange");
  measure<HapticTrace>(path, samples, costs, "HapticTrace");
  measure<NodeStatus>(path, samples, costs, "NodeStatus");
  return costs;
}

}  // namespace palpate::bench
