#pragma once
// The one door to HDF5: files, groups, datasets and attributes, closed by themselves. HDF5 1.10 in Debian has one
// global lock, so record from a slow thread only. Everything throws std::runtime_error naming the file.
//
// A writer that is killed leaves a file that is readable up to its last flush(): the format is the plain one without
// an "open for writing" mark, and growing datasets are not deflated, so that a chunk never moves once it is on disk.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace palpate {

class Hdf5File {
 public:
  enum class Mode { read, create };  // create: an existing file is emptied
  Hdf5File(const std::string& path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Parents are made as needed, here and in the datasets' paths.
  void make_group(const std::string& path);
  bool has(const std::string& path) const;
  std::vector<std::uint64_t> shape(const std::string& path) const;

  // Whole datasets, row major, chunked and deflated when large. T: float, double, int16, uint8, int32, uint32, uint64.
  template <class T>
  void write(const std::string& path, const std::vector<std::uint64_t>& shape, const T* data);
  /// The numbers converted to T; look at shape() first where the file may be anybody's.
  template <class T>
  std::vector<T> read(const std::string& path) const;

  // Growing datasets: rows of fixed shape appended at the end.
  template <class T>
  void make_series(const std::string& path, const std::vector<std::uint64_t>& row_shape);
  template <class T>
  void append(const std::string& path, const T* row);

  // Attributes of the root group: text up to 60 kB, up to 4096 numbers.
  void set_text(const std::string& name, const std::string& value);
  void set_numbers(const std::string& name, const std::vector<double>& values);
  std::string text(const std::string& name) const;             // throws if absent
  std::vector<double> numbers(const std::string& name) const;  // throws if absent
  bool has_attribute(const std::string& name) const;

  /// All that was written so far reaches the file.
  void flush();
  /// Closes early; throws where the disk did not take everything, which the destructor cannot say.
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::int64_t checked(std::int64_t status, const std::string& what) const;  // throws if negative

  std::string path_;
  std::int64_t file_ = -1;
  std::map<std::string, std::int64_t>
      series_;  // growing datasets stay open, so that their chunks stay in memory
};

}  // namespace palpate
