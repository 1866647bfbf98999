#include <gracilis/io/mesh/tetrahedra_writer.hpp>

#include <gracilis/io/mesh/vtk_writing.hpp>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace gracilis {

static void add_cell_arrays(const Tetrahedra& tetrahedra, vtkUnstructuredGrid& grid) {
  vtkNew<vtkIntArray> compartment;
  vtkNew<vtkDoubleArray> density, volume, mass;
  compartment->SetName("compartment");
  density->SetName("density_kg_m3");
  volume->SetName("volume_m3");
  mass->SetName("mass_kg");
  for (Eigen::Index cell = 0; cell < tetrahedra.cells.cols(); ++cell) {
    const bool tendon = tetrahedra.compartments[static_cast<std::size_t>(cell)] == Compartment::tendon;
    const Real per_volume = tendon ? tendon_density : muscle_density, size = cell_volume(tetrahedra, cell);
    compartment->InsertNextValue(tendon ? 1 : 0);
    density->InsertNextValue(per_volume);
    volume->InsertNextValue(size);
    mass->InsertNextValue(per_volume * size);
  }
  grid.GetCellData()->AddArray(compartment);
  for (vtkDoubleArray* array : {density.GetPointer(), volume.GetPointer(), mass.GetPointer()})
    grid.GetCellData()->AddArray(array);
}

void write_tetrahedra(const std::filesystem::path& path, const Tetrahedra& tetrahedra) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3 point : tetrahedra.points.colwise()) points->InsertNextPoint(point.data());
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->Allocate(tetrahedra.cells.cols());
  for (const Eigen::Vector4i cell : tetrahedra.cells.colwise()) {
    const vtkIdType corners[4] = {cell[0], cell[1], cell[2], cell[3]};
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  add_cell_arrays(tetrahedra, *grid);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_by_vtk(path, *writer, *grid);
}

}  // namespace gracilis
