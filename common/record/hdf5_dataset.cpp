// Datasets: whole and growing.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/record/hdf5_file.h"
#include "common/record/hdf5_handle.h"

namespace palpate {
namespace {

using hdf5::Handle;
using Shape = std::vector<std::uint64_t>;

constexpr std::uint64_t deflate_from_bytes = 64 * 1024;  // smaller datasets are stored as they are
constexpr std::uint64_t chunk_bytes = 512 * 1024;        // of whole datasets
constexpr std::uint64_t series_chunk_bytes =
    64 * 1024;  // of growing ones: about this much is rewritten by a flush
constexpr unsigned deflate_level = 2;
constexpr std::uint64_t deflate_at_most =
    1100;  // no deflated byte can stand for more (RFC 1951: 258 bytes in 2 bits)

std::uint64_t product(const Shape& shape) {
  std::uint64_t n = 1;
  for (const auto extent : shape) n *= extent;
  return n;
}

std::vector<hsize_t> extents_of(const Shape& shape) { return {shape.begin(), shape.end()}; }

/// Whole trailing axes, and as many of the leading ones as the chunk size allows.
std::vector<hsize_t> chunk_of(const Shape& shape, std::uint64_t bytes) {
  std::vector<hsize_t> chunk(shape.size(), 1);
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    chunk[axis] = std::clamp<hsize_t>(chunk_bytes / bytes, 1, shape[axis]);
    bytes *= chunk[axis];
  }
  return chunk;
}

Handle with_parents() {
  Handle creation(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(creation.get(), 1);
  return creation;
}

Handle open_dataset(hid_t file, const std::string& path) {
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
}

Shape shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank <= 0) return {};
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

/// A small file that claims to hold gigabytes does not: asked before memory is taken.
bool holds_its_shape(hid_t dataset, const Shape& shape) {
  std::uint64_t least = 1;  // bytes that this many numbers need, deflated as well as can be
  for (const auto extent : shape) {
    if (extent == 0) return true;
    if (least > std::numeric_limits<std::uint64_t>::max() / extent) return false;
    least *= extent;
  }
  return least / deflate_at_most <= H5Dget_storage_size(dataset);
}

H5T_class_t class_of(hid_t dataset) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type.get());
}

}  // namespace

Shape Hdf5File::shape(const std::string& path) const {
  hdf5::hush();
  const Handle dataset = open_dataset(file_, path);
  checked(dataset.get(), "there is no sound dataset " + path);
  return shape_of(dataset.get());
}

