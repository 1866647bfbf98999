#pragma once

#include <gracilis/view/pictures/palette.hpp>
#include <gracilis/view/window/glyphs.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <vtkSmartPointer.h>

#include <vector>

class vtkActor;
class vtkPolyData;
class vtkRenderer;
class vtkTexture;

namespace gracilis {

/// Something that is drawn, and what it is made of. For the thread of the window only.
struct SurfaceActor {
  vtkSmartPointer<vtkPolyData> data;
  vtkSmartPointer<vtkActor> actor;
};

/// Smoothly shaded triangles, added to the renderer.
SurfaceActor add_surface(const ShownPoints& points, const Eigen::Matrix3Xi& faces, const Color& color,
                         vtkRenderer& renderer);

/// An actor without shape yet, added to the renderer; `lit`: by the lights, otherwise in its plain color.
SurfaceActor add_empty(bool lit, vtkRenderer& renderer);

/// Moves the points, as many as before, and turns the normals with them.
void move_points(const ShownPoints& points, const Eigen::Matrix3Xi& faces, SurfaceActor& surface);

/// Replaces points, faces and colors.
void set_shape(const ColoredMesh& mesh, SurfaceActor& surface);

/// One color per point; none: the actor's own.
void set_point_colors(const std::vector<Color>& colors, SurfaceActor& surface);

/// Stripes along fibers, by where each point lies across them (m); none: without. `texture`: of stripes.
void set_stripes(const std::vector<Real>& stripes, vtkTexture& texture, SurfaceActor& surface);

/// Lines as tubes of a radius (m), with a color per line where there are any.
void set_tubes(const Polylines& lines, Real radius, const std::vector<Color>& colors, SurfaceActor& surface);

}  // namespace gracilis
