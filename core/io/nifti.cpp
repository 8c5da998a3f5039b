// NIfTI files through VTK's reader, which puts the slices of a left-handed image in the other order and says so in its matrix.
#include "core/io/oriented_image.hpp"

#include <charconv>
#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace ballast::io {
namespace {

/// What VTK would print, in one line: the first complaint of a reader.
class Complaint {
public:
  explicit Complaint(vtkAlgorithm* reader) {
    callback_->SetClientData(&text_);
    callback_->SetCallback([](vtkObject*, unsigned long, void* kept, void* said) {
      auto& text = *static_cast<std::string*>(kept);
      if (text.empty() && said != nullptr) {
        text = last_line(static_cast<const char*>(said));
      }
    });
    reader->AddObserver(vtkCommand::ErrorEvent, callback_);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, callback_);
  }
  const std::string& text() const { return text_; }

private:
  /// "ERROR: In file, line 1\nvtkReader (0x...): what\n\n" is a reader's way to say "what".
  static std::string last_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) {
      text.pop_back();
    }
    text = text.substr(text.find_last_of('\n') + 1);
    const std::size_t name = text.find("): ");
    return name == std::string::npos ? text : text.substr(name + 3);
  }

  std::string text_;
  vtkNew<vtkCallbackCommand> callback_;
};

/// Values of a reader that has its information; refuses more than one a voxel.
void take_values(vtkImageReader2* reader, const Complaint& complaint, OrientedImage& image) {
  if (complaint.text().empty() && image.problem.empty()) {
    reader->Update();
  }
  if (!complaint.text().empty()) {
    image.refuse(complaint.text(), "a whole file");
  }
  if (!image.problem.empty()) {
    return;
  }
  vtkImageData* data = reader->GetOutput();
  vtkDataArray* values = data->GetPointData()->GetScalars();
  if (values == nullptr || values->GetNumberOfComponents() != 1) {
    image.refuse(fmt::format("it has {} numbers a voxel", values == nullptr ? 0 : values->GetNumberOfComponents()), "one label a voxel");
    return;
  }
  for (int a = 0; a < 3; ++a) {
    image.size[static_cast<std::size_t>(a)] = static_cast<std::size_t>(data->GetDimensions()[a]);
  }
  switch (values->GetDataType()) {
    vtkTemplateMacro(take_labels(static_cast<const VTK_TT*>(values->GetVoidPointer(0)), image));
  default:
    image.refuse(fmt::format("its values are of the type {}", values->GetDataTypeAsString()), "whole numbers");
  }
}

/// The shortest decimal number of a float32: 0.7 in a header is 0.7 m, to the last bit.
double decimal(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<float>(value));
  double out = value;
  std::from_chars(text, end.ptr, out);
  return out;
}

} // namespace

OrientedImage read_nifti(const std::string& path) {
  OrientedImage image;
  vtkNew<vtkNIFTIImageReader> reader;
  const Complaint complaint(reader);
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  if (complaint.text().empty() && reader->GetTimeDimension() > 1) {
    image.refuse(fmt::format("it has {} times", reader->GetTimeDimension()), "one image");
  }
  const double slope = reader->GetRescaleSlope(), shift = reader->GetRescaleIntercept();
  if ((slope != 0 && slope != 1) || (slope != 0 && shift != 0)) {
    image.refuse(fmt::format("its values are to be scaled by {:g} and shifted by {:g}", slope, shift), "labels as they are: scl_slope 1 or 0, scl_inter 0");
  }
  vtkNew<vtkMatrix4x4> plain;
  vtkMatrix4x4* place = reader->GetSFormMatrix() != nullptr   ? reader->GetSFormMatrix()
                        : reader->GetQFormMatrix() != nullptr ? reader->GetQFormMatrix()
                                                              : plain.Get();
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    image.first[at] = decimal(place->GetElement(a, 3));
    for (int k = 0; k < 3; ++k) {
      image.step[at][static_cast<std::size_t>(k)] = decimal(place->GetElement(k, a) * reader->GetDataSpacing()[a]);
    }
  }
  take_values(reader, complaint, image);
  return image;
}

} // namespace ballast::io
