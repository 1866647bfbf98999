#include <gracilis/io/run/paraview_script.hpp>

namespace gracilis {

std::string paraview_script(const Scene& scene) {
  std::string names;
  for (const Bone& bone : scene.bones) names += "    '" + bone.name + "',\n";
  return R"(# Shows this run in ParaView: File > Load State, or `paraview --script=paraview.py`.
import os
from paraview.simple import *

folder = os.path.dirname(os.path.abspath(__file__))
bones = [
)" + names +
         R"(]

muscles = PVDReader(registrationName='muscles', FileName=os.path.join(folder, 'run.pvd'))
move = '''
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
frame, bone = inputs[0].VTKObject, inputs[1].VTKObject
numbers = frame.GetFieldData().GetArray('motion_of_' + name)
matrix = vtkMatrix4x4()
for i in range(12):
    matrix.SetElement(i % 3, i // 3, numbers.GetValue(i))
transform = vtkTransform()
transform.SetMatrix(matrix)
mover = vtkTransformPolyDataFilter()
mover.SetInputData(bone)
mover.SetTransform(transform)
mover.Update()
output.ShallowCopy(mover.GetOutput())
'''

view = GetActiveViewOrCreate('RenderView')
ColorBy(Show(muscles, view), ('CELLS', 'part'))
for bone in bones:
    at_rest = XMLPolyDataReader(registrationName=bone + ' at rest',
                                FileName=[os.path.join(folder, 'bones', bone + '.vtp')])
    # The muscles first: a filter has the times of its first input.
    moved = ProgrammableFilter(registrationName=bone, Input=[muscles, at_rest])
    moved.OutputDataSetType = 'vtkPolyData'
    moved.Script = 'name = %r' % bone + move
    display = Show(moved, view)
    display.ColorArrayName = [None, '']
    display.DiffuseColor = [0.96, 0.92, 0.82]
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
ResetCamera(view)
)";
}

}  // namespace gracilis
