#ifdef ENDOWIRE_WITH_VTK

#include "endowire/io/vtk_poly_data.hpp"

#include <vtkXMLPolyDataWriter.h>

#include "endowire/io/file.hpp"

namespace endowire::io {

void write_vtp(const std::filesystem::path& path, vtkPolyData& poly) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&poly);
  writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(false);
  writer->SetCompressorTypeToNone();
  writer->SetWriteToOutputString(true);
  writer->Write();
  write_file_atomically(path, writer->GetOutputString());
}

}  // namespace endowire::io

#endif
