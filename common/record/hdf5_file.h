#pragma once
// The one door to HDF5: files, groups, datasets and attributes, closed by themselves. HDF5 1.10 in Debian has one
// global lock, so record from a slow thread only. Everything throws std::runtime_error naming the file.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate {

class Hdf5File {
 public:
  enum class Mode { read, create };
  Hdf5File(const std::string& path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void make_group(const std::string& path);
  bool has(const std::string& path) const;
  std::vector<std::uint64_t> shape(const std::string& path) const;

  // Whole datasets, row major, chunked and deflated when large. T: float, double, int16, uint8, int32, uint32, uint64.
  template <class T> void write(const std::string& path, const std::vector<std::uint64_t>& shape, const T* data);
  template <class T> std::vector<T> read(const std::string& path) const;

  // Growing datasets: rows of fixed shape appended at the end.
  template <class T> void make_series(const std::string& path, const std::vector<std::uint64_t>& row_shape);
  template <class T> void append(const std::string& path, const T* row);

  // Attributes of the root group.
  void set_text(const std::string& name, const std::string& value);
  void set_numbers(const std::string& name, const std::vector<double>& values);
  std::string text(const std::string& name) const;                 // throws if absent
  std::vector<double> numbers(const std::string& name) const;      // throws if absent
  bool has_attribute(const std::string& name) const;

  void flush();

 private:
  std::string path_;
  std::int64_t file_ = -1;
};

}  // namespace palpate
