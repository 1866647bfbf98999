#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/mesh/vtk_mesh.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <shapes.hpp>

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstring>
#include <random>
#include <sstream>

using namespace gracilis;
using testing::AllOf;
using testing::HasSubstr;

namespace {

const std::string ply_header =
    "ply\nformat ascii 1.0\ncomment a tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
    "float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_text = ply_header + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string vtk_text =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "METADATA\nINFORMATION 1\nNAME x\n\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\nPOINT_DATA 4\n";
const std::string obj_text =
    "# t\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nvn 0 0 1\r\nf 1//1 3//1 2//1\r\nf -4 -3 -1\r\nf 2 3 4\r\nf 3 1 "
    "4\r\n";
const std::string vtp_text =
    "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"4\" "
    "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"4\"><Points><DataArray "
    "type=\"Float32\" "
    "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Polys><DataArray "
    "type=\"Int32\" "
    "Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 1 2 3 2 0 3</DataArray><DataArray type=\"Int32\" "
    "Name=\"offsets\" "
    "format=\"ascii\">3 6 9 12</DataArray></Polys></Piece></PolyData></VTKFile>";

template <typename Number>
void append(std::string& bytes, Number value, bool swap = false) {
  char copy[sizeof value];
  std::memcpy(copy, &value, sizeof value);
  if (swap) std::reverse(copy, copy + sizeof value);
  bytes.append(copy, sizeof value);
}

std::string binary_ply(bool big_endian) {
  std::string bytes = ply_header;
  bytes.replace(bytes.find("ascii"), 5, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) append(bytes, x, big_endian);
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    bytes += '\3';
    for (const int corner : face) append(bytes, corner, big_endian);
  }
  return bytes;
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{4});
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    bytes.append(12, '\0');
    for (const int corner : face) {
      for (const double x : corners[corner]) append(bytes, static_cast<float>(x));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string text_stl() {
  const char* corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  std::string text = "solid t\n";
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) text += std::string("vertex ") + corners[corner] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string mesh_message(const std::filesystem::path& path) {
  return message_of_input_error([&] { read_mesh(path, 1); });
}

}  // namespace

TEST(MeshReader, every_format_gives_the_same_tetrahedron) {
  const TestFolder folder;
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"a.ply", ply_text},
                                      {"little.ply", binary_ply(false)},
                                      {"big.ply", binary_ply(true)},
                                      {"text.stl", text_stl()},
                                      {"binary.stl", binary_stl()},
                                      {"a.obj", obj_text},
                                      {"a.vtk", vtk_text},
                                      {"CAPITAL.VTP", vtp_text}}) {
    const TriangleMesh mesh = read_mesh(folder.write(name, content), 0.001);
    ASSERT_EQ(mesh.vertex_count(), 4) << name;
    ASSERT_EQ(mesh.face_count(), 4) << name;
    const MeshReport report = inspect_mesh(mesh);
    EXPECT_TRUE(report.is_closed()) << name;
    EXPECT_NEAR(report.volume, 1e-9 / 6, 1e-20) << name;
    const bool keeps_order = !name.ends_with(".stl");
    EXPECT_TRUE(!keeps_order || mesh.vertices.col(1) == Vec3(0.001, 0, 0)) << name;
  }
}

TEST(MeshReader, polygons_and_strips_are_cut_into_triangles) {
  const TestFolder folder;
  // An arrowhead, not convex: a fan from its first corner would leave it.
  const TriangleMesh arrow = read_mesh(folder.write("a.obj", "v 2 0 0\nv 0 1 0\nv 0.5 0 0\nv 0 -1 0\nf 4 1 2 3\n"), 1);
  EXPECT_EQ(arrow.face_count(), 2);
  EXPECT_NEAR(inspect_mesh(arrow).area, 1.5, 1e-12);
  const TriangleMesh strip =
      read_mesh(folder.write("a.vtk",
                             "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
                             "POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"),
                1);
  EXPECT_EQ(strip.face_count(), 2);
  EXPECT_TRUE(inspect_mesh(strip).is_oriented());
}

