#include "deploy/import/read_itk.h"

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include "common/error/error.h"
#include "deploy/import/quiet_stderr.h"

namespace palpate {
namespace {

using Image = itk::Image<float, 3>;

const char* name_of(ItkFormat format) {
  switch (format) {
    case ItkFormat::nifti:
      return "NIfTI";
    case ItkFormat::nrrd:
      return "NRRD";
    case ItkFormat::meta:
      return "MetaImage";
    case ItkFormat::dicom:
      return "DICOM";
  }
  return "";
}

itk::ImageIOBase::Pointer reader_of(ItkFormat format) {
  switch (format) {
    case ItkFormat::nifti:
      return itk::NiftiImageIO::New().GetPointer();
    case ItkFormat::nrrd:
      return itk::NrrdImageIO::New().GetPointer();
    case ItkFormat::meta:
      return itk::MetaImageIO::New().GetPointer();
    case ItkFormat::dicom:
      return itk::GDCMImageIO::New().GetPointer();
  }
  return nullptr;
}

ItkHeader header_of(const itk::ImageIOBase& io) {
  constexpr itk::SizeValueType size_limit = 2'000'000'000;  // absurd already; keeps the cast defined
  ItkHeader header;
  header.components = io.GetNumberOfComponents();
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    header.size.push_back(static_cast<std::int64_t>(std::min(io.GetDimensions(axis), size_limit)));
    if (axis >= 3) continue;
    header.spacing_mm[axis] = io.GetSpacing(axis);
    header.origin_mm[axis] = io.GetOrigin(axis);
    const auto direction = io.GetDirection(axis);
    for (unsigned row = 0; row < 3 && row < direction.size(); ++row)
      header.direction[3 * row + axis] = direction[row];
  }
  return header;
}

}  // namespace

std::vector<float> read_itk(const std::string& path, ItkFormat format,
                            const std::function<void(const ItkHeader&)>& check) {
  const QuietStderr quiet;
  const std::string damaged =
      path + ": cannot be read as " + name_of(format) + ", damaged or truncated; fetch a whole copy";
  try {
    const auto io = reader_of(format);
    if (!io->CanReadFile(path.c_str())) throw InputError(damaged);
    io->SetFileName(path);
    io->ReadImageInformation();
    check(header_of(*io));
    const auto reader = itk::ImageFileReader<Image>::New();
    reader->SetImageIO(io);
    reader->SetFileName(path);
    reader->Update();
    const Image& image = *reader->GetOutput();
    const float* cells = image.GetBufferPointer();
    return {cells, cells + image.GetLargestPossibleRegion().GetNumberOfPixels()};
  } catch (
      const itk::
          ExceptionObject&) {  // its texts have addresses and line numbers of ITK; of no help to a person
    throw InputError(damaged);
  }
}

std::vector<DicomSeries> dicom_series_in(const std::string& folder) {
  const QuietStderr quiet;
  try {
    const auto names = itk::GDCMSeriesFileNames::New();
    names->SetGlobalWarningDisplay(false);
    names->SetInputDirectory(folder);
    std::vector<DicomSeries> series;
    for (const auto& id : names->GetSeriesUIDs()) series.push_back({id, names->GetFileNames(id)});
    return series;
  } catch (const itk::ExceptionObject&) {
    throw InputError(folder + ": its DICOM files cannot be read; fetch whole copies");
  }
}

}  // namespace palpate
