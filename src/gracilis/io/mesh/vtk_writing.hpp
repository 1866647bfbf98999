#pragma once

#include <filesystem>

class vtkDataObject;
class vtkXMLWriter;

namespace gracilis {

/// Writes a file of VTK's by its writer, whole or not at all: binary, and compressed in little time. Throws InputError
/// with the reason in a few words.
void write_by_vtk(const std::filesystem::path& path, vtkXMLWriter& writer, vtkDataObject& data);

}  // namespace gracilis
