// SPDX-License-Identifier: MIT
// VTK: vtkLoopSubdivisionFilter. It refines; it knows no limit points and no normals. Its points are float
// whatever it is given.
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkLoopSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <string>

#include "verify/peers/refining_subject.h"

namespace {

using namespace limitcheck::verify;

class VtkMesh {
 public:
  explicit VtkMesh(const lc_mesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(mesh.vertex_count);
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v) points->SetPoint(v, mesh.positions + 3 * v);
    vtkNew<vtkCellArray> faces;
    for (std::int64_t f = 0; f < mesh.triangle_count; ++f) {
      const std::int32_t* t = mesh.triangles + 3 * f;
      faces->InsertNextCell({t[0], t[1], t[2]});
    }
    mesh_->SetPoints(points);
    mesh_->SetPolys(faces);
  }

  void refine() {
    // VTK tells of errors through an event, without it on standard error; its output is empty then.
    std::string error;
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(&error);
    listener->SetCallback([](vtkObject*, unsigned long, void* text, void* message) {
      *static_cast<std::string*>(text) = message ? static_cast<const char*>(message) : "an error";
    });
    vtkNew<vtkLoopSubdivisionFilter> loop;
    loop->AddObserver(vtkCommand::ErrorEvent, listener);
    loop->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
    loop->SetNumberOfSubdivisions(1);
    loop->SetInputData(mesh_);
    loop->Update();
    for (char& c : error)
      if (c == '\n') c = ' ';
    if (!error.empty()) throw SubjectError(LC_INVALID_INPUT, "VTK: " + error);
    if (loop->GetOutput()->GetNumberOfCells() != 4 * mesh_->GetNumberOfCells())
      throw SubjectError(LC_FAILED, "VTK returns " + std::to_string(loop->GetOutput()->GetNumberOfCells()) +
                                        " triangles for " + std::to_string(mesh_->GetNumberOfCells()) +
                                        ", without a word");
    mesh_->ShallowCopy(loop->GetOutput());
  }
  std::int64_t vertex_count() const { return mesh_->GetNumberOfPoints(); }
  std::array<double, 3> position(std::int64_t v) const {
    std::array<double, 3> p{};
    mesh_->GetPoint(v, p.data());
    return p;
  }
  std::vector<std::array<std::uint32_t, 3>> faces() const {
    std::vector<std::array<std::uint32_t, 3>> result;
    result.reserve(mesh_->GetNumberOfCells());
    vtkNew<vtkIdList> corners;
    for (vtkIdType f = 0; f < mesh_->GetNumberOfCells(); ++f) {
      mesh_->GetPolys()->GetCellAtId(f, corners);
      auto& triangle = result.emplace_back();
      for (int k = 0; k < 3; ++k) triangle[k] = static_cast<std::uint32_t>(corners->GetId(k));
    }
    return result;
  }

 private:
  vtkNew<vtkPolyData> mesh_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static const lc_subject subject = make_subject<RefiningSubject<VtkMesh, void, float>>("vtk", "VTK");
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