template <class T>
void Hdf5File::write(const std::string& path, const Shape& shape, const T* data) {
  hdf5::hush();
  const auto extents = extents_of(shape);
  const Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const bool large = product(shape) * sizeof(T) > deflate_from_bytes;
  const bool checked_chunks = mode_ == Mode::record && product(shape) > 0;
  if (large || checked_chunks)
    H5Pset_chunk(creation.get(), static_cast<int>(extents.size()), chunk_of(shape, sizeof(T)).data());
  if (large) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), deflate_level);
  }
  if (checked_chunks) H5Pset_fletcher32(creation.get());
  const Handle links = with_parents();
  const Handle dataset(H5Dcreate2(file_, path.c_str(), hdf5::type_of<T>(), space.get(), links.get(),
                                  creation.get(), H5P_DEFAULT),
                       H5Dclose);
  checked(dataset.get(), "cannot make the dataset " + path);
  checked(H5Dwrite(dataset.get(), hdf5::type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data),
          "cannot write the dataset " + path);
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& path, std::uint64_t most) const {
  hdf5::hush();
  const Handle dataset = open_dataset(file_, path);
  checked(dataset.get(), "there is no sound dataset " + path);
  const H5T_class_t kind = class_of(dataset.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) fail("dataset " + path + " is not made of numbers");
  const Shape shape = shape_of(dataset.get());
  if (!holds_its_shape(dataset.get(), shape)) fail("dataset " + path + " holds less than its shape");
  if (product(shape) > most)
    fail(fmt::format("dataset {} has {} numbers; at most {}", path, product(shape), most));
  std::vector<T> values(product(shape));
  if (values.empty()) return values;
  checked(H5Dread(dataset.get(), hdf5::type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "cannot read the dataset " + path + ": damaged or truncated");
  return values;
}

std::string Hdf5File::read_text(const std::string& path, std::uint64_t most_bytes) const {
  const auto bytes = read<std::uint8_t>(path, most_bytes);
  return {bytes.begin(), bytes.end()};
}

template <class T>
std::vector<T> Hdf5File::read_rows(const std::string& path, std::uint64_t first, std::uint64_t n,
                                   std::uint64_t width) const {
  hdf5::hush();
  const Handle dataset = open_dataset(file_, path);
  checked(dataset.get(), "there is no sound dataset " + path);
  const Shape shape = shape_of(dataset.get());
  if (!holds_its_shape(dataset.get(), shape)) fail("dataset " + path + " holds less than its shape");
  auto count = extents_of(shape);
  if (count.empty() || n > count[0] || first > count[0] - n) fail("dataset " + path + " has fewer rows");
  const std::uint64_t found = product({shape.begin() + 1, shape.end()});
  if (width != no_limit && found != width)
    fail(fmt::format("dataset {} has {} numbers in a row; {} are wanted", path, found, width));
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = first;
  count[0] = n;
  std::vector<T> values(product({count.begin(), count.end()}));
  if (values.empty()) return values;
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  checked(H5Dread(dataset.get(), hdf5::type_of<T>(), memory.get(), space.get(), H5P_DEFAULT, values.data()),
          "damaged or truncated in dataset " + path + fmt::format(", rows {} to {}", first, first + n - 1));
  return values;
}

template <class T>
void Hdf5File::make_series(const std::string& path, const Shape& row_shape) {
  hdf5::hush();
  Shape shape = row_shape;
  shape.insert(shape.begin(), 0);
  const auto first = extents_of(shape);
  auto most = first, chunk = first;
  most[0] = H5S_UNLIMITED;
  const std::uint64_t row_bytes = std::max<std::uint64_t>(1, product(row_shape) * sizeof(T));
  chunk[0] = std::max<std::uint64_t>(1, series_chunk_bytes / row_bytes);
  const Handle space(H5Screate_simple(static_cast<int>(first.size()), first.data(), most.data()), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  // Only chunks that are written once are deflated: one that grows would leave its older self behind in the file.
  if (chunk[0] == 1) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), deflate_level);
  }
  H5Pset_fletcher32(creation.get());
  const Handle links = with_parents();
  Handle dataset(H5Dcreate2(file_, path.c_str(), hdf5::type_of<T>(), space.get(), links.get(), creation.get(),
                            H5P_DEFAULT),
                 H5Dclose);
  checked(dataset.get(), "cannot make the series " + path);
  series_[path] = dataset.release();
}

template <class T>
void Hdf5File::append(const std::string& path, const T* rows, std::uint64_t n_rows) {
  hdf5::hush();
  if (n_rows == 0) return;
  const auto found = series_.find(path);
  if (found == series_.end()) fail("there is no series " + path);
  auto extents = extents_of(shape_of(found->second));
  std::vector<hsize_t> start(extents.size(), 0), count = extents;
  start[0] = extents[0];
  count[0] = n_rows;
  extents[0] += n_rows;
  checked(H5Dset_extent(found->second, extents.data()), "cannot grow the series " + path);
  const Handle space(H5Dget_space(found->second), H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  checked(H5Dwrite(found->second, hdf5::type_of<T>(), memory.get(), space.get(), H5P_DEFAULT, rows),
          "cannot append to the series " + path);
}

#define PALPATE_INSTANTIATE(T)                                                                     \
  template void Hdf5File::write<T>(const std::string&, const Shape&, const T*);                    \
  template std::vector<T> Hdf5File::read<T>(const std::string&, std::uint64_t) const;              \
  template std::vector<T> Hdf5File::read_rows<T>(const std::string&, std::uint64_t, std::uint64_t, \
                                                 std::uint64_t) const;                             \
  template void Hdf5File::make_series<T>(const std::string&, const Shape&);                        \
  template void Hdf5File::append<T>(const std::string&, const T*, std::uint64_t);
PALPATE_INSTANTIATE(float)
PALPATE_INSTANTIATE(double)
PALPATE_INSTANTIATE(std::int16_t)
PALPATE_INSTANTIATE(std::uint8_t)
PALPATE_INSTANTIATE(std::int32_t)
PALPATE_INSTANTIATE(std::uint32_t)
PALPATE_INSTANTIATE(std::uint64_t)
#undef PALPATE_INSTANTIATE

}  // namespace palpate
