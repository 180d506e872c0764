// Data and binaries are made or fetched, never kept: a clone stays small and every byte in it can be read.
#include <regex>

#include "tests/house/house_rules.h"

namespace palpate::house {

std::vector<std::string> data_breaches(const SourceFile& file) {
  static const std::regex data(
      "\\.(nii|gz|bz2|xz|zst|zip|tar|tgz|dcm|h5|hdf5|nrrd|nhdr|mha|mhd|raw|inr|inv3|dat|vtk|vti|npy|npz|"
      "so|a|o|d|exe|dll|deb|bin|pyc|whl|pdf)(\\.[0-9.]+)?$",
      std::regex::icase);
  static const std::regex picture("\\.png$");
  constexpr std::uintmax_t most_bytes = 1024 * 1024;
  std::vector<std::string> breaches;
  if (std::regex_search(file.path, data))
    breaches.push_back(file.path + ":1: a data or built file; make or fetch it when it is needed");
  else if (!file.is_text && !std::regex_search(file.path, picture))
    breaches.push_back(file.path + ":1: not a text; only PNG pictures may be binary");
  if (file.bytes > most_bytes) breaches.push_back(file.path + ":1: above 1 MiB; keep the repository small");
  return breaches;
}

}  // namespace palpate::house