TEST(MeshReader, version_5_of_the_legacy_format_is_read) {
  const TestFolder folder;
  const TriangleMesh mesh = read_mesh(
      folder.write(
          "a.vtk",
          "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
          "POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 12\nCONNECTIVITY vtktypeint64\n0 2 1 0 1 3 1 2 3 2 0 3\n"),
      1);
  EXPECT_TRUE(inspect_mesh(mesh).is_closed());
}

TEST(MeshReader, every_storage_that_vtk_writes_is_read_from_a_vtp) {
  const TestFolder folder;
  // Large enough for several compressed blocks.
  const Points points = Points::Random(3, 5000);
  Eigen::Matrix3Xi faces(3, 4000);
  for (Index i = 0; i < faces.size(); ++i) faces(i % 3, i / 3) = (i * 7) % 5000;
  for (int variant = 0; variant < 3 * 4 * 2 * 2; ++variant) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(to_vtk(points, faces));
    writer->SetDataMode(variant % 3);  // ascii, binary, appended
    writer->SetCompressorType(variant / 3 % 4);
    writer->SetEncodeAppendedData(variant / 12 % 2);
    variant / 24 % 2 ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
    if (variant % 2) writer->SetIdTypeToInt32();
    if (variant % 5 == 0) writer->SetByteOrderToBigEndian();
    writer->SetBlockSize(9000);
    writer->SetFileName((folder.path() / "a.vtp").c_str());
    ASSERT_EQ(writer->Write(), 1);
    const TriangleMesh mesh = read_mesh(folder.path() / "a.vtp", 1);
    ASSERT_EQ(mesh.vertex_count(), 5000) << variant;
    EXPECT_TRUE((mesh.faces.array() == faces.array()).all()) << variant;
    EXPECT_TRUE(mesh.vertices.isApprox(points, 1e-7)) << variant;
  }
}

