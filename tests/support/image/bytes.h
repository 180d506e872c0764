#pragma once
// Bytes and files, for images written by hand: independent of the libraries that read them.

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace palpate::test {

using Bytes = std::string;

/// The bytes of a value as it lies in memory (little-endian on the machines we build for).
template <class T>
Bytes bytes_of(T value) {
  Bytes bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Overwrites bytes in the middle.
template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  bytes.replace(at, sizeof(T), bytes_of(value));
}

inline void write_file(const std::string& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline Bytes file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline Bytes first_bytes(const Bytes& bytes, std::size_t n) { return bytes.substr(0, n); }

using NamedBytes = std::vector<std::pair<std::string, Bytes>>;

Bytes gzipped(const Bytes& bytes);
Bytes tarred(const NamedBytes& entries);

/// The entry of a .tar.gz file whose name ends so.
Bytes entry_of_tar_gz(const std::string& path, const std::string& name);

}  // namespace palpate::test
