#include <Eigen/LU>
#include <charconv>
#include <cmath>
#include <new>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/record/volume.h"
#include "common/record/volume_check.h"
#include "common/record/volume_facts.h"

namespace palpate {
namespace {

constexpr std::uint64_t transfer_points_limit = 4096;
constexpr double index_limit = 1e9;  // far above any size; keeps casts to integers defined

/// Reads the parts of a file that may be anybody's: each is looked at before it is believed.
class VolumeReader {
 public:
  explicit VolumeReader(const std::string& path) : path_(path), file_(path, Hdf5File::Mode::read) {}

  VolumeFacts facts() {
    check_format();
    VolumeFacts facts{size_of_intensity(), vector("spacing_m")};
    check_spacing(path_, facts.spacing);
    return facts;
  }

  Volume read() {
    Volume volume;
    const VolumeFacts said = facts();
    volume.size = said.size;
    volume.spacing = said.spacing;
    volume.origin = vector("origin_m");
    if (!volume.origin.allFinite()) complain("its origin is not finite");
    if (file_.has_attribute("orientation_lps")) volume.orientation = orientation();
    volume.source = file_.text("source");
    volume.source_checksum = checksum();
    volume.source_size = sizes("source_size");
    if (sizes("partition") != volume.size) complain("its partition does not match the shape of /intensity");
    volume.transfer = transfer();
    volume.intensity = file_.read<float>("/intensity");
    check_intensity(path_, volume.intensity);
    return volume;
  }

 private:
  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(path_ + ": " + what + "; import the image again");
  }

  void check_format() const {
    if (!file_.has_attribute("format") || file_.text("format") != "palpate volume")
      throw InputError(path_ + ": is HDF5, but not a palpate volume; make one with palpate import");
    const auto version = numbers("version", 1);
    if (version[0] != 1) complain("is of another version than 1");
  }

  std::vector<double> numbers(const std::string& name, std::size_t n) const {
    auto values = file_.numbers(name);
    if (values.size() != n)
      complain("its attribute " + name + " should have " + std::to_string(n) + " numbers");
    return values;
  }

  Eigen::Vector3d vector(const std::string& name) const {
    const auto values = numbers(name, 3);
    return {values[0], values[1], values[2]};
  }

  std::array<int, 3> sizes(const std::string& name) const {
    std::array<std::int64_t, 3> size{};
    const auto values = numbers(name, 3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(std::abs(values[axis]) <= index_limit)) complain("its attribute " + name + " is absurd");
      size[axis] = static_cast<std::int64_t>(values[axis]);
    }
    return check_size(path_, size);
  }

  std::array<int, 3> size_of_intensity() const {
    const auto shape = file_.shape("/intensity");
    if (shape.size() != 3) complain("its /intensity does not have three axes");
    std::array<std::int64_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      size[axis] = static_cast<std::int64_t>(std::min<std::uint64_t>(shape[2 - axis], volume_cells_limit));
    return check_size(path_, size);
  }

  /// The columns must be directions: of length 1 and not in one plane. Left-handed is allowed: some formats mirror y.
  Eigen::Matrix3d orientation() const {
    const auto rows = numbers("orientation_lps", 9);
    Eigen::Matrix3d matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
    const bool unit = ((matrix.colwise().norm().array() - 1).abs() < 1e-3).all();
    if (!matrix.allFinite() || !unit || std::abs(matrix.determinant()) < 0.5)
      complain("the columns of its orientation_lps are not directions");
    return matrix;
  }

  std::uint64_t checksum() const {
    const auto text = file_.text("source_checksum");
    std::uint64_t value = 0;
    const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (trouble != std::errc() || end != text.data() + text.size())
      complain("its source_checksum is not hexadecimal");
    return value;
  }

  std::vector<TransferPoint> transfer() const {
    const auto shape = file_.shape("/transfer");
    if (shape.size() != 2 || shape[1] != 5 || shape[0] > transfer_points_limit)
      complain("its /transfer is not a list of intensity, red, green, blue, opacity");
    const auto rows = file_.read<double>("/transfer");
    std::vector<TransferPoint> points(shape[0]);
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = {rows[5 * i], {rows[5 * i + 1], rows[5 * i + 2], rows[5 * i + 3], rows[5 * i + 4]}};
    check_transfer(path_, points);
    return points;
  }

  std::string path_;
  Hdf5File file_;
};

}  // namespace

namespace {

/// What `use` makes of the file. @throws InputError for whatever is wrong with it
template <class Use>
auto of_file(const std::string& path, const Use& use) {
  try {
    return use(path);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw InputError(path +
                     ": is too large for the memory of this machine; import it with a coarser --partition");
  } catch (const std::runtime_error& error) {  // of Hdf5File, which names the file
    throw InputError(std::string(error.what()) + "; a volume made by palpate import is wanted");
  }
}

}  // namespace

VolumeFacts volume_facts(const std::string& path) {
  return of_file(path, [](const std::string& file) { return VolumeReader(file).facts(); });
}

Volume read_volume(const std::string& path) {
  return of_file(path, [](const std::string& file) { return VolumeReader(file).read(); });
}

}  // namespace palpate