/// No change of a file's bytes may crash the reader: it reads something or throws InputError.
TEST(MeshReader, damage_anywhere_is_survived) {
  const TestFolder folder;
  const TriangleMesh mesh = read_mesh(folder.write("a.ply", ply_text), 1);
  write_surface(folder.path() / "a.vtp", mesh.vertices, mesh.faces);
  std::ostringstream vtp;
  vtp << std::ifstream(folder.path() / "a.vtp").rdbuf();
  std::mt19937 random(1);
  int refused = 0;
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"d.ply", ply_text},
                                      {"d.ply", binary_ply(false)},
                                      {"d.stl", text_stl()},
                                      {"d.stl", binary_stl()},
                                      {"d.obj", obj_text},
                                      {"d.vtk", vtk_text},
                                      {"d.vtp", vtp_text},
                                      {"d.vtp", vtp.str()}}) {
    for (int i = 0; i < 60; ++i) {
      std::string damaged = content;
      if (i % 4 == 0) damaged.resize(random() % damaged.size());
      for (int k = 0; k < 3 && !damaged.empty(); ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
      const auto path = folder.write(name, damaged);
      try {
        inspect_mesh(read_mesh(path, 1));
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 120);
}

TEST(MeshReader, a_file_that_is_not_there_or_not_a_file_is_named) {
  const TestFolder folder;
  EXPECT_THAT(mesh_message(folder.path() / "no.ply"), HasSubstr("no.ply: does not exist"));
  EXPECT_THAT(mesh_message(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(mesh_message(folder.write("empty.ply", "")), HasSubstr("empty.ply: is empty"));
  EXPECT_THAT(mesh_message(folder.write("a.blend", "x")), HasSubstr("use .ply, .stl, .obj, .vtk, .vtp or .glb"));
}

TEST(MeshReader, damaged_files_are_refused_with_the_place) {
  const TestFolder folder;
  const auto cut = [](std::string text, std::size_t bytes) { return text.substr(0, text.size() - bytes); };
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(mesh_message(folder.write("cut.ply", cut(binary_ply(false), 9))),
              HasSubstr("ends before all announced numbers"));
  EXPECT_THAT(mesh_message(folder.write("text.ply", changed(ply_text, "0 1 0", "0 o 0"))),
              HasSubstr("text.ply:13: 'o' is not"));
  EXPECT_THAT(mesh_message(folder.write("many.ply", changed(ply_text, "vertex 4", "vertex 4000000000000"))),
              HasSubstr("announces 4000000000000 elements"));
  EXPECT_THAT(mesh_message(folder.write("index.ply", changed(ply_text, "3 2 0 3", "3 2 0 999"))),
              HasSubstr("face 3: names vertex 999, but the vertices go from 0 to 3"));
  EXPECT_THAT(mesh_message(folder.write("index.obj", changed(obj_text, "f 2 3 4", "f 2 3 9"))),
              HasSubstr("face 2: names vertex 8"));
  EXPECT_THAT(mesh_message(folder.write("word.obj", changed(obj_text, "v 1 0 0", "v 1 zero 0"))),
              HasSubstr("word.obj:3: 'zero'"));
  EXPECT_THAT(mesh_message(folder.write("two.obj", changed(obj_text, "f 2 3 4", "f 2 3"))),
              HasSubstr("face 2: has 2 corners"));
  EXPECT_THAT(mesh_message(folder.write("cut.vtk", vtk_text.substr(0, vtk_text.find("3 1 2 3")))),
              HasSubstr("cut.vtk:17"));
  EXPECT_THAT(mesh_message(folder.write("index.vtp", changed(vtp_text, "2 0 3<", "2 0 7<"))),
              HasSubstr("face 3: names vertex 7"));
  EXPECT_THAT(mesh_message(folder.write("cut.vtp", cut(vtp_text, 100))), HasSubstr("cut.vtp:1: is damaged"));
  EXPECT_THAT(mesh_message(folder.write("cut.stl", cut(binary_stl(), 60))), HasSubstr("announces 4 triangles"));
  EXPECT_THAT(mesh_message(folder.write("cut_text.stl", cut(text_stl(), 60))), HasSubstr("ends before 'endsolid'"));
  for (const char* name : {"g.ply", "g.stl", "g.obj", "g.vtk", "g.vtp"}) {
    EXPECT_THAT(mesh_message(folder.write(name, std::string(300, '?'))), HasSubstr(name));
  }
}

TEST(MeshReader, vtk_prints_nothing_of_its_own) {
  const TestFolder folder;
  testing::internal::CaptureStderr();
  mesh_message(folder.write("g.vtp", std::string(300, '?')));
  mesh_message(folder.write("g.stl", "solid x\nfacet\nvertex a b c\nendsolid\n"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LoadSurface, a_muscle_with_a_hole_is_refused_and_a_bone_warned_about) {
  const TestFolder folder;
  std::string open = ply_text.substr(0, ply_text.find("3 2 0 3"));
  open.replace(open.find("face 4"), 6, "face 3");
  const auto path = folder.write("open.ply", open);
  const std::string text = message_of_input_error([&] { load_surface(path, 1, SurfaceRole::muscle); });
  EXPECT_THAT(text, AllOf(HasSubstr("open.ply:face 0: lies at a hole: 3 open edges"),
                          HasSubstr("gracilis prepare " + path.string())));
  const LoadedMesh bone = load_surface(path, 1, SurfaceRole::bone);
  ASSERT_EQ(bone.warnings.size(), 1u);
  EXPECT_THAT(bone.warnings[0], HasSubstr("open.ply: face 0: lies at a hole: 3 open edges (tolerated in a bone)"));
}

TEST(LoadSurface, the_command_that_mends_can_be_pasted_and_says_that_it_writes_metres) {
  TriangleMesh open = shapes::sphere(Vec3::Zero(), 0.02, 2);
  open.faces.conservativeResize(3, open.face_count() - 4);
  const auto text_in = [&](Real unit) {
    return message_of_input_error([&] { check_surface(open, unit, SurfaceRole::muscle, "My Leg/psoas.ply"); });
  };
  EXPECT_THAT(text_in(1), HasSubstr("(mend it with: gracilis prepare 'My Leg/psoas.ply' --out prepared)"));
  EXPECT_THAT(text_in(0.001), HasSubstr("gracilis prepare 'My Leg/psoas.ply' --unit mm --out prepared; what that "
                                        "writes is in metres: leave out 'unit' for it, or set unit = \"m\""));
}

TEST(LoadSurface, a_flat_muscle_encloses_nothing_and_is_refused) {
  TriangleMesh flat;
  flat.vertices.resize(3, 4);
  flat.vertices << 0, 0.1, 0, 0.03, 0, 0, 0.1, 0.03, 0, 0, 0, 0;
  flat.faces.resize(3, 4);
  flat.faces << 0, 0, 1, 0, 2, 1, 2, 3, 1, 3, 3, 2;
  EXPECT_THAT(message_of_input_error([&] { check_surface(flat, 1, SurfaceRole::muscle, "m.ply"); }),
              HasSubstr("m.ply: is flat: it encloses no volume"));
  flat.vertices(2, 3) = 1e-3;
  EXPECT_EQ(check_surface(flat, 1, SurfaceRole::muscle, "m.ply").mesh.face_count(), 4) << "a thin one is none";
}

TEST(LoadSurface, a_wrong_unit_shows_in_the_bounding_box) {
  const TestFolder folder;
  std::string large = ply_text;
  for (auto at = large.find(" 1\n"); at != std::string::npos; at = large.find(" 1\n", at + 4))
    large.replace(at, 2, " 400");
  const auto path = folder.write("large.ply", large.replace(large.find("3 0 2 400"), 9, "3 0 2 1"));
  const auto load = [&](Real unit) { return [&, unit] { load_surface(path, unit, SurfaceRole::bone); }; };
  EXPECT_THAT(message_of_input_error(load(1)), HasSubstr("set unit = \"mm\""));
  EXPECT_NO_THROW(load_surface(path, 0.001, SurfaceRole::bone));
  const auto small = folder.write("small.ply", ply_text);
  EXPECT_THAT(message_of_input_error([&] { load_surface(small, 0.001, SurfaceRole::bone); }),
              HasSubstr("set unit = \"m\""));
}

TEST(LoadSurface, a_coordinate_that_is_not_finite_is_refused_in_any_role) {
  const TestFolder folder;
  std::string text = ply_text;
  const auto path = folder.write("nan.ply", text.replace(text.find("0 1 0"), 5, "0 nan 0"));
  EXPECT_THAT(message_of_input_error([&] { load_surface(path, 1, SurfaceRole::bone); }), HasSubstr("vertex 2"));
}

TEST(LoadSurface, the_cadaver_s_clean_surfaces_are_used_unchanged) {
  GRACILIS_NEEDS_DATA("lhdl-hip/clean");
  for (const auto& entry : std::filesystem::directory_iterator(data_root() / "lhdl-hip" / "clean")) {
    const LoadedMesh loaded = load_surface(entry.path(), 0.001, SurfaceRole::muscle);
    EXPECT_TRUE(loaded.repairs.empty()) << loaded.repairs.front();
    const TriangleMesh read = read_mesh(entry.path(), 0.001);
    EXPECT_TRUE((loaded.mesh.vertices.array() == read.vertices.array()).all());
    EXPECT_TRUE((loaded.mesh.faces.array() == read.faces.array()).all());
  }
}

TEST(LoadSurface, the_cadaver_s_known_defects_are_found) {
  GRACILIS_NEEDS_DATA("lhdl-hip/seed");
  // Its few turned triangles are turned back.
  const LoadedMesh femur = load_surface(data_root() / "lhdl-hip/seed/femur_r.vtk", 0.001, SurfaceRole::muscle);
  EXPECT_EQ(femur.repairs.size(), 1u);
  EXPECT_NEAR(femur.report.volume, 530.2e-6, 0.1e-6);
  // Pinched: no muscle, but a bone.
  const auto pinched = data_root() / "lhdl-hip/hires/gluteus_medius_r.vtk";
  EXPECT_THROW(load_surface(pinched, 0.001, SurfaceRole::muscle), InputError);
  EXPECT_FALSE(load_surface(pinched, 0.001, SurfaceRole::bone).warnings.empty());
  EXPECT_THAT(message_of_input_error([] { read_mesh(data_root() / "lhdl-hip/seed/fibres_gluteus_maximus_r.vtk", 1); }),
              HasSubstr("holds lines but no surface"));
}

TEST(LoadSurface, the_bones_of_opensim_are_bones) {
  GRACILIS_NEEDS_DATA("opensim/geometry");
  for (const auto& entry : std::filesystem::directory_iterator(data_root() / "opensim" / "geometry")) {
    EXPECT_GT(load_surface(entry.path(), 1, SurfaceRole::bone).report.area, 0) << entry.path();
  }
}
