#pragma once
// Messages with random content that keeps all promises.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "common/message/messages.h"

namespace palpate::test {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t integer() { return engine_(); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  double real(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values) {
    for (T& value : values) fill(value);
  }
  void fill(double& value) { value = real(-10, 10); }
  void fill(std::uint64_t& value) { value = integer(); }
  void fill(std::int64_t& value) { value = static_cast<std::int64_t>(integer() >> 3); }
  void fill(std::uint8_t& value) { value = static_cast<std::uint8_t>(integer()); }
  void fill(std::uint32_t& value) { value = static_cast<std::uint32_t>(integer()); }
  template <std::size_t N>
  void fill_unit(std::array<double, N>& values) {
    double squared = 0;
    fill(values);
    for (const double value : values) squared += value * value;
    for (double& value : values) value /= std::sqrt(squared);
  }
  template <std::size_t N>
  void fill_text(std::array<char, N>& text) {
    const auto length = below(N - 1);
    for (std::uint32_t i = 0; i < N; ++i) text[i] = i < length ? static_cast<char>('a' + below(26)) : '\0';
  }

 private:
  std::mt19937_64 engine_;
};

/// Random values that keep the promise of each field.
template <class M>
class Randomise {
 public:
  Randomise(Dice& dice, M& message) : dice_(dice), message_(message) {}

  template <class Of, class Promise>
  void operator()(Field<Of> field, Promise promise) {
    fill(field.of(message_), promise);
  }
  template <class Of, class N, class Promise>
  void first(Field<Of> field, Field<N> n, Promise promise) {
    for (std::size_t i = 0; i < n.of(message_); ++i) fill(field.of(message_)[i], promise);
  }
  template <class Of, class N, class S>
  void each(Field<Of> field, Field<N> n, OfType<S>) {
    for (std::size_t i = 0; i < n.of(message_); ++i) S::fields(Randomise<S>(dice_, field.of(message_)[i]));
  }
  template <class Holds>
  void rule(const char*, RejectReason, Holds) {}  // keep_rules()

 private:
  template <class T>
  void fill(T& value, promise::Any) {
    dice_.fill(value);
  }
  void fill(std::uint32_t& value, promise::Below promise) { value = dice_.below(promise.end); }
  void fill(std::uint32_t& value, promise::Count promise) { value = dice_.below(promise.most + 1); }
  void fill(std::uint32_t& value, promise::FromOne) { value = 1 + dice_.below(1000); }
  void fill(std::uint32_t& value, promise::Flag) { value = dice_.below(2); }
  void fill(std::int64_t& value, promise::Stamp) { dice_.fill(value); }
  template <class Enum>
  void fill(Enum& value, promise::OneOf promise) {
    value = static_cast<Enum>(dice_.below(promise.n));
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values, promise::Within promise) {
    for (T& value : values) fill(value, promise);
  }
  template <class T>
  void fill(T& value, promise::Within promise) {
    value = static_cast<T>(size(promise.limit) * dice_.real(-1, 1));
  }
  template <class T>
  void fill(T& value, promise::UpTo promise) {
    value = static_cast<T>(size(promise.limit) * dice_.real(0, 1));
  }
  void fill(double& value, promise::AboveZero promise) { value = size(promise.limit) * dice_.real(1e-3, 1); }
  template <std::size_t N>
  void fill(std::array<double, N>& values, promise::Unit promise) {
    if (promise.or_zero && dice_.below(4) == 0)
      values = {};
    else
      dice_.fill_unit(values);
  }
  template <std::size_t N>
  void fill(std::array<char, N>& text, promise::Text) {
    dice_.fill_text(text);
  }
  /// Up to the limit itself, now and then.
  double size(double limit) { return dice_.below(4) == 0 ? limit : std::min(limit, 10.0); }

  Dice& dice_;
  M& message_;
};

// What the rules between fields want. They come after the fields, whose counts stay as they are.
template <class M>
void keep_rules(Dice&, M&) {}
inline void keep_rules(Dice& dice, BodySurface& m) {
  m.n_chunks = std::max(m.n_chunks, 1U), m.n_vertices = std::max(m.n_vertices, 1U);
  m.chunk = dice.below(m.n_chunks);
  m.first_vertex = m.chunk * max_surface_vertices, m.first_facet = m.chunk * max_surface_facets;
  m.total_vertices =
      std::max(m.first_vertex + m.n_vertices, m.n_chunks * max_surface_vertices - dice.below(2000));
  m.total_facets = std::max(m.first_facet + m.n_facets, m.n_chunks * max_surface_facets - dice.below(2000));
  for (std::uint32_t i = 0; i < m.n_facets; ++i)
    for (std::uint32_t& corner : m.corners[i]) corner = dice.below(m.total_vertices);
}
inline void keep_rules(Dice& dice, SurfaceChange& m) {
  m.n_vertices = std::max(m.n_vertices, 1U), m.n_changes = std::max(m.n_changes, 1U);
  m.first_vertex = dice.below(1'000'000), m.first_change = m.page * max_change_facets;
  m.total_vertices = m.first_vertex + m.n_vertices + dice.below(1000);
  m.total_changes =
      std::min(m.first_change + m.n_changes + dice.below(1000), max_change_pages * max_change_facets);
  m.total_facets = dice.below(1'000'000);
  for (std::uint32_t i = 0; i < m.n_changes; ++i) {
    m.facets[i].facet = dice.below(1'000'000);
    for (std::uint32_t& corner : m.facets[i].corners) corner = dice.below(m.total_vertices);
  }
}
/// Changes that are complete with one page.
inline void make_whole(SurfaceChange& m) {
  m.page = m.first_change = 0;
  m.total_changes = m.n_changes;
  m.total_vertices = m.first_vertex + m.n_vertices;
  for (FacetChange& facet : m.facets)
    for (std::uint32_t& corner : facet.corners) corner %= m.total_vertices;
}
inline void keep_rules(Dice& dice, VertexBlock& m) {
  m.block = dice.below(max_surface_chunks);
  m.first_vertex = m.block * max_block_vertices;
  for (std::uint32_t i = 0; i < m.n_vertices; ++i)
    if ((m.flags[i] & vertex_yielded) == 0) m.flags[i] &= vertex_broken;
}
inline void keep_rules(Dice& dice, HapticTrace& m) {
  const std::uint64_t first = dice.integer() >> 1;
  for (std::uint32_t i = 0; i < m.n_samples; ++i) m.samples[i].tick = first + i;
}

template <class M>
void randomise(Dice& dice, M& message) {
  M::fields(Randomise<M>(dice, message));
  keep_rules(dice, message);
}

template <class M>
M random_message(std::uint64_t seed) {
  Dice dice(seed);
  M message;
  randomise(dice, message);
  return message;
}

}  // namespace palpate::test
