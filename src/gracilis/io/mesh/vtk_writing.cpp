#include <gracilis/io/mesh/vtk_writing.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/vtk_messages.hpp>

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkXMLWriter.h>

#include <string>

namespace gracilis {

void write_by_vtk(const std::filesystem::path& path, vtkXMLWriter& writer, vtkDataObject& data) {
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    VtkMessages messages;
    writer.SetFileName(temporary.c_str());
    writer.SetInputData(&data);
    writer.SetDataModeToAppended();
    writer.EncodeAppendedDataOff();
    writer.SetCompressorTypeToLZ4();
    writer.SetIdTypeToInt32();
    const bool written = writer.Write() == 1 && writer.GetErrorCode() == vtkErrorCode::NoError;
    if (written && !messages.has_errors()) return;
    const std::string reason = writer.GetErrorCode() != vtkErrorCode::NoError
                                   ? vtkErrorCode::GetStringFromErrorCode(writer.GetErrorCode())
                                   : messages.first_error();
    throw InputError({path.string(), "", "cannot be written: " + reason,
                      "check the folder's permissions and the free space of the disk"});
  });
}

}  // namespace gracilis
