#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error/error.h"
#include "common/record/dataset_list.h"
#include "common/record/hdf5_file.h"
#include "deploy/palpate/info.h"

namespace palpate::deploy {

bool is_volume(const std::string& path) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    return file.has_attribute("format") && file.text("format") == "palpate volume";
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error&) {
    throw InputError(fmt::format("{}: is not an HDF5 file, or was cut short; write it again", path));
  }
}

std::string info_record(const std::string& path) {
  const auto datasets = list_datasets(path);
  std::string text = fmt::format("record       {}\n", path);
  if (Hdf5File(path, Hdf5File::Mode::read).cut_short())
    text += fmt::format(
        "cut short    its writer runs still, or was killed; palpate info --mend {} lets other programs open "
        "it\n",
        path);
  for (const DatasetFacts& dataset : datasets)
    text += fmt::format("{:<12} {}\n", fmt::format("{}", fmt::join(dataset.shape, " x ")), dataset.path);
  return text;
}

}  // namespace palpate::deploy
