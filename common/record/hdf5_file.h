#pragma once
// The one door to HDF5: files, groups, datasets and attributes, closed by themselves. HDF5 1.10 in Debian has one
// global lock, so record from a slow thread only. Everything throws std::runtime_error naming the file.
//
// Volumes are written in the oldest format (create), records in the newest (record): there every dataset and all that
// describes it carries checksums, so that a flipped byte is found by who reads it, and after start() the file can be read at any moment,
// also when its writer has been killed, up to its last flush() (HDF5's single writer, multiple readers). What was killed
// keeps the mark "open for writing", which other programs refuse: mend() takes it off.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace palpate {

class Hdf5File {
 public:
  static constexpr std::uint64_t no_limit = ~std::uint64_t{0};
  enum class Mode { read, create, record };  // create, record: a new file instead of what is there
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
  /// @param most  numbers; @throws if there are more, before any is read
  template <class T>
  std::vector<T> read(const std::string& path, std::uint64_t most = no_limit) const;

  /// A text that is stored as bytes. @throws if it has more than `most_bytes`, before any is read
  std::string read_text(const std::string& path, std::uint64_t most_bytes) const;

  /// Some rows of a dataset, along its first axis. @throws if it has fewer
  /// @param width  numbers of a row; @throws if it has another number of them, before any is read
  template <class T>
  std::vector<T> read_rows(const std::string& path, std::uint64_t first, std::uint64_t n,
                           std::uint64_t width = no_limit) const;

  // Growing datasets: rows of fixed shape appended at the end. Rows of more than 64 KiB are deflated.
  template <class T>
  void make_series(const std::string& path, const std::vector<std::uint64_t>& row_shape);
  template <class T>
  void append(const std::string& path, const T* rows, std::uint64_t n_rows = 1);

  // Attributes of the root group: text up to 60 kB, up to 4096 numbers.
  void set_text(const std::string& name, const std::string& value);
  void set_numbers(const std::string& name, const std::vector<double>& values);
  std::string text(const std::string& name) const;             // throws if absent
  std::vector<double> numbers(const std::string& name) const;  // throws if absent
  bool has_attribute(const std::string& name) const;

  /// Of a record: all datasets and attributes have been made; from now on rows are appended, and others may read.
  void start();
  /// The writer of this file has not closed it: it writes still, or was killed.
  bool cut_short() const noexcept { return cut_short_; }

  /// All that was written so far reaches the file.
  void flush();
  /// Closes early; throws where the disk did not take everything, which the destructor cannot say.
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::int64_t checked(std::int64_t status, const std::string& what) const;  // throws if negative

  std::string path_;
  Mode mode_;
  bool cut_short_ = false;
  std::int64_t file_ = -1;
  std::map<std::string, std::int64_t>
      series_;  // growing datasets stay open, so that their chunks stay in memory
};

/// Takes the mark "open for writing" off a record whose writer was killed, so that other programs open it.
/// @throws InputError: no record, may not be written, damaged
void mend(const std::string& path);

}  // namespace palpate
